#pragma once

#include <string>
#include <vector>

namespace hiac {

/// A view of ParaView as an image specification.
struct ParaviewView {
  /// TOML, for parse_scene. Of a camera file (.pvcc) the camera and a size alone.
  std::string text;
  /// One line each: the view, the law of the extinction, the colour function and its error.
  std::vector<std::string> notes;
  /// One line each: what the view shows and the specification has no equal for, and why.
  std::vector<std::string> omitted;
  /// The file of the data that the view shows, found beside the state where the path in it does not
  /// exist; empty if the state names none.
  std::string data_file;
  bool is_camera_file = false;  ///< the text has a camera alone
};

/// Whether a name is that of a ParaView file: `.pvsm` or `.pvcc`, where need be with `#VIEW` behind
/// it.
bool is_paraview_file(const std::string& name);

/// The path in such a name: without #VIEW, unless a file has the name as it is.
std::string paraview_file_of(const std::string& name);

/// Reads a state (.pvsm) or a camera (.pvcc) that ParaView saved; needs no ParaView. `name`: the
/// path; of several render views the one called VIEW where it is `PATH#VIEW`, else the first.
///
/// The specification has the view's camera, size and background; colour and extinction of the
/// volume that is visible in it, the values of visible Contour filters as isosurfaces, and the
/// surface of the data as skin. Colours are ParaView's display values within 1e-6 (a discretized
/// map: its steps, not rounded to bytes). Extinctions are opacity / unit distance, or -ln(1 -
/// opacity) / unit distance, as the state's mapper takes them, within 1e-4 of the largest.
///
/// Throws InputError for a file that is unreadable or malformed, for a volume of a filter's output
/// (it names the filter), for two visible volumes, and for a volume that has no equal (moved,
/// scaled or parted; colours of categories); UsageError for a view that the state does not have.
ParaviewView view_from_state(const std::string& name);

}  // namespace hiac

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hiac/base/transfer_function.hpp"

namespace hiac {

/// The colour space in which a preset interpolates, as VTK's vtkColorTransferFunction defines it.
enum class ColorSpace : std::uint8_t { rgb, hsv, hsv_wrapped, lab, diverging, step };

/// What the numbers of a colour are: linear RGB, or values for a display, encoded by sRGB's
/// function.
enum class ColorEncoding : bool { linear, srgb };

/// A ParaView colour-map preset: colours at scalars, and how to interpolate between them.
struct ColormapPreset {
  struct Node {
    double scalar;
    std::array<double, 3> rgb;  ///< in [0, 1]
  };

  std::string name;
  ColorSpace space = ColorSpace::rgb;
  std::vector<Node> nodes;  ///< at least one, scalars not decreasing
};

/// Reads a preset file: JSON (one map or a list of maps; commas before a closing bracket are
/// tolerated, as ParaView users have such files) or XML (<ColorMap> elements with <Point>
/// elements). It takes the map called `name`, or the first without a name. Throws InputError with
/// the file's name if it is unreadable or malformed, contains no such map, or if the map has
/// indexed colours or an unknown colour space.
ColormapPreset read_colormap_preset(const std::string& path,
                                    const std::optional<std::string>& name = std::nullopt);

/// Returns the colour at a scalar between the nodes' first and last; constant outside. It is
/// decoded to linear RGB where the preset's numbers are `encoding` sRGB.
std::array<double, 3> preset_color(const ColormapPreset& preset, double scalar,
                                   ColorEncoding encoding = ColorEncoding::linear);

/// A preset as a piecewise-linear function.
struct LinearizedPreset {
  std::vector<PiecewiseLinear<3>::Point> points;
  double bound;  ///< proven: no channel deviates more anywhere
};

/// Stretches the preset's scalars to [low, high] and subdivides between its nodes until the error
/// of every channel is proven to be at most `tolerance` (step maps, and linear RGB, need no
/// subdivision). A preset whose numbers are `encoding` sRGB interpolates them as a display program
/// does and is decoded afterwards; the points are linear RGB, and errors are those of display
/// values. Throws std::invalid_argument unless low < high and tolerance > 0.
LinearizedPreset linearize(const ColormapPreset& preset, double low, double high, double tolerance,
                           ColorEncoding encoding = ColorEncoding::linear);

}  // namespace hiac

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {
struct BoundarySurface;
}

namespace hiac::formats {

/// The options that choose the parts of a file to read.
struct ReadOptions {
  std::optional<double> time;        ///< the step of this time
  bool nearest_time = false;         ///< take the nearest step if none has that time
  std::optional<std::size_t> step;   ///< the step of this number, from 0
  std::optional<std::string> block;  ///< only the block with this name
  /// Leave out volume cells that the zoo has no kind for, instead of refusing the file.
  bool skip_unsupported = false;
  /// Read volume cells of orders or node counts that the zoo has no kind for (27-node bricks, say)
  /// as the linear kind that their corners form.
  bool corners_of_unsupported = false;
  /// Convert such cells to cubic or quadratic ones, and polyhedra to tetrahedra and pyramids; a
  /// note states the largest error of the conversion.
  bool approximate = false;
};

/// A mesh, and notes for the user on its conversion, one sentence each: cells left out, nodes
/// dropped and so on.
struct Reading {
  ZooMesh mesh;
  std::vector<std::string> notes;
};

/// The number of cells of one of the format's own kinds in a file, and their conversion.
struct CellCount {
  std::string kind;  ///< the format's name
  std::size_t count;
  std::string fate;  ///< "tetrahedron4", "dropped (not a volume)", "unsupported"
};

/// One field of a file: its location, its type and its range.
struct FieldSummary {
  std::string name;
  std::string location;  ///< "node", "cell", "corner"
  std::string type;      ///< the format's number type
  std::uint32_t components = 1;
  std::size_t tuples = 0;
  double low = 0;   ///< smallest finite value of any component; low > high when there is none
  double high = 0;  ///< largest finite value of any component
  std::size_t not_finite = 0;
};

/// The contents of a file, without converting it.
struct Inventory {
  std::string format;
  std::size_t points = 0;
  std::vector<CellCount> cells;
  std::vector<FieldSummary> fields;
  std::vector<double> times;        ///< empty when the format or the file knows no time
  std::vector<std::string> blocks;  ///< empty when the format knows no blocks
  std::vector<std::string> notes;
};

/// One file format: its line of --list-formats, and its functions.
struct Format {
  std::string_view name;
  std::vector<std::string_view> extensions;  ///< with the dot, lower case
  std::string_view kinds;
  std::string_view fields;
  std::string_view time_steps;

  /// Whether a file that begins with these bytes is of this format.
  std::function<bool(std::string_view head)> recognizes;
  /// For formats that are stored in a container (HDF5, say): whether the file is such a container
  /// and holds this format. Throws InputError when the container is damaged. Empty: no container.
  std::function<bool(const std::string& path)> contains;
  /// For formats that the first bytes do not identify: whether a file that begins with these bytes,
  /// has one of the extensions and is recognized by no other format may be of this format. Empty:
  /// never.
  std::function<bool(std::string_view head)> plausible;
  /// Whether files packed by gzip are read too.
  bool gzip = false;
  /// Empty when the format cannot be read or written. All throw InputError naming the file.
  std::function<Reading(const std::string& path, const ReadOptions& options)> read;
  std::function<Inventory(const std::string& path)> inspect;
  /// Returns notes on what the format cannot hold.
  std::function<std::vector<std::string>(const std::string& path, const ZooMesh& mesh)> write;
  /// For formats of surfaces, which hold the boundary of a mesh: writes one; `write` makes it with
  /// default_boundary_levels (hiac/mesh/boundary_surface.hpp). Empty for other formats.
  std::function<std::vector<std::string>(const std::string& path, const BoundarySurface& surface)>
      write_boundary;
};

/// The range of a field's finite values.
void summarize_values(std::span<const double> values, FieldSummary& summary);

}  // namespace hiac::formats

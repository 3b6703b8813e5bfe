#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hiac::formats::plot3d {

using Extents = std::array<std::size_t, 3>;

/// The blocks of a grid file: coordinates of all x, then y, then z, i fastest; IBLANK if the file
/// has it.
struct Grid {
  std::vector<Extents> blocks;
  std::vector<std::vector<double>> coordinates;
  std::vector<std::vector<std::int32_t>> iblank;  ///< empty when the file has none
};

/// The blocks of a Q or function file: for every variable, one value per point.
struct Solution {
  std::vector<std::size_t> variables;  ///< of every block
  std::vector<std::vector<double>> values;
};

/// Reads a grid file, determining its dialect. Throws InputError naming the file when none fits.
Grid read_grid(const std::string& path);

/// Reads a Q file for these blocks: density, three components of momentum, stagnation energy, and
/// the variables that OVERFLOW adds.
Solution read_q(const std::string& path, const std::vector<Extents>& blocks);

/// Reads a function file for these blocks.
Solution read_function(const std::string& path, const std::vector<Extents>& blocks);

/// Whether the bytes may be the beginning of a grid file.
bool may_be_grid(std::string_view head);

}  // namespace hiac::formats::plot3d

#include "formats/common/mesh/structured.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "formats/common/mesh/foreign_mesh.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {

std::size_t StructuredBlock::cell_count() const {
  if (std::find(points.begin(), points.end(), 0U) != points.end()) return 0;
  return (points[0] - 1) * (points[1] - 1) * (points[2] - 1);
}

StructuredBlock structured_block(std::span<const std::int64_t> extents, std::size_t limit,
                                 const std::string& subject) {
  StructuredBlock block{{1, 1, 1}};
  std::size_t total = 1;
  for (std::size_t d = 0; d < extents.size() && d < 3; ++d) {
    if (extents[d] < 1)
      throw InputError(subject, fmt::format("a structured block has {} points along an axis (1 or "
                                            "more expected)",
                                            extents[d]));
    block.points[d] = static_cast<std::size_t>(extents[d]);
    if (block.points[d] > limit || total > limit / block.points[d])
      throw InputError(subject, fmt::format("a structured block of {} x {} x {} points is more "
                                            "than the file can hold",
                                            extents[0], extents.size() > 1 ? extents[1] : 1,
                                            extents.size() > 2 ? extents[2] : 1));
    total *= block.points[d];
  }
  return block;
}

std::vector<std::size_t> add_bricks(ForeignMesh& mesh, const StructuredBlock& block,
                                    std::size_t first_point, const std::vector<bool>& hidden,
                                    const std::string& name) {
  const std::size_t first_cell = mesh.cell_count();
  const auto [ni, nj, nk] = block.points;
  const std::uint16_t type = mesh.type_place("structured brick", 8, converted_to(CellKind::brick8));
  const std::array<std::size_t, 8> corners{0,       1,           1 + ni,           ni,
                                           ni * nj, ni * nj + 1, ni * nj + 1 + ni, ni * nj + ni};
  std::vector<std::size_t> kept;
  std::size_t cell = 0;
  if (block.cell_count() == 0) return kept;
  mesh.cell_types.reserve(first_cell + block.cell_count());
  mesh.cell_nodes.reserve(mesh.cell_nodes.size() + 8 * block.cell_count());
  for (std::size_t k = 0; k + 1 < nk; ++k)
    for (std::size_t j = 0; j + 1 < nj; ++j)
      for (std::size_t i = 0; i + 1 < ni; ++i, ++cell) {
        const std::size_t corner = i + ni * (j + nj * k);
        const auto is_hidden = [&](std::size_t step) { return hidden[corner + step]; };
        if (!hidden.empty() && std::any_of(corners.begin(), corners.end(), is_hidden)) continue;
        if (!hidden.empty()) kept.push_back(cell);
        mesh.cell_types.push_back(type);
        for (const std::size_t step : corners)
          mesh.cell_nodes.push_back(mesh.first_node +
                                    static_cast<std::int64_t>(first_point + corner + step));
      }
  if (!name.empty()) mesh.blocks.push_back({name, {{first_cell, mesh.cell_count()}}});
  return kept;
}

}  // namespace hiac::formats

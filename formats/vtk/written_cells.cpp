#include "formats/vtk/written_cells.hpp"

#include <fmt/format.h>
#include <vtkCellType.h>

#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

/// The wedge as a brick whose edge 6-7 is one node; in the quadratic wedge, so is the edge's
/// middle.
constexpr std::array<std::uint8_t, 8> kWedge7{0, 1, 2, 3, 4, 5, 6, 6};
constexpr std::array<std::uint8_t, 20> kWedge18{0, 1,  2,  3,  4, 5,  6,  6,  7,  8,
                                                9, 10, 11, 12, 6, 13, 14, 15, 16, 17};

std::optional<WrittenCell> written_cell(CellKind kind) {
  if (kind == CellKind::wedge7) return WrittenCell{VTK_HEXAHEDRON, kWedge7};
  if (kind == CellKind::wedge18) return WrittenCell{VTK_QUADRATIC_HEXAHEDRON, kWedge18};
  if (kind == CellKind::tetrahedron20) return WrittenCell{VTK_LAGRANGE_TETRAHEDRON, {}};
  if (const auto type = vtk_cell_type(kind)) return WrittenCell{*type, {}};
  return std::nullopt;
}

}  // namespace

WrittenCells written_cells(const ZooMesh& mesh, std::string_view format, const std::string& path,
                           std::vector<std::string>& notes) {
  std::array<std::size_t, kKindCount> counts{};
  for (const CellKind kind : mesh.kinds) ++counts[static_cast<std::size_t>(kind)];
  WrittenCells table;
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    table[k] = written_cell(kind);
    if (counts[k] > 0 && !table[k])
      throw InputError(path, fmt::format("{} has no cell for a {} ({} found)", format,
                                         kind_name(kind), counts[k]));
    if (counts[k] > 0 && !table[k]->nodes.empty())
      notes.push_back(
          fmt::format("{} {} cells written as bricks with a repeated node, {} having "
                      "no such cell",
                      counts[k], kind_name(kind), format));
  }
  return table;
}

}  // namespace hiac::formats::vtk

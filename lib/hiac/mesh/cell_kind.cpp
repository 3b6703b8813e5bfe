#include "hiac/mesh/cell_kind.hpp"

#include <algorithm>

namespace hiac {
namespace {

constexpr std::array<std::string_view, kKindCount> kKindNames{
    "tetrahedron4", "tetrahedron10", "tetrahedron20", "pyramid5", "pyramid13",
    "pyramid21",    "prism6",        "prism15",       "prism24",  "wedge7",
    "wedge18",      "wedge29",       "brick8",        "brick20",  "brick32"};

// VTK_TETRA, VTK_QUADRATIC_TETRA, VTK_LAGRANGE_TETRAHEDRON, ... of vtkCellType.h; 0: none.
constexpr std::array<int, kKindCount> kVtkCellTypes{10, 24, 71, 14, 27, 0,  13, 26,
                                                    0,  0,  0,  0,  12, 25, 0};

}  // namespace

std::string_view kind_name(CellKind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }

std::optional<CellKind> kind_from_name(std::string_view name) {
  const auto found = std::ranges::find(kKindNames, name);
  if (found == kKindNames.end()) return std::nullopt;
  return static_cast<CellKind>(found - kKindNames.begin());
}

std::optional<int> vtk_cell_type(CellKind kind) {
  const int type = kVtkCellTypes[static_cast<std::size_t>(kind)];
  return type == 0 ? std::nullopt : std::optional(type);
}

}  // namespace hiac

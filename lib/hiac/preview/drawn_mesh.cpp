#include "hiac/preview/drawn_mesh.hpp"

#include <algorithm>

#include "hiac/mesh/cell_kind.hpp"
#include "hiac/tetrahedralize/subdivide_cells.hpp"

namespace hiac::preview {

DrawnMesh drawn_mesh(const ZooMesh& mesh, unsigned levels) {
  const auto approximated = static_cast<std::uint64_t>(std::ranges::count_if(
      mesh.kinds, [](CellKind kind) { return kind != CellKind::tetrahedron4; }));
  if (approximated == 0) return {mesh};
  const bool curved = std::ranges::any_of(
      mesh.kinds, [](CellKind kind) { return order_of(kind) != CellOrder::linear; });
  const unsigned halvings = curved ? levels : 0;
  return {subdivide_cells(mesh, {.linearize = true, .levels = halvings}).mesh, approximated,
          halvings};
}

}  // namespace hiac::preview

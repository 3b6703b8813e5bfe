#include "hiac/frame/kernel_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "hiac/base/large_pages.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/element/cell_field.hpp"
#include "hiac/geometry/face_form.hpp"

namespace hiac {
namespace {

// Width in pixels of a projected triangle below which too many digits of depth are lost: with an
// ulp of a coordinate of about 1e-13, depths on wider triangles are accurate to 1e-9 of their
// range, as the witness requires.
constexpr double kThinnest = 0x1p-13;

bool is_thin(const ProjectedNode& a, const ProjectedNode& b, const ProjectedNode& c) {
  const double x1 = b.x - a.x, y1 = b.y - a.y, x2 = c.x - a.x, y2 = c.y - a.y;
  const double longest =
      std::max(std::max(std::abs(x1), std::abs(y1)), std::max(std::abs(x2), std::abs(y2)));
  return !(std::abs(x1 * y2 - x2 * y1) > kThinnest * longest);
}

// The kernel for a tetrahedron, if any.
std::optional<CellKernel> kernel_of(const ZooMesh& mesh, CellId cell,
                                    std::span<const ProjectedNode> nodes, double straightness) {
  const CellKind kind = mesh.kinds[cell];
  const auto ids = mesh.cell_nodes(cell);
  std::array<ProjectedNode, 4> p;
  for (std::size_t k = 0; k < 4; ++k) {
    p[k] = nodes[ids[k]];
    if (std::isnan(p[k].depth)) return {};
  }
  if (is_thin(p[0], p[1], p[2]) || is_thin(p[0], p[1], p[3]) || is_thin(p[0], p[2], p[3]) ||
      is_thin(p[1], p[2], p[3]))
    return {};
  if (kind == CellKind::tetrahedron4) return CellKernel::linear;
  if (edge_deviation(kind, cell_positions(mesh, cell)) > straightness) return {};
  return kind == CellKind::tetrahedron10 ? CellKernel::quadratic : CellKernel::cubic;
}

}  // namespace

std::vector<CellKernel> kernel_cells(const ZooMesh& mesh, std::span<const ProjectedNode> nodes,
                                     double straightness) {
  auto kernels = large_vector<CellKernel>(mesh.cell_count());
  parallel_for(kernels.size(), std::size_t{1} << 14, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      const auto cell = static_cast<CellId>(k);
      std::optional<CellKernel> kernel;
      if (shape_of(mesh.kinds[cell]) == CellShape::tetrahedron)
        kernel = kernel_of(mesh, cell, nodes, straightness);
      kernels[cell] = kernel                                       ? *kernel
                      : has_curved_faces(mesh, cell, straightness) ? CellKernel::none_curved
                                                                   : CellKernel::none_planar;
    }
  });
  return kernels;
}

}  // namespace hiac

#include "hiac/tetrahedralize/meshing/delaunay.hpp"

#include <utility>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

namespace hiac {

std::vector<std::array<std::uint32_t, 4>> delaunay_tetrahedra(
    std::span<const std::array<double, 3>> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
  using Structure =
      CGAL::Triangulation_data_structure_3<VertexBase,
                                           CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
  using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, Structure>;

  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> numbered;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    numbered.emplace_back(Kernel::Point_3(points[i][0], points[i][1], points[i][2]), i);
  const Delaunay triangulation(numbered.begin(), numbered.end());
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  for (const auto cell : triangulation.finite_cell_handles()) {
    std::array<std::uint32_t, 4> corners;
    for (int k = 0; k < 4; ++k) corners[static_cast<std::size_t>(k)] = cell->vertex(k)->info();
    tetrahedra.push_back(corners);
  }
  return tetrahedra;
}

}  // namespace hiac

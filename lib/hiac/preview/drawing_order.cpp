#include "hiac/preview/drawing_order.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace hiac::preview {
namespace {

// The sum of the corners' ray parameters orders cells of one kind as their centroids.
double depth_of(const ZooMesh& mesh, CellId cell, const Projector& projector) {
  double sum = 0;
  const std::size_t corners = corner_count(mesh.kinds[cell]);
  for (const NodeId node : mesh.cell_nodes(cell).first(corners))
    sum += projector.parameter(mesh.position(node));
  return sum / static_cast<double>(corners);
}

}  // namespace

std::vector<CellId> back_to_front(const ZooMesh& mesh, const VisibilityOrder& order,
                                  const Projector& projector) {
  std::vector<CellId> cells(order.cells.begin(), order.cells.end());
  for (const CellGroup& group : order.groups) {
    std::vector<std::pair<double, CellId>> by_depth;
    const auto members = std::span(cells).subspan(group.first, group.count);
    for (const CellId cell : members) by_depth.emplace_back(depth_of(mesh, cell, projector), cell);
    std::ranges::sort(by_depth);
    std::ranges::transform(by_depth, members.begin(), [](const auto& pair) { return pair.second; });
  }
  std::ranges::reverse(cells);
  return cells;
}

}  // namespace hiac::preview

#include "hiac/order/published/mpvo.hpp"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "hiac/order/algorithm.hpp"
#include "hiac/order/behind_relation.hpp"
#include "hiac/order/components.hpp"
#include "hiac/order/faces/eye_side.hpp"
#include "hiac/order/published/depth.hpp"

namespace hiac {
namespace {

using Sources = std::vector<std::pair<double, CellId>>;

// Returns the cells that have an outer face towards the eye, farthest face first.
Sources outer_sources(const OrderBasis& basis, const View& view, const Depth& depth) {
  const ZooMesh& mesh = *basis.mesh;
  Sources sources;
  for (const UnmatchedFace& face : basis.unmatched) {
    const auto at = [&](std::size_t k) { return mesh.position(face.nodes[k]); };
    if (eye_side(at(0), at(1), at(2), view) * face.side >= 0) continue;
    const auto nodes = std::span(face.nodes).first(face.corner_count);
    sources.emplace_back(depth(Point3(mean_position(mesh, nodes))), face.cell);
  }
  std::ranges::sort(sources, std::greater<>());
  return sources;
}

// Returns the cells that no search has reached, farthest first; needed if the eye is inside the
// mesh.
Sources other_sources(const ZooMesh& mesh, const std::vector<bool>& seen, const Depth& depth) {
  Sources sources;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    if (!seen[cell]) sources.emplace_back(centroid_depth(mesh, cell, depth), cell);
  std::ranges::sort(sources, std::greater<>());
  return sources;
}

// The depth-first search. The cells of a visibility cycle, a strongly connected component of the
// relation, are entered and output together.
class Search {
 public:
  Search(const OrderBasis& basis, const BehindRelation& relation, const VisibilityOrder& components)
      : basis_(basis),
        relation_(relation),
        component_of_(components.cells.size()),
        seen_(components.cells.size(), false) {
    const auto cells = components.cells.view();
    for (std::size_t at = 0; at < cells.size(); ++at)
      component_of_[cells[at]] = cells.subspan(at, 1);
    for (const CellGroup& group : components.groups)
      for (const CellId cell : cells.subspan(group.first, group.count))
        component_of_[cell] = cells.subspan(group.first, group.count);
  }

  // Outputs all cells behind a cell, then the cell itself.
  void visit(CellId root) {
    if (seen_[root]) return;
    enter(root);
    while (!path_.empty()) {
      Step& step = path_.back();
      const CellId cell = step.cells[step.next];
      if (step.face < basis_.faces.count(cell)) {
        const std::uint32_t face = step.face++;
        const bool leads = (relation_.of_cell[cell].across(face) & kCellFirst) != 0;
        const CellId behind = basis_.adjacency.neighbors[basis_.faces.first(cell) + face];
        if (leads && !seen_[behind]) enter(behind);
      } else if (step.next + 1 < step.cells.size()) {
        ++step.next;
        step.face = 0;
      } else {
        leave();
      }
    }
  }

  [[nodiscard]] const std::vector<bool>& seen() const { return seen_; }

  // The output, in reverse.
  VisibilityOrder front_to_back() {
    const auto count = static_cast<std::uint32_t>(back_to_front_.size());
    for (CellGroup& group : groups_) group.first = count - group.first - group.count;
    std::ranges::reverse(groups_);
    std::ranges::reverse(back_to_front_);
    for (const CellGroup& group : groups_)
      std::ranges::sort(std::span(back_to_front_).subspan(group.first, group.count));
    return {std::move(back_to_front_), std::move(groups_),
            std::string(algorithm_name(OrderAlgorithm::mpvo))};
  }

 private:
  // A cell, or the cells of a cycle, with the next cell and face to examine.
  struct Step {
    std::span<const CellId> cells;
    std::size_t next;
    std::uint32_t face;
  };

  void enter(CellId cell) {
    const auto cells = component_of_[cell];
    for (const CellId member : cells) seen_[member] = true;
    path_.push_back({cells, 0, 0});
  }
  void leave() {
    const auto cells = path_.back().cells;
    if (cells.size() > 1)
      groups_.push_back({static_cast<std::uint32_t>(back_to_front_.size()),
                         static_cast<std::uint32_t>(cells.size())});
    back_to_front_.insert(back_to_front_.end(), cells.begin(), cells.end());
    path_.pop_back();
  }

  const OrderBasis& basis_;
  const BehindRelation& relation_;
  std::vector<std::span<const CellId>> component_of_;
  std::vector<bool> seen_;
  std::vector<Step> path_;
  std::vector<CellId> back_to_front_;
  std::vector<CellGroup> groups_;
};

}  // namespace

VisibilityOrder mpvo_order(const OrderBasis& basis, const View& view, double planarity) {
  const BehindRelation relation = shared_face_relation(basis, view, planarity);
  const VisibilityOrder components =
      order_of_components(relation, basis.faces, basis.adjacency.neighbors, {});
  const Depth depth(view);
  Search search(basis, relation, components);
  for (const auto& [far, cell] : outer_sources(basis, view, depth)) search.visit(cell);
  for (const auto& [far, cell] : other_sources(*basis.mesh, search.seen(), depth))
    search.visit(cell);
  return search.front_to_back();
}

VisibilityOrder mpvo_order(const ZooMesh& mesh, const FaceAdjacency& adjacency, const View& view,
                           double planarity) {
  return mpvo_order(order_basis(mesh, adjacency), view, planarity);
}

}  // namespace hiac

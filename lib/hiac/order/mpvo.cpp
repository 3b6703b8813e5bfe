#include "hiac/order/mpvo.hpp"

#include <algorithm>
#include <functional>
#include <ranges>
#include <span>
#include <utility>
#include <vector>

#include "hiac/order/algorithm.hpp"
#include "hiac/order/behind_relation.hpp"
#include "hiac/order/cell_side.hpp"
#include "hiac/order/components.hpp"
#include "hiac/order/depth.hpp"
#include "hiac/order/eye_side.hpp"

namespace hiac {
namespace {

// The cells from which the search starts, farthest first: those with an outer face towards the eye
// (phase III of MPVONC), then, for an eye inside the mesh, whatever no search from those reaches.
class Sources {
 public:
  Sources(const ZooMesh& mesh, const FaceAdjacency& adjacency, const View& view)
      : mesh_(mesh), depth_(view) {
    std::size_t slot = 0;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
      for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces)
        if (adjacency.neighbors[slot++] == kNoCell && faces_eye(cell, face, view))
          outer_.emplace_back(depth_of(cell, face), cell);
    std::ranges::sort(outer_, std::greater<>());
  }

  [[nodiscard]] const std::vector<std::pair<double, CellId>>& outer() const { return outer_; }

  // The other cells, by depth of their centroids.
  [[nodiscard]] std::vector<std::pair<double, CellId>> left(const std::vector<bool>& seen) const {
    std::vector<std::pair<double, CellId>> cells;
    for (CellId cell = 0; cell < mesh_.cell_count(); ++cell)
      if (!seen[cell]) cells.emplace_back(centroid_depth(mesh_, cell, depth_), cell);
    std::ranges::sort(cells, std::greater<>());
    return cells;
  }

 private:
  [[nodiscard]] bool faces_eye(CellId cell, const ShapeFace& face, const View& view) const {
    const auto nodes = mesh_.cell_nodes(cell);
    const auto corners = plane_corners(mesh_, cell, face);
    const auto at = [&](std::size_t k) { return mesh_.position(nodes[corners[k]]); };
    return eye_side(at(0), at(1), at(2), view) * side_of_cell(mesh_, cell, face) < 0;
  }
  [[nodiscard]] double depth_of(CellId cell, const ShapeFace& face) const {
    return depth_(mean_position(
        mesh_, std::span(face.corners).first(face.corner_count) |
                   std::views::transform(
                       [nodes = mesh_.cell_nodes(cell)](std::uint8_t k) { return nodes[k]; })));
  }

  const ZooMesh& mesh_;
  Depth depth_;
  std::vector<std::pair<double, CellId>> outer_;
};

// The depth-first search. The cells of a visibility cycle, a strongly connected component of the
// relation, are entered and put out as one.
class Search {
 public:
  Search(const OrderBasis& basis, const BehindRelation& relation, const VisibilityOrder& components)
      : relation_(relation),
        faces_(basis.faces),
        neighbors_(basis.adjacency.neighbors),
        component_of_(components.cells.size()),
        seen_(components.cells.size(), false) {
    const auto cells = components.cells.view();
    for (std::size_t at = 0; at < cells.size(); ++at)
      component_of_[cells[at]] = cells.subspan(at, 1);
    for (const CellGroup& group : components.groups)
      for (const CellId cell : cells.subspan(group.first, group.count))
        component_of_[cell] = cells.subspan(group.first, group.count);
  }

  // Puts out all that lies behind a cell, and the cell.
  void visit(CellId root) {
    if (seen_[root]) return;
    enter(root);
    while (!path_.empty()) {
      const std::size_t top = path_.size() - 1;
      const CellId cell = path_[top].member();
      if (path_[top].face < faces_.count(cell)) {
        const std::uint32_t face = path_[top].face++;
        const CellId behind = neighbors_[faces_.first(cell) + face];
        if ((relation_.of_cell[cell].across(face) & kCellFirst) != 0 && !seen_[behind])
          enter(behind);
      } else if (path_[top].next + 1 < path_[top].cells.size()) {
        ++path_[top].next;
        path_[top].face = 0;
      } else {
        leave();
      }
    }
  }

  [[nodiscard]] const std::vector<bool>& seen() const { return seen_; }

  // What was put out, last first.
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
  // A cell, or the cells of a cycle, and the face that is looked through next.
  struct Step {
    std::span<const CellId> cells;
    std::size_t next;
    std::uint32_t face;  // of that cell

    [[nodiscard]] CellId member() const { return cells[next]; }
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

  const BehindRelation& relation_;
  const FaceNumbering& faces_;
  std::span<const CellId> neighbors_;
  std::vector<std::span<const CellId>> component_of_;
  std::vector<bool> seen_;
  std::vector<Step> path_;
  std::vector<CellId> back_to_front_;
  std::vector<CellGroup> groups_;
};

}  // namespace

VisibilityOrder mpvo_order(const ZooMesh& mesh, const FaceAdjacency& adjacency, const View& view,
                           double planarity) {
  const OrderBasis basis = order_basis(mesh, adjacency);
  const BehindRelation relation = shared_face_relation(basis, view, planarity);
  const VisibilityOrder components =
      order_of_components(relation, basis.faces, adjacency.neighbors, {});
  const Sources sources(mesh, adjacency, view);
  Search search(basis, relation, components);
  for (const auto& [depth, cell] : sources.outer()) search.visit(cell);
  for (const auto& [depth, cell] : sources.left(search.seen())) search.visit(cell);
  return search.front_to_back();
}

}  // namespace hiac

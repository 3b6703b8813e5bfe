#include "hiac/tetrahedralize/chosen_cut.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hiac/geometry/predicates.hpp"
#include "hiac/tetrahedralize/cell_place.hpp"

namespace hiac {
namespace {

using Triangle = std::array<std::uint8_t, 3>;

constexpr std::pair<std::size_t, std::size_t> kNoneBad{0, 0};

// Returns the corners' ranks by position, and by number for nodes at the same place: cells agree on
// them at faces that they share, and at faces with different nodes at the same places.
std::array<NodeId, 8> names_by_place(const ZooMesh& mesh, CellId cell) {
  const auto nodes = mesh.cell_nodes(cell).first(corner_count(mesh.kinds[cell]));
  const auto before = [&](NodeId a, NodeId b) {
    const auto p = mesh.position(a), q = mesh.position(b);
    for (std::size_t c = 0; c < 3; ++c)
      if (p[c] != q[c]) return p[c] < q[c];
    return a < b;
  };
  std::array<NodeId, 8> names{};
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (const NodeId other : nodes) names[k] += before(other, nodes[k]) ? 1U : 0U;
  return names;
}

// Fills a cell with tetrahedra of its corners that all have the same orientation, by backtracking:
// joins a triangle of the surface to any corner and continues with the surface of the remainder
// until nothing remains. Such tetrahedra, whose outer triangles are the cell's, fill it without
// overlap.
class Filling {
 public:
  Filling(const ZooMesh& mesh, CellId cell, int hand)
      : mesh_(mesh),
        nodes_(mesh.cell_nodes(cell)),
        corners_(corner_count(mesh.kinds[cell])),
        hand_(hand) {}

  std::optional<CellCut> fill(std::vector<Triangle> surface) {
    if (!go_on(surface)) return std::nullopt;
    return cut_;
  }

 private:
  // eight corners never need more
  static constexpr std::size_t kMost = 8;

  bool go_on(const std::vector<Triangle>& surface) {
    if (surface.empty()) return true;
    if (cut_.count == kMost) return false;
    const auto [a, b, c] = surface.back();
    for (std::uint8_t d = 0; d < corners_; ++d) {
      if (d == a || d == b || d == c || !turns_right(a, c, b, d)) continue;
      std::vector<Triangle> left(surface.begin(), surface.end() - 1);
      if (!exchange(left, {a, b, d}) || !exchange(left, {b, c, d}) || !exchange(left, {c, a, d}))
        continue;
      cut_.tetrahedra[cut_.count++] = {a, c, b, d};
      if (go_on(left)) return true;
      --cut_.count;
    }
    return false;
  }

  [[nodiscard]] bool turns_right(std::uint8_t a, std::uint8_t b, std::uint8_t c,
                                 std::uint8_t d) const {
    return orientation(mesh_.position(nodes_[a]), mesh_.position(nodes_[b]),
                       mesh_.position(nodes_[c]), mesh_.position(nodes_[d])) == hand_;
  }

  // Adds a triangle to a surface, or removes its reverse; returns false if it is there already.
  static bool exchange(std::vector<Triangle>& surface, const Triangle& triangle) {
    for (std::size_t i = 0; i < surface.size(); ++i) {
      if (!std::ranges::is_permutation(surface[i], triangle)) continue;
      Triangle other = surface[i];
      std::ranges::rotate(other, std::ranges::find(other, triangle[0]));
      if (other[1] == triangle[1]) return false;
      surface.erase(surface.begin() + static_cast<std::ptrdiff_t>(i));
      return true;
    }
    surface.push_back(triangle);
    return true;
  }

  const ZooMesh& mesh_;
  std::span<const NodeId> nodes_;
  std::size_t corners_;
  int hand_;
  CellCut cut_;
};

ChosenCut with_signs(const ZooMesh& mesh, CellId cell, const CellCut& cut) {
  ChosenCut result{cut, {}};
  const auto nodes = mesh.cell_nodes(cell);
  const bool centered = cut.count > 0 && cut.tetrahedra[0][3] == kCellCenter;
  const std::array<double, 3> center =
      centered ? position_of(mesh, center_of(mesh, cell)) : std::array<double, 3>{};
  const auto at = [&](std::uint8_t corner) {
    return corner == kCellCenter ? Point3(center) : mesh.position(nodes[corner]);
  };
  for (std::size_t k = 0; k < cut.count; ++k) {
    const auto& [a, b, c, d] = cut.tetrahedra[k];
    result.signs[k] = orientation(at(a), at(b), at(c), at(d));
  }
  return result;
}

}  // namespace

std::pair<std::size_t, std::size_t> ChosenCut::bad() const {
  const auto all = std::span(signs).first(cut.count);
  const auto right = static_cast<std::size_t>(std::ranges::count(all, 1));
  const auto left = static_cast<std::size_t>(std::ranges::count(all, -1));
  return {std::min(right, left), cut.count - right - left};
}

ChosenCut choose_cut(const ZooMesh& mesh, CellId cell, OtherDiagonals other) {
  const CellKind kind = mesh.kinds[cell];
  const std::array<NodeId, 8> names = names_by_place(mesh, cell);
  const auto corners = std::span(names).first(corner_count(kind));
  const auto least = static_cast<std::uint8_t>(std::ranges::min_element(corners) - corners.begin());
  ChosenCut best;
  if (const auto cut = cut_cell_at(least, kind, corners, other)) {
    best = with_signs(mesh, cell, *cut);
    if (best.bad() == kNoneBad) return best;
  }
  const CellCut around = *cut_cell_at(kCellCenter, kind, corners, other);
  std::vector<Triangle> surface;  // as seen from outside a right-handed cell
  for (const auto& [a, b, c, center] : around.all()) surface.push_back({a, c, b});
  for (const int hand : {1, -1})
    if (const auto cut = Filling(mesh, cell, hand).fill(surface))
      return with_signs(mesh, cell, *cut);
  const ChosenCut centered = with_signs(mesh, cell, around);
  return best.cut.count == 0 || centered.bad() < best.bad() ? centered : best;
}

std::vector<ChosenCut> possible_cuts(const ZooMesh& mesh, CellId cell) {
  const CellKind kind = mesh.kinds[cell];
  const std::array<NodeId, 8> names = names_by_place(mesh, cell);
  const auto corners = std::span(names).first(corner_count(kind));
  std::vector<ChosenCut> cuts{choose_cut(mesh, cell, {})};
  for (std::size_t apex = 0; apex <= corners.size(); ++apex) {
    const auto at = apex < corners.size() ? static_cast<std::uint8_t>(apex) : kCellCenter;
    if (const auto cut = cut_cell_at(at, kind, corners, {}))
      cuts.push_back(with_signs(mesh, cell, *cut));
  }
  return cuts;
}

}  // namespace hiac

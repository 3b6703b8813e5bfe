#include "hiac/tetrahedralize/subdivide_cells.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "hiac/mesh/shape_functions.hpp"
#include "hiac/tetrahedralize/cell_cut.hpp"
#include "hiac/tetrahedralize/cell_place.hpp"
#include "hiac/tetrahedralize/chosen_cut.hpp"
#include "hiac/tetrahedralize/face_diagonals.hpp"
#include "hiac/tetrahedralize/replacement.hpp"
#include "hiac/tetrahedralize/tetrahedron_lattice.hpp"

namespace hiac {
namespace {

constexpr NodeId kNone = std::numeric_limits<NodeId>::max();

// A lattice point, as the nodes between which it lies, ascending, and their weights; unused entries
// are kNone and 0. It is the same from all cells that share those nodes.
struct PointKey {
  std::array<NodeId, 4> nodes;
  LatticePoint weights;
  bool operator==(const PointKey&) const = default;
};

struct PointHash {
  std::size_t operator()(const PointKey& key) const {
    std::uint64_t h = 0;
    for (std::size_t k = 0; k < 4; ++k)
      h = (h ^ (key.nodes[k] + (std::uint64_t{key.weights[k]} << 32))) * 0x9E3779B97F4A7C15U;
    return h ^ (h >> 29);
  }
};

// Returns the number within a cell of the cell's node at a lattice point of a tetrahedron of its
// corners, if it has one there; kCellCenter for the centre.
std::optional<std::size_t> own_node(CellKind kind, const CornerTetrahedron& corner,
                                    const LatticePoint& point, unsigned n) {
  const auto order = static_cast<unsigned>(order_of(kind));
  std::array<std::uint8_t, 4> at{};
  std::array<unsigned, 4> weight{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (point[k] == 0) continue;
    at[count] = corner[k];
    weight[count++] = point[k];
  }
  if (count == 1) return at[0];
  if (count == 2 && weight[0] * order % n == 0) {
    const auto edges = topology_of(kind).edges;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const bool forward = edges[e] == ShapeEdge{at[0], at[1]};
      if (!forward && edges[e] != ShapeEdge{at[1], at[0]}) continue;
      const unsigned steps = (forward ? weight[1] : weight[0]) * order / n;
      return corner_count(kind) + (order - 1) * e + steps - 1;
    }
  }
  const bool face_center = count == 3 && weight[0] == weight[1] && weight[1] == weight[2];
  if (face_center && kind == CellKind::tetrahedron20) {
    const auto faces = topology_of(kind).faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (std::ranges::is_permutation(std::span(faces[f].corners).first(3), std::span(at).first(3)))
        return corner_count(kind) + 2 * edge_count(kind) + f;
  }
  return std::nullopt;
}

class Subdivider {
 public:
  Subdivider(const ZooMesh& mesh, const Subdivision& how) : mesh_(mesh), how_(how), cells_(mesh) {
    for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic, CellOrder::cubic})
      nodes_of_order_[static_cast<std::size_t>(order) - 1] = nodes_on_lattice(order);
    if (how.linearize) parts_ = halved(how.levels);
  }

  SubdividedMesh subdivide() {
    const std::vector<OtherDiagonals> other = choose_diagonals(mesh_);
    for (CellId cell = 0; cell < mesh_.cell_count(); ++cell) {
      if (shape_of(mesh_.kinds[cell]) == CellShape::tetrahedron)
        append(cell, {0, 1, 2, 3});
      else
        cut(cell, other.empty() ? OtherDiagonals{} : other[cell]);
    }
    return finish();
  }

 private:
  void cut(CellId cell, OtherDiagonals other) {
    const ChosenCut chosen = choose_cut(mesh_, cell, other);
    for (std::size_t k = 0; k < chosen.cut.count; ++k) {
      // if edges are curved, a tetrahedron has volume though its corners lie in a plane
      if (chosen.signs[k] == 0 && order_of(mesh_.kinds[cell]) == CellOrder::linear)
        ++dropped_tetrahedra_;
      else
        append(cell, chosen.cut.tetrahedra[k]);
    }
  }

  void append(CellId cell, const CornerTetrahedron& t) {
    if (how_.linearize) {
      const unsigned n = 1U << how_.levels;
      for (const LatticeTetrahedron& part : parts_) append(cell, t, CellOrder::linear, part, n);
      return;
    }
    const CellOrder order = order_of(mesh_.kinds[cell]);
    append(cell, t, order, nodes_of_order_[static_cast<std::size_t>(order) - 1],
           static_cast<unsigned>(order));
  }

  // Appends a tetrahedron with its nodes at points of the lattice n of the tetrahedron t.
  void append(CellId cell, const CornerTetrahedron& t, CellOrder order,
              std::span<const LatticePoint> points, unsigned n) {
    for (const LatticePoint& point : points) {
      const NodeId node = node_at(cell, t, point, n);
      cells_.add_node(node, [&] { return place_of(cell, t, point, n); });
    }
    cells_.finish_cell(cell, kind_of(CellShape::tetrahedron, order));
  }

  [[nodiscard]] CellPlace place_of(CellId cell, const CornerTetrahedron& t,
                                   const LatticePoint& point, unsigned n) const {
    CellPlace place{cell, CellPlace::kNoNode, {}};
    const auto reference = reference_nodes(mesh_.kinds[cell]);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::array<double, 3> corner =
          t[k] == kCellCenter ? reference_center(mesh_.kinds[cell]) : reference[t[k]];
      for (std::size_t a = 0; a < 3; ++a)
        place.xi[a] += point[k] * corner[a] / static_cast<double>(n);
    }
    return place;
  }

  // Returns a node that the mesh did not have; the same one for all tetrahedra with this key.
  NodeId new_node(const PointKey& key, const CellPlace& place) {
    const auto known = new_nodes_.find(key);
    if (known != new_nodes_.end()) return known->second;
    return new_nodes_.emplace(key, cells_.make_node(place)).first->second;
  }

  // The centre of a cell; all four weights of its key are 0.
  NodeId center_node(CellId cell) {
    return new_node({{cell, kNone, kNone, kNone}, {}}, center_of(mesh_, cell));
  }

  NodeId node_at(CellId cell, const CornerTetrahedron& t, const LatticePoint& point, unsigned n) {
    const auto own = mesh_.cell_nodes(cell);
    if (const auto number = own_node(mesh_.kinds[cell], t, point, n))
      return *number == kCellCenter ? center_node(cell) : own[*number];
    std::array<std::pair<NodeId, std::uint16_t>, 4> between;
    for (std::size_t k = 0; k < 4; ++k) {
      if (point[k] == 0)
        between[k] = {kNone, std::uint16_t{0}};
      else
        between[k] = {t[k] == kCellCenter ? center_node(cell) : own[t[k]], point[k]};
    }
    std::ranges::sort(between);
    PointKey key{};
    for (std::size_t k = 0; k < 4; ++k) std::tie(key.nodes[k], key.weights[k]) = between[k];
    return new_node(key, place_of(cell, t, point, n));
  }

  SubdividedMesh finish() {
    SubdividedMesh result;
    result.new_nodes = cells_.made_nodes();
    result.mesh = cells_.finish();
    result.dropped_nodes = mesh_.node_count() + result.new_nodes - result.mesh.node_count();
    result.dropped_tetrahedra = dropped_tetrahedra_;
    return result;
  }

  const ZooMesh& mesh_;
  Subdivision how_;
  std::array<std::vector<LatticePoint>, 3> nodes_of_order_;
  std::vector<LatticeTetrahedron> parts_;
  Replacement cells_;
  std::unordered_map<PointKey, NodeId, PointHash> new_nodes_;
  std::uint64_t dropped_tetrahedra_ = 0;
};

}  // namespace

SubdividedMesh subdivide_cells(const ZooMesh& mesh, const Subdivision& how) {
  return Subdivider(mesh, how).subdivide();
}

}  // namespace hiac

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

#include "hiac/base/error.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/tetrahedralize/cell_cut.hpp"
#include "hiac/tetrahedralize/chosen_cut.hpp"
#include "hiac/tetrahedralize/face_diagonals.hpp"
#include "hiac/tetrahedralize/tetrahedron_lattice.hpp"

namespace hiac {
namespace {

constexpr NodeId kNone = std::numeric_limits<NodeId>::max();

// A place in a cell, from which a node's position and values are computed.
struct Place {
  CellId cell;
  std::array<double, 3> xi;
};

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
  Subdivider(const ZooMesh& mesh, const Subdivision& how) : mesh_(mesh), how_(how) {
    for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic, CellOrder::cubic})
      nodes_of_order_[static_cast<std::size_t>(order) - 1] = nodes_on_lattice(order);
    if (how.linearize) parts_ = halved(how.levels);
    const auto corner = [](const Field& f) { return f.location == FieldLocation::corner; };
    with_entries_ = std::ranges::any_of(mesh.fields, corner);
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
      nodes_.push_back(node_at(cell, t, point, n));
      if (with_entries_) entries_.push_back(place_of(cell, t, point, n));
    }
    if (parents_.size() == std::numeric_limits<CellId>::max())
      throw InputError("mesh", "its cells make too many tetrahedra (at most 2^32 - 1 expected)");
    parents_.push_back(cell);
    kinds_.push_back(kind_of(CellShape::tetrahedron, order));
    elems_.push_back(nodes_.size());
  }

  [[nodiscard]] Place place_of(CellId cell, const CornerTetrahedron& t, const LatticePoint& point,
                               unsigned n) const {
    Place place{cell, {}};
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
  NodeId new_node(const PointKey& key, const Place& place) {
    const std::size_t next = mesh_.node_count() + places_.size();
    if (next >= kNone)
      throw InputError("mesh", "its cells need too many nodes (at most 2^32 - 1 expected)");
    const auto [known, is_new] = new_nodes_.try_emplace(key, static_cast<NodeId>(next));
    if (is_new) places_.push_back(place);
    return known->second;
  }

  // The centre of a cell; all four weights of its key are 0.
  NodeId center_of(CellId cell) {
    return new_node({{cell, kNone, kNone, kNone}, {}}, {cell, reference_center(mesh_.kinds[cell])});
  }

  NodeId node_at(CellId cell, const CornerTetrahedron& t, const LatticePoint& point, unsigned n) {
    const auto own = mesh_.cell_nodes(cell);
    if (const auto number = own_node(mesh_.kinds[cell], t, point, n))
      return *number == kCellCenter ? center_of(cell) : own[*number];
    std::array<std::pair<NodeId, std::uint16_t>, 4> between;
    for (std::size_t k = 0; k < 4; ++k) {
      if (point[k] == 0)
        between[k] = {kNone, std::uint16_t{0}};
      else
        between[k] = {t[k] == kCellCenter ? center_of(cell) : own[t[k]], point[k]};
    }
    std::ranges::sort(between);
    PointKey key{};
    for (std::size_t k = 0; k < 4; ++k) std::tie(key.nodes[k], key.weights[k]) = between[k];
    return new_node(key, place_of(cell, t, point, n));
  }

  // Interpolates `width` values per node; values_of(i) points to those of the cell's node i.
  template <typename ValuesOf>
  static void append_interpolated(CellKind kind, const std::array<double, 3>& xi, std::size_t width,
                                  const ValuesOf& values_of, std::vector<double>& result) {
    std::array<double, kMaxNodesPerCell> shape;
    shape_functions<double>(kind, xi, shape);
    for (std::size_t c = 0; c < width; ++c) {
      double sum = 0;
      for (std::size_t i = 0; i < hiac::node_count(kind); ++i) sum += shape[i] * values_of(i)[c];
      result.push_back(sum);
    }
  }

  // Returns the values at those old and new nodes that are used.
  [[nodiscard]] SharedArray<double> at_nodes(std::span<const double> values,
                                             std::size_t width) const {
    std::vector<double> result;
    result.reserve(used_.size() * width);
    for (const NodeId node : used_) {
      if (node < mesh_.node_count()) {
        const auto tuple = values.subspan(node * width, width);
        result.insert(result.end(), tuple.begin(), tuple.end());
        continue;
      }
      const Place& place = places_[node - mesh_.node_count()];
      const auto nodes = mesh_.cell_nodes(place.cell);
      append_interpolated(
          mesh_.kinds[place.cell], place.xi, width,
          [&](std::size_t i) { return values.data() + nodes[i] * width; }, result);
    }
    return result;
  }

  [[nodiscard]] SharedArray<double> at_entries(std::span<const double> values,
                                               std::size_t width) const {
    std::vector<double> result;
    result.reserve(entries_.size() * width);
    for (const Place& place : entries_) {
      const double* first = values.data() + mesh_.elems[place.cell] * width;
      append_interpolated(
          mesh_.kinds[place.cell], place.xi, width,
          [&](std::size_t i) { return first + i * width; }, result);
    }
    return result;
  }

  [[nodiscard]] SharedArray<double> at_cells(std::span<const double> values,
                                             std::size_t width) const {
    std::vector<double> result;
    result.reserve(parents_.size() * width);
    for (const CellId cell : parents_) {
      const auto tuple = values.subspan(cell * width, width);
      result.insert(result.end(), tuple.begin(), tuple.end());
    }
    return result;
  }

  // Renumbers the nodes that are used, in their order.
  void drop_unused() {
    std::vector<NodeId> number(mesh_.node_count() + places_.size(), kNone);
    for (const NodeId node : nodes_) number[node] = 0;
    for (NodeId node = 0; node < number.size(); ++node) {
      if (number[node] == kNone) continue;
      number[node] = static_cast<NodeId>(used_.size());
      used_.push_back(node);
    }
    for (NodeId& node : nodes_) node = number[node];
  }

  SubdividedMesh finish() {
    drop_unused();
    SubdividedMesh result;
    result.new_nodes = places_.size();
    result.dropped_tetrahedra = dropped_tetrahedra_;
    result.dropped_nodes = mesh_.node_count() + places_.size() - used_.size();
    ZooMesh& mesh = result.mesh;
    mesh.xyz = at_nodes(mesh_.xyz.view(), 3);
    for (const Field& field : mesh_.fields) {
      const auto values = field.values.view();
      mesh.fields.push_back(field);
      mesh.fields.back().values =
          field.location == FieldLocation::node   ? at_nodes(values, field.components)
          : field.location == FieldLocation::cell ? at_cells(values, field.components)
                                                  : at_entries(values, field.components);
    }
    mesh.metadata = mesh_.metadata;
    mesh.kinds = std::move(kinds_);
    mesh.elems = std::move(elems_);
    mesh.nodes = std::move(nodes_);
    return result;
  }

  const ZooMesh& mesh_;
  Subdivision how_;
  std::array<std::vector<LatticePoint>, 3> nodes_of_order_;
  std::vector<LatticeTetrahedron> parts_;
  bool with_entries_ = false;
  // of the tetrahedra
  std::vector<CellKind> kinds_;
  std::vector<std::uint64_t> elems_{0};
  std::vector<NodeId> nodes_;  // new nodes are numbered after the old ones
  std::vector<CellId> parents_;
  std::vector<Place> entries_;  // for each entry of nodes_, if a field lives on corners
  std::unordered_map<PointKey, NodeId, PointHash> new_nodes_;
  std::vector<Place> places_;  // of the new nodes
  std::uint64_t dropped_tetrahedra_ = 0;
  std::vector<NodeId> used_;
};

}  // namespace

SubdividedMesh subdivide_cells(const ZooMesh& mesh, const Subdivision& how) {
  return Subdivider(mesh, how).subdivide();
}

}  // namespace hiac

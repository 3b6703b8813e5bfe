#include "hiac/mesh/boundary_surface.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "hiac/base/error.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Position = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;

constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();

// A point of a cell: one of its corners, or where it is in the reference cell.
struct Place {
  CellId cell;
  std::uint8_t corner;  // kNotACorner: `xi` says where it is
  Position xi;
};
constexpr std::uint8_t kNotACorner = 0xFF;

// A point of a face: its corners' weights, of which the sum is a power of four or of two.
using Weights = std::array<unsigned, 4>;

// A point on an edge: its end nodes, the lesser first, and the steps from there.
struct EdgePoint {
  NodeId low, high;
  unsigned steps;
  bool operator==(const EdgePoint&) const = default;
};
struct EdgeHash {
  std::size_t operator()(const EdgePoint& p) const {
    constexpr std::uint64_t kMix = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
    std::uint64_t hash = ((std::uint64_t{p.low} << 32) | p.high) * kMix;
    hash = (hash ^ (hash >> 32) ^ p.steps) * kMix;
    return hash ^ (hash >> 32);
  }
};

// Six times the volume within a cell's faces, each cut into triangles: its sign says whether they
// turn counter-clockwise as seen from outside.
double six_volumes(const ZooMesh& mesh, CellId cell) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto from_first = [&](std::size_t k) {
    Position p{};
    for (std::size_t c = 0; c < 3; ++c)
      p[c] = mesh.position(nodes[k])[c] - mesh.position(nodes[0])[c];
    return p;
  };
  double sum = 0;
  for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces)
    for (std::size_t k = 2; k < face.corner_count; ++k) {
      const Position a = from_first(face.corners[0]), b = from_first(face.corners[k - 1]),
                     c = from_first(face.corners[k]);
      sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
  return sum;
}

class BoundaryBuilder {
 public:
  BoundaryBuilder(const ZooMesh& mesh, unsigned levels)
      : mesh_(mesh), n_(1U << levels), point_of_node_(mesh.node_count(), kNoPoint) {
    keep_visits_ = std::ranges::any_of(
        mesh.fields, [](const Field& f) { return f.location == FieldLocation::corner; });
  }

  BoundarySurface build() {
    if (mesh_.adjacency)
      add_faces(*mesh_.adjacency);
    else
      add_faces(build_face_adjacency(mesh_));
    surface_.xyz = at_points(mesh_.xyz.view(), 3);
    for (const Field& field : mesh_.fields) add_field(field);
    return std::move(surface_);
  }

 private:
  void add_faces(const FaceAdjacency& adjacency) {
    std::size_t number = 0;
    for (CellId cell = 0; cell < mesh_.cell_count(); ++cell) {
      std::optional<bool> turned;
      for (const ShapeFace& face : topology_of(mesh_.kinds[cell]).faces) {
        if (adjacency.neighbors[number++] != kNoCell) continue;
        if (!turned) turned = six_volumes(mesh_, cell) < 0;
        add_face(cell, face, *turned);
      }
    }
  }

  void add_face(CellId cell, const ShapeFace& face, bool turned) {
    const std::size_t first = surface_.triangles.size();
    if (face.corner_count == 3)
      add_triangle_face(cell, face);
    else
      add_quadrilateral_face(cell, face);
    // corners at the same node leave no area
    const auto begin = surface_.triangles.begin() + static_cast<std::ptrdiff_t>(first);
    surface_.triangles.erase(std::remove_if(begin, surface_.triangles.end(),
                                            [](const Triangle& t) {
                                              return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
                                            }),
                             surface_.triangles.end());
    if (turned)
      for (std::size_t t = first; t < surface_.triangles.size(); ++t)
        std::swap(surface_.triangles[t][1], surface_.triangles[t][2]);
    cells_.resize(surface_.triangles.size(), cell);
  }

  void add_triangle_face(CellId cell, const ShapeFace& face) {
    std::vector<std::uint32_t> points;  // row after row, each shorter by one
    for (unsigned j = 0; j <= n_; ++j)
      for (unsigned i = 0; i + j <= n_; ++i)
        points.push_back(point_at(cell, face, {n_ - i - j, i, j, 0}, n_));
    for (std::size_t j = 0, row = 0; j < n_; row += n_ + 1 - j, ++j) {
      const std::size_t next = row + n_ + 1 - j;
      for (std::size_t i = 0; i + j < n_; ++i) {
        surface_.triangles.push_back({points[row + i], points[row + i + 1], points[next + i]});
        if (i + j + 1 < n_)
          surface_.triangles.push_back(
              {points[row + i + 1], points[next + i + 1], points[next + i]});
      }
    }
  }

  void add_quadrilateral_face(CellId cell, const ShapeFace& face) {
    std::vector<std::uint32_t> points;
    for (unsigned j = 0; j <= n_; ++j)
      for (unsigned i = 0; i <= n_; ++i)
        points.push_back(point_at(
            cell, face, {(n_ - i) * (n_ - j), i * (n_ - j), i * j, (n_ - i) * j}, n_ * n_));
    const auto nodes = mesh_.cell_nodes(cell);
    const auto least = std::ranges::min_element(face.corners, {},
                                                [&](std::uint8_t corner) { return nodes[corner]; });
    const bool even = (least - face.corners.begin()) % 2 == 0;
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t i = 0; i < n_; ++i) {
        const std::size_t at = j * (n_ + 1) + i;
        const std::array<std::uint32_t, 4> q{points[at], points[at + 1], points[at + n_ + 2],
                                             points[at + n_ + 1]};
        if (even) {
          surface_.triangles.push_back({q[0], q[1], q[2]});
          surface_.triangles.push_back({q[0], q[2], q[3]});
        } else {
          surface_.triangles.push_back({q[0], q[1], q[3]});
          surface_.triangles.push_back({q[1], q[2], q[3]});
        }
      }
  }

  // The point of a face with these weights, of which the sum is `sum`.
  std::uint32_t point_at(CellId cell, const ShapeFace& face, const Weights& weights, unsigned sum) {
    Place place{cell, kNotACorner, {}};
    std::array<std::size_t, 4> with_weight{};
    std::size_t count = 0;
    const auto reference = reference_nodes(mesh_.kinds[cell]);
    for (std::size_t k = 0; k < face.corner_count; ++k) {
      if (weights[k] == 0) continue;
      with_weight[count++] = k;
      for (std::size_t c = 0; c < 3; ++c)
        place.xi[c] += weights[k] * reference[face.corners[k]][c] / sum;
    }
    const auto nodes = mesh_.cell_nodes(cell);
    const auto node = [&](std::size_t k) { return nodes[face.corners[with_weight[k]]]; };
    std::uint32_t point = kNoPoint;
    if (count == 1) {
      place.corner = face.corners[with_weight[0]];
      point = known_or_new(point_of_node_[node(0)], place);
    } else if (count == 2 && node(0) != node(1)) {
      const std::size_t far = node(0) < node(1) ? 1 : 0;
      const EdgePoint edge{node(1 - far), node(far), weights[with_weight[far]] * n_ / sum};
      point = known_or_new(edge_points_.try_emplace(edge, kNoPoint).first->second, place);
    } else {
      point = known_or_new(point, place);
    }
    if (keep_visits_) visits_.emplace_back(point, place);
    return point;
  }

  std::uint32_t known_or_new(std::uint32_t& known, const Place& place) {
    if (known != kNoPoint) return known;
    if (places_.size() == kNoPoint)
      throw InputError("mesh", "its boundary has too many points (at most 2^32 - 1 expected)");
    known = static_cast<std::uint32_t>(places_.size());
    places_.push_back(place);
    return known;
  }

  // Adds to `sums` the interpolated tuple at a place; tuple_of(i) is where that of the cell's node
  // i begins in `values`.
  template <typename TupleOf>
  void add_interpolated(const Place& place, std::span<const double> values, std::size_t width,
                        const TupleOf& tuple_of, double* sums) const {
    const CellKind kind = mesh_.kinds[place.cell];
    if (place.corner != kNotACorner) {
      for (std::size_t c = 0; c < width; ++c) sums[c] += values[tuple_of(place.corner) * width + c];
      return;
    }
    std::array<double, kMaxNodesPerCell> shape{};
    shape_functions<double>(kind, place.xi, shape);
    for (std::size_t i = 0; i < node_count(kind); ++i)
      for (std::size_t c = 0; c < width; ++c)
        sums[c] += shape[i] == 0 ? 0 : shape[i] * values[tuple_of(i) * width + c];
  }

  [[nodiscard]] std::vector<double> at_points(std::span<const double> values,
                                              std::size_t width) const {
    std::vector<double> result(places_.size() * width);
    for (std::size_t p = 0; p < places_.size(); ++p) {
      const auto nodes = mesh_.cell_nodes(places_[p].cell);
      add_interpolated(
          places_[p], values, width, [&](std::size_t i) { return std::size_t{nodes[i]}; },
          &result[p * width]);
    }
    return result;
  }

  // The means over the faces at each point.
  [[nodiscard]] std::vector<double> means(std::span<const double> values, std::size_t width) const {
    std::vector<double> result(places_.size() * width);
    std::vector<double> counts(places_.size());
    for (const auto& [point, place] : visits_) {
      const std::uint64_t first = mesh_.elems[place.cell];
      add_interpolated(
          place, values, width, [&](std::size_t i) { return first + i; }, &result[point * width]);
      ++counts[point];
    }
    for (std::size_t i = 0; i < result.size(); ++i) result[i] /= counts[i / width];
    return result;
  }

  void add_field(const Field& field) {
    Field found{field.name, field.unit, FieldLocation::node, field.components, {}};
    const std::span<const double> values = field.values.view();
    const std::size_t width = field.components;
    if (field.location == FieldLocation::node) {
      found.values = at_points(values, width);
    } else if (field.location == FieldLocation::corner) {
      found.values = means(values, width);
      surface_.averaged.push_back(field.name);
    } else {
      found.location = FieldLocation::cell;
      std::vector<double> own;
      for (const CellId cell : cells_)
        for (std::size_t c = 0; c < width; ++c) own.push_back(values[cell * width + c]);
      found.values = std::move(own);
    }
    surface_.fields.push_back(std::move(found));
  }

  const ZooMesh& mesh_;
  unsigned n_;  // steps along an edge
  bool keep_visits_ = false;
  std::vector<std::uint32_t> point_of_node_;
  std::unordered_map<EdgePoint, std::uint32_t, EdgeHash> edge_points_;
  std::vector<Place> places_;                            // of every point
  std::vector<std::pair<std::uint32_t, Place>> visits_;  // of every point from every face
  std::vector<CellId> cells_;                            // of every triangle
  BoundarySurface surface_;
};

}  // namespace

unsigned default_boundary_levels(const ZooMesh& mesh) {
  constexpr unsigned kCurved = 2;
  const bool linear = std::ranges::all_of(
      mesh.kinds, [](CellKind kind) { return order_of(kind) == CellOrder::linear; });
  return linear ? 0 : kCurved;
}

BoundarySurface boundary_surface(const ZooMesh& mesh, unsigned levels) {
  return BoundaryBuilder(mesh, levels).build();
}

}  // namespace hiac

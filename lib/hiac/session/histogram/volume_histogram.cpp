#include "hiac/session/histogram/volume_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/base/parallel.hpp"
#include "hiac/geometry/cell_volume.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/session/histogram/cell_pieces.hpp"
#include "hiac/session/histogram/tetrahedron_shares.hpp"

namespace hiac {
namespace {

double volume_between(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  return std::abs(dot(minus(b, a), cross(minus(c, a), minus(d, a)))) / 6;
}

/// The histogram of some of the cells.
class Part {
 public:
  Part(const ZooMesh& mesh, const Field& field, std::span<const double> edges)
      : mesh_(mesh), field_(field), edges_(edges), volumes(edges.size() - 1) {}

  void add(CellId cell) {
    if (!find_values(cell))
      without_value += std::abs(signed_volume(mesh_, cell));
    else if (field_.location == FieldLocation::cell)
      add_tetrahedron({values_[0], values_[0], values_[0], values_[0]},
                      std::abs(signed_volume(mesh_, cell)), edges_, volumes, outside);
    else if (mesh_.kinds[cell] == CellKind::tetrahedron4)
      add_linear_tetrahedron(cell);
    else
      add_pieces(cell);
  }

 private:
  /// Finds the values at the cell's nodes; false if one is not finite.
  bool find_values(CellId cell) {
    const auto nodes = mesh_.cell_nodes(cell);
    const std::size_t count = field_.location == FieldLocation::cell ? 1 : nodes.size();
    bool all_finite = true;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t index = field_.location == FieldLocation::node   ? nodes[i]
                                : field_.location == FieldLocation::cell ? cell
                                                                         : mesh_.elems[cell] + i;
      values_[i] = field_.values[index];
      all_finite = all_finite && std::isfinite(values_[i]);
    }
    return all_finite;
  }

  [[nodiscard]] Vector position(NodeId node) const {
    const auto p = mesh_.position(node);
    return {p[0], p[1], p[2]};
  }

  void add_linear_tetrahedron(CellId cell) {
    const auto nodes = mesh_.cell_nodes(cell);
    const double volume = volume_between(position(nodes[0]), position(nodes[1]), position(nodes[2]),
                                         position(nodes[3]));
    add_tetrahedron({values_[0], values_[1], values_[2], values_[3]}, volume, edges_, volumes,
                    outside);
  }

  void add_pieces(CellId cell) {
    const CellPieces& cut = cell_pieces(mesh_.kinds[cell]);
    const auto nodes = mesh_.cell_nodes(cell);
    const Vector origin = position(nodes[0]);
    std::array<Vector, kMaxNodesPerCell> corners;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      corners[i] = minus(mesh_.position(nodes[i]), origin);
    places_.assign(cut.points.size(), Vector{});
    at_places_.assign(cut.points.size(), 0);
    for (std::size_t p = 0; p < cut.points.size(); ++p)
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double share = cut.points[p][i];
        for (std::size_t c = 0; c < 3; ++c) places_[p][c] += share * corners[i][c];
        at_places_[p] += share * values_[i];
      }
    piece_volumes_.clear();
    double sum = 0;
    for (const auto& [a, b, c, d] : cut.pieces)
      sum += piece_volumes_.emplace_back(
          volume_between(places_[a], places_[b], places_[c], places_[d]));
    if (!(sum > 0)) return;
    const double scale = std::abs(signed_volume(mesh_, cell)) / sum;
    for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
      const auto& [a, b, c, d] = cut.pieces[i];
      add_tetrahedron({at_places_[a], at_places_[b], at_places_[c], at_places_[d]},
                      scale * piece_volumes_[i], edges_, volumes, outside);
    }
  }

  const ZooMesh& mesh_;
  const Field& field_;
  std::span<const double> edges_;
  std::array<double, kMaxNodesPerCell> values_{};
  std::vector<Vector> places_;
  std::vector<double> at_places_, piece_volumes_;

 public:
  std::vector<double> volumes;
  std::array<double, 2> outside{};
  double without_value = 0;
};

}  // namespace

std::vector<double> bin_edges(double low, double high, std::size_t count, TransferScale scale) {
  const bool is_log = scale == TransferScale::log;
  const double a = is_log ? std::log(low) : low, b = is_log ? std::log(high) : high;
  std::vector<double> edges(count + 1);
  for (std::size_t k = 0; k <= count; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(count);
    const double at = (1 - t) * a + t * b;
    edges[k] = is_log ? std::exp(at) : at;
  }
  edges.front() = low;
  edges.back() = high;
  // where a range of few numbers rounds
  for (std::size_t k = 1; k <= count; ++k) edges[k] = std::clamp(edges[k], edges[k - 1], high);
  return edges;
}

VolumeHistogram volume_histogram(const ZooMesh& mesh, const Field& field,
                                 std::span<const double> edges) {
  // parts of a fixed number: their sums do not depend on the number of threads
  constexpr std::size_t kParts = 64;
  std::vector<Part> parts(kParts, Part(mesh, field, edges));
  const std::size_t share = mesh.cell_count() / kParts + 1;
  parallel_for(kParts, 1, [&](IndexRange range) {
    for (std::size_t part = range.begin; part < range.end; ++part)
      for (std::size_t cell = part * share; cell < std::min((part + 1) * share, mesh.cell_count());
           ++cell)
        parts[part].add(static_cast<CellId>(cell));
  });
  VolumeHistogram histogram;
  histogram.edges.assign(edges.begin(), edges.end());
  histogram.volumes.resize(edges.size() - 1);
  for (const Part& part : parts) {
    for (std::size_t k = 0; k < histogram.volumes.size(); ++k)
      histogram.volumes[k] += part.volumes[k];
    for (std::size_t side = 0; side < 2; ++side) histogram.outside[side] += part.outside[side];
    histogram.without_value += part.without_value;
  }
  return histogram;
}

}  // namespace hiac

#include "formats/common/cells/recognized_cells.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac::formats {
namespace {

constexpr std::size_t kHighestOrder = 9;
/// Nodes must be closer to their places than this fraction of the spacing.
constexpr double kFurthest = 1.0 / 3;

using Point = std::array<double, 3>;

Point corner_of(const CellConversion& conversion, const NodePositions& cell, std::size_t n) {
  return cell[conversion.permutation.empty() ? n : conversion.permutation[n]];
}

double squared_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

std::vector<double> shape_functions_at(CellKind kind, const Point& at) {
  std::vector<double> values(node_count(kind));
  shape_functions<double>(kind, at, std::span(values));
  return values;
}

/// For every node of the file, its squared distances from the lattice points as the corners map
/// them, in units of the cell's size, summed over the cells.
std::vector<double> distances(const CellConversion& conversion, const Lattice& lattice,
                              std::span<const NodePositions> cells) {
  const std::size_t count = lattice.points.size();
  std::vector<std::vector<double>> shapes;
  for (const Point& point : lattice.points)
    shapes.push_back(shape_functions_at(*conversion.corners, point));
  std::vector<double> sums(cells.front().size() * count, 0.0);
  for (const NodePositions& cell : cells) {
    double size = 0;
    for (std::size_t n = 1; n < node_count(*conversion.corners); ++n)
      size = std::max(
          size, squared_distance(corner_of(conversion, cell, 0), corner_of(conversion, cell, n)));
    if (!(size > 0)) continue;
    for (std::size_t p = 0; p < count; ++p) {
      Point at{};
      for (std::size_t n = 0; n < shapes[p].size(); ++n)
        for (std::size_t c = 0; c < 3; ++c)
          at[c] += shapes[p][n] * corner_of(conversion, cell, n)[c];
      for (std::size_t f = 0; f < cell.size(); ++f)
        sums[f * count + p] += squared_distance(at, cell[f]) / size;
    }
  }
  return sums;
}

struct Match {
  std::vector<std::optional<std::size_t>> nodes;  ///< at the lattice's points
  double misfit = 0;                              ///< root mean square, in units of the spacing
};

std::optional<Match> match(const CellConversion& conversion, const Lattice& lattice,
                           std::span<const NodePositions> cells) {
  const std::vector<double> sums = distances(conversion, lattice, cells);
  const std::size_t count = lattice.points.size();
  Match result{std::vector<std::optional<std::size_t>>(count), 0};
  double total = 0;
  for (std::size_t f = 0; f < cells.front().size(); ++f) {
    const auto row = std::span(sums).subspan(f * count, count);
    const auto nearest =
        static_cast<std::size_t>(std::min_element(row.begin(), row.end()) - row.begin());
    if (result.nodes[nearest]) return std::nullopt;
    result.nodes[nearest] = f;
    total += row[nearest];
  }
  const auto samples = static_cast<double>(cells.size() * cells.front().size());
  result.misfit = std::sqrt(total / samples) * static_cast<double>(lattice.order);
  if (!(result.misfit < kFurthest)) return std::nullopt;
  return result;
}

/// The nodes of the file that no node of the kind takes over unchanged (with a single weight).
std::vector<RecognizedCell::LeftOut> nodes_left_out(const Lattice& lattice, const Match& match,
                                                    const RecognizedCell& cell) {
  std::vector<RecognizedCell::LeftOut> result;
  for (std::size_t p = 0; p < lattice.points.size(); ++p) {
    if (!match.nodes[p]) continue;
    const bool kept = std::any_of(cell.weights.begin(), cell.weights.end(), [&](const Weights& w) {
      return w.size() == 1 && w.front().first == *match.nodes[p];
    });
    if (!kept)
      result.push_back({*match.nodes[p], shape_functions_at(cell.kind, lattice.points[p])});
  }
  return result;
}

}  // namespace

std::optional<RecognizedCell> recognized_cell(const CellConversion& conversion,
                                              std::span<const NodePositions> cells) {
  if (!conversion.corners || cells.empty()) return std::nullopt;
  const CellShape shape = shape_of(*conversion.corners);
  const std::size_t nodes = cells.front().size();
  std::optional<RecognizedCell> best;
  double misfit = kFurthest;
  for (std::size_t order = 2; order <= kHighestOrder; ++order) {
    if (nodes < corner_count(*conversion.corners) + (order - 1) * edge_count(*conversion.corners))
      break;
    const Lattice lattice = lattice_of(shape, order);
    if (nodes > lattice.points.size()) continue;
    const auto found = match(conversion, lattice, cells);
    if (!found || found->misfit >= misfit) continue;
    auto weights = weights_of_nearest(lattice, found->nodes);
    if (!weights) continue;
    misfit = found->misfit;
    best = RecognizedCell{nearest_kind(lattice), order, std::move(*weights), {}};
    best->left_out = nodes_left_out(lattice, *found, *best);
  }
  return best;
}

}  // namespace hiac::formats

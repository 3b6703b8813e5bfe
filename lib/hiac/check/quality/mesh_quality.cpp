#include "hiac/check/quality/mesh_quality.hpp"

#include <array>
#include <cmath>
#include <span>

#include "hiac/base/parallel.hpp"

namespace hiac {
namespace {

constexpr std::size_t kMeshQualityGrain = 1 << 12;

std::vector<double> every(double step, double from, double to) {
  std::vector<double> edges;
  const auto count = static_cast<int>(std::lround((to - from) / step));
  for (int i = 0; i <= count; ++i) edges.push_back(from + i * step);
  return edges;
}

// The edges of a figure's histogram; those of volumes are parts of `unit`.
std::vector<double> edges_of(QualityFigure figure, double unit) {
  using enum QualityFigure;
  switch (figure) {
    case volume: {
      std::vector<double> edges{0, 1e-6, 1e-4, 0.01, 0.1, 0.25, 0.5, 0.75, 1, 1.5, 2, 5, 10, 100};
      for (double& edge : edges) edge *= unit;
      return edges;
    }
    case least_dihedral:
    case largest_dihedral:
      return every(10, 10, 180);
    case edge_ratio:
    case aspect_ratio:
    case radius_ratio:
    case condition:
      return {1.2, 1.5, 2, 2.5, 3, 4, 6, 10, 20, 50, 100, 1000};
    case scaled_jacobian:
    case jacobian_ratio: {
      std::vector<double> edges;
      for (int tenth = 0; tenth <= 10; ++tenth) edges.push_back(tenth / 10.0);
      return edges;
    }
  }
  return {};
}

std::vector<CellId> cells_of(const ZooMesh& mesh, CellKind kind) {
  std::vector<CellId> cells;
  for (std::size_t i = 0; i < mesh.cell_count(); ++i)
    if (mesh.kinds[i] == kind) cells.push_back(static_cast<CellId>(i));
  return cells;
}

Distribution figure_of(const ZooMesh& mesh, std::span<const CellId> cells, QualityFigure figure,
                       int hand, double& sum) {
  std::vector<double> values(cells.size());
  parallel_for(cells.size(), kMeshQualityGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      values[i] = quality_of(mesh, cells[i], figure, hand);
  });
  sum = sum_of(values);
  const double unit = std::abs(sum) / static_cast<double>(cells.size());
  Distribution found = distribution_of(values, edges_of(figure, unit));
  if (found.count > 0) {
    found.least_at = cells[found.least_at];
    found.largest_at = cells[found.largest_at];
  }
  return found;
}

}  // namespace

std::vector<KindQuality> mesh_quality(const ZooMesh& mesh, int hand) {
  std::array<bool, kKindCount> present{};
  for (const CellKind kind : mesh.kinds) present[static_cast<std::size_t>(kind)] = true;
  std::vector<KindQuality> quality;
  for (std::size_t k = 0; k < kKindCount; ++k) {
    if (!present[k]) continue;
    const auto kind = static_cast<CellKind>(k);
    const std::vector<CellId> cells = cells_of(mesh, kind);
    KindQuality of{kind, cells.size(), 0, {}};
    for (std::size_t f = 0; f < kFigureCount; ++f) {
      const auto figure = static_cast<QualityFigure>(f);
      if (!has_figure(kind, figure)) continue;
      double sum = 0;
      of.figures.push_back({figure, figure_of(mesh, cells, figure, hand, sum)});
      if (figure == QualityFigure::volume) of.volume = sum;
    }
    quality.push_back(std::move(of));
  }
  return quality;
}

}  // namespace hiac

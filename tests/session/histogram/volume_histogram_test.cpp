#include "hiac/session/histogram/volume_histogram.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/geometry/cell_volume.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

double total(const VolumeHistogram& h) {
  return std::accumulate(h.volumes.begin(), h.volumes.end(),
                         h.outside[0] + h.outside[1] + h.without_value);
}

double volume_of(const ZooMesh& mesh) {
  double volume = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    volume += std::abs(signed_volume(mesh, cell));
  return volume;
}

TEST(VolumeHistogram, IsThatOfRandomPlacesInTheCube) {
  ZooMesh mesh = test::random_delaunay(200, 3);
  const auto plane = [](const test::Position& p) { return p[0] + 2 * p[1] - p[2]; };
  test::add_node_field(mesh, "f", plane);
  const std::vector<double> edges = bin_edges(-1, 3, 40, TransferScale::linear);
  const VolumeHistogram found = volume_histogram(mesh, scalar_field(mesh, "f"), edges);
  EXPECT_NEAR(total(found), 1, 1e-13);
  std::vector<double> counts(40);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr int kPlaces = 2'000'000;
  for (int i = 0; i < kPlaces; ++i) {
    const double value = plane({uniform(random), uniform(random), uniform(random)});
    counts[static_cast<std::size_t>((value + 1) * 10)] += 1.0 / kPlaces;
  }
  // five standard deviations
  for (std::size_t k = 0; k < 40; ++k)
    EXPECT_NEAR(found.volumes[k], counts[k], 5 * std::sqrt(found.volumes[k] / kPlaces) + 1e-6);
}

/// One cell of a kind, bent a little, with a field that is not linear.
ZooMesh bent_cell(CellKind kind) {
  std::vector<test::Position> places;
  std::vector<NodeId> nodes;
  for (const auto& p : reference_nodes(kind)) {
    places.push_back(
        {p[0] + 0.03 * p[1] * p[2], p[1] - 0.03 * p[0] * p[0], p[2] + 0.03 * p[0] * p[1]});
    nodes.push_back(static_cast<NodeId>(nodes.size()));
  }
  ZooMesh mesh = test::make_mesh(places, {{kind, nodes}});
  test::add_node_field(mesh, "f", [](const test::Position& p) {
    return p[0] + 2 * p[1] - p[2] + 0.2 * p[0] * (p[1] + p[2]);
  });
  return mesh;
}

/// The same by random places of the reference cell, weighted by the Jacobian determinant.
std::vector<double> sampled(const ZooMesh& mesh, const std::vector<double>& edges) {
  const CellKind kind = mesh.kinds[0];
  const std::size_t count = node_count(kind);
  const auto& field = mesh.fields[0].values;
  std::vector<double> weights(edges.size() - 1), values(count);
  std::vector<std::array<double, 3>> gradients(count);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  double sum = 0;
  for (int i = 0; i < 300'000; ++i) {
    const double scale = kind >= CellKind::wedge7 && kind <= CellKind::wedge29 ? 2 : 1;
    const std::array<double, 3> xi{scale * uniform(random), uniform(random), uniform(random)};
    const double x = xi[0], y = xi[1], z = xi[2];
    const CellShape shape = shape_of(kind);
    if (shape == CellShape::tetrahedron && x + y + z > 1) continue;
    if (shape == CellShape::pyramid && (x + z > 1 || y + z > 1)) continue;
    if (shape == CellShape::prism && x + y > 1) continue;
    if (shape == CellShape::wedge && x > 2 - y - z) continue;
    shape_functions<double>(kind, xi, values);
    shape_gradients<double>(kind, xi, gradients);
    std::array<std::array<double, 3>, 3> j{};
    double f = 0;
    for (std::size_t n = 0; n < count; ++n) {
      f += values[n] * field[n];
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
          j[a][b] += mesh.position(static_cast<NodeId>(n))[a] * gradients[n][b];
    }
    const double weight = std::abs(j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                                   j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                                   j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]));
    sum += weight;
    const auto bin = std::upper_bound(edges.begin(), edges.end(), f) - edges.begin();
    if (bin > 0 && static_cast<std::size_t>(bin) < edges.size())
      weights[static_cast<std::size_t>(bin) - 1] += weight;
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

TEST(VolumeHistogram, IsThatOfRandomPlacesInCellsOfEveryKind) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const ZooMesh mesh = bent_cell(static_cast<CellKind>(k));
    const std::vector<double> edges = bin_edges(-1.2, 3.5, 12, TransferScale::linear);
    const VolumeHistogram found = volume_histogram(mesh, mesh.fields[0], edges);
    const double volume = volume_of(mesh);
    EXPECT_NEAR(total(found), volume, 1e-13 * volume);
    const std::vector<double> truth = sampled(mesh, edges);
    for (std::size_t bin = 0; bin < truth.size(); ++bin)
      EXPECT_NEAR(found.volumes[bin] / volume, truth[bin], 0.01) << k << " " << bin;
  }
}

TEST(VolumeHistogram, ErrsByTheSquareOfTheSizeOfBricks) {
  const std::vector<double> edges = bin_edges(0, 2, 10, TransferScale::linear);
  // bricks of every size have the same field
  const auto measured = [&](std::size_t n) {
    ZooMesh mesh = test::structured(n, test::Cut::bricks);
    test::add_node_field(mesh, "f",
                         [](const test::Position& p) { return p[0] + p[0] * p[1] * p[2]; });
    return volume_histogram(mesh, mesh.fields.back(), edges).volumes;
  };
  const std::vector<double> truth = measured(32);
  const auto error = [&](std::size_t n) {
    const std::vector<double> found = measured(n);
    double most = 0;
    for (std::size_t k = 0; k < truth.size(); ++k)
      most = std::max(most, std::abs(found[k] - truth[k]));
    return most;
  };
  EXPECT_LT(error(2), 2e-3);
  EXPECT_LT(error(4), error(2) / 3);
  EXPECT_LT(error(8), error(4) / 3);
}

TEST(VolumeHistogram, CountsConstantCellsAndWhatHasNoValue) {
  ZooMesh mesh = test::structured(2, test::Cut::bricks);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh.fields.push_back(
      {"c", "", FieldLocation::cell, 1, std::vector<double>{0, 1, 1, 2, 2.5, 3, 9, nan}});
  const std::vector<double> edges{0.5, 1.5, 2.5, 3};
  const VolumeHistogram found = volume_histogram(mesh, mesh.fields.back(), edges);
  EXPECT_EQ(found.volumes, (std::vector<double>{0.25, 0.125, 0.25}));
  EXPECT_EQ(found.outside, (std::array<double, 2>{0.125, 0.125}));
  EXPECT_EQ(found.without_value, 0.125);
}

TEST(VolumeHistogram, DoesNotDependOnTheNumberOfThreads) {
  ZooMesh mesh = test::random_delaunay(3000, 5);
  test::add_node_field(mesh, "f", test::smooth_field);
  const std::vector<double> edges = bin_edges(0.01, 1, 100, TransferScale::log);
  const VolumeHistogram many = volume_histogram(mesh, mesh.fields.back(), edges);
  const ThreadLimit one(1);
  EXPECT_EQ(volume_histogram(mesh, mesh.fields.back(), edges).volumes, many.volumes);
}

TEST(BinEdges, AreEvenAndEndWhereTheyShould) {
  const std::vector<double> even = bin_edges(-1, 3, 4, TransferScale::linear);
  EXPECT_EQ(even, (std::vector<double>{-1, 0, 1, 2, 3}));
  const std::vector<double> log = bin_edges(1e-3, 1e3, 6, TransferScale::log);
  EXPECT_EQ(log.front(), 1e-3);
  EXPECT_EQ(log.back(), 1e3);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(log[k + 1] / log[k], 10, 1e-13);
  const double low = 1e16;
  const std::vector<double> few = bin_edges(low, low + 4, 1024, TransferScale::linear);
  EXPECT_TRUE(std::is_sorted(few.begin(), few.end()));
  EXPECT_EQ(few.back(), low + 4);
}

}  // namespace
}  // namespace hiac

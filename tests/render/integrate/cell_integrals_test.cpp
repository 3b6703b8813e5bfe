// Segments integrated many at a time against the same integrated one at a time (both together are
// held against brute force by higher_orders_test.cpp), and the fields along them against shape
// functions.

#include "hiac/render/integrate/cell_integrals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/element/chebyshev_points.hpp"
#include "hiac/element/field_along_ray.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/optics/polynomial_piece.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/integrate/cell_interpolants.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;

struct NamedMesh {
  const char *cells, *map;
  ZooMesh mesh;
};

test::Position moved_inside(const test::Position& p) { return test::warped(p, 0.06); }

// Affine cells, cells that are not, and cells with bent faces or edges.
std::vector<NamedMesh> meshes_of(CellOrder order) {
  std::vector<NamedMesh> meshes;
  const std::size_t n = test::tried(8) / 4;
  for (const auto& [name, mesh] : {std::pair{"tetrahedra", test::structured(n, Cut::tetrahedra)},
                                   {"pyramids", test::structured(n, Cut::pyramids)},
                                   {"prisms", test::structured(n, Cut::prisms)},
                                   {"wedges", test::two_wedges()},
                                   {"bricks", test::structured(n, Cut::bricks)}}) {
    meshes.push_back({name, "sheared", test::of_order(test::moved(mesh, test::sheared), order)});
    meshes.push_back({name, "tapered", test::of_order(test::moved(mesh, test::tapered), order)});
    ZooMesh bent = order == CellOrder::linear
                       ? test::moved(mesh, moved_inside)
                       : test::moved(test::of_order(mesh, order), test::bent);
    meshes.push_back({name, "bent", std::move(bent)});
  }
  return meshes;
}

// The segments of one mesh in a scene.
class Comparison {
 public:
  Comparison(const ZooMesh& mesh, const Scene& scene)
      : mesh_(mesh),
        projector_(scene.camera, scene.image),
        frame_(mesh, scene, projector_),
        tile_{0, 0, static_cast<int>(scene.image.width), static_cast<int>(scene.image.height)} {}

  std::size_t segments = 0, undone = 0;

  // The largest difference of any number, each segment to an error of `allowed`.
  double difference(double allowed) {
    double largest = 0;
    for (CellId cell = 0; cell < mesh_.cell_count(); ++cell)
      largest = std::max(largest, difference(Crossed(*this, cell, allowed), allowed));
    return largest;
  }

  // The largest difference of fields from what shape functions give, along segments on which they
  // may be wrong by `allowed`.
  double field_difference(double allowed) {
    double largest = 0;
    for (CellId cell = 0; cell < mesh_.cell_count(); ++cell) {
      Crossed crossed(*this, cell, 100 * allowed);
      SegmentPieces found;
      interpolate_cell_segments(
          frame_, CellPolynomials(crossed.kind, crossed.nodes, crossed.map, crossed.fields),
          crossed.segments, found);
      for (std::size_t k = 0; k < crossed.crossings.size(); ++k) {
        ++segments;
        const auto pieces = found.of(k);
        if (pieces.empty()) ++undone;
        for (const FieldAlongRay::Piece& piece : pieces)
          largest = std::max(largest, field_difference(crossed, crossed.crossings[k], piece));
      }
    }
    return largest;
  }

 private:
  // A cell and the rays that cross it.
  struct Crossed {
    CellKind kind;
    std::array<CellMap::Point, CellMap::kMostNodes> nodes;
    CellMap map;
    std::vector<CellField> fields;
    std::vector<CellCrossing> crossings;
    CellSegments segments;

    Crossed(const Comparison& of, CellId cell, double allowed)
        : kind(of.mesh_.kinds[cell]),
          nodes(relative_positions(of.mesh_, cell, of.projector_)),
          map(kind, nodes, of.frame_.straightness),
          fields{cell_field(of.mesh_, cell, of.frame_.extinction)} {
      if (!of.frame_.optics.same_field)
        fields.push_back(cell_field(of.mesh_, cell, of.frame_.color));
      for (CellField& field : fields) field.allowed = allowed / 100;
      scan_cell(of.frame_, cell, of.tile_, crossings);
      segments.start(crossings.size(), true);
      for (const CellCrossing& c : crossings) of.add(c, kind, map, allowed, segments);
    }
  };

  [[nodiscard]] double field_difference(const Crossed& crossed, const CellCrossing& c,
                                        const FieldAlongRay::Piece& piece) const {
    const RayStretch stretch = stretch_of(c);
    double largest = 0;
    for (const double u : {0.0, 0.21, 0.5, 0.83, 1.0}) {
      const double part = piece.begin + u * (piece.end - piece.begin);
      const auto xi =
          crossed.map.reference(stretch.at(stretch.front + part * (stretch.back - stretch.front)),
                                stretch.guess(crossed.map));
      std::array<double, kMaxNodesPerCell> shape;
      shape_functions<double>(crossed.kind, xi, shape);
      for (std::size_t f = 0; f < crossed.fields.size(); ++f) {
        double value = 0;
        for (std::size_t k = 0; k < node_count(crossed.kind); ++k)
          value += shape[k] * crossed.fields[f].values[k];
        largest = std::max(largest, std::abs(value - evaluate(piece.fields[f], u)));
      }
    }
    return largest;
  }

  double difference(Crossed crossed, double allowed) {
    const OpticsTables& optics = frame_.optics;
    const auto& [kind, nodes, map, fields, crossings, unused] = crossed;
    CellSegments& together = crossed.segments;
    const FieldAlongRay along(kind, map, fields);
    const auto of = [](const CellField& field, const auto& table) {
      return IntervalRange{classify_value(field.least, table).low,
                           classify_value(field.most, table).high};
    };
    const auto extinction = of(fields.front(), optics.extinction);
    const auto color = of(fields.back(), optics.color);
    integrate_cell_segments(frame_, CellPolynomials(kind, nodes, map, fields), color, extinction,
                            together);
    double largest = 0;
    for (std::size_t k = 0; k < crossings.size(); ++k) {
      ++segments;
      if (together.done[k] == 0) {
        ++undone;
        continue;
      }
      const PlainRadiance alone = integrated(crossings[k], along, together.length[k], allowed);
      const std::array rgb{together.red[k], together.green[k], together.blue[k]};
      for (std::size_t c = 0; c < 3; ++c)
        largest = std::max(largest, std::abs(alone.rgb[c] - rgb[c]));
      largest = std::max(largest, std::abs(alone.transparency - together.transparency[k]));
    }
    return largest;
  }

  void add(const CellCrossing& c, CellKind kind, const CellMap& map, double allowed,
           CellSegments& list) const {
    const double x = c.x + 0.5, y = c.y + 0.5;
    const std::size_t k = list.count++;
    list.x[k] = x;
    list.y[k] = y;
    list.front[k] = c.front;
    list.back[k] = c.back;
    const auto known = collapsed(shape_of(kind), stretch_of(c).guess(map));
    list.known_u[k] = known[0];
    list.known_v[k] = known[1];
    list.known_w[k] = known[2];
    list.length[k] = (c.back - c.front) * projector_.ray_scale(x, y);
    list.allowed[k] = allowed;
  }

  [[nodiscard]] RayStretch stretch_of(const CellCrossing& c) const {
    const double x = c.x + 0.5, y = c.y + 0.5;
    return {projector_.relative_origin(x, y), projector_.direction(x, y), c.front, c.back,
            std::isnan(c.front_reference[0]) ? c.back_reference : c.front_reference};
  }

  [[nodiscard]] PlainRadiance integrated(const CellCrossing& c, const FieldAlongRay& along,
                                         double length, double allowed) const {
    const OpticsTables& optics = frame_.optics;
    std::vector<FieldAlongRay::Piece> pieces;
    along.along(stretch_of(c), pieces);
    PlainRadiance sum;
    for (const FieldAlongRay::Piece& piece : pieces) {
      const PolynomialSegment segment{piece.fields[optics.same_field ? 0 : 1], piece.fields[0],
                                      (piece.end - piece.begin) * length};
      const SegmentRadiance r =
          integrate_segment(segment, optics.color_function, optics.extinction_function,
                            optics.emission ? Glow::emission : Glow::chromaticity, allowed);
      sum.add_behind({r.rgb, r.transparency});
    }
    return sum;
  }

  const ZooMesh& mesh_;
  Projector projector_;
  Frame frame_;
  TileRect tile_;
};

class CellIntegrals : public testing::TestWithParam<CellOrder> {};

TEST_P(CellIntegrals, AreThoseOfSingleSegments) {
  unsigned trial = 0;
  std::size_t segments = 0, undone = 0;
  for (auto& [cells, map, mesh] : meshes_of(GetParam())) {
    test::add_random_field(mesh, "f", FieldLocation::node, 16);
    test::add_random_field(mesh, "g", FieldLocation::node, 17);
    for (const double allowed : {1e-9, 1e-13}) {
      ++trial;
      Scene scene =
          cube_scene(trial % 2 == 0 ? Projection::perspective : Projection::orthographic, 20, 18);
      if (trial / 2 % 2 == 0) scene.volume.glow = Glow::emission;
      if (trial % 3 == 0) scene.volume.color->field = mesh.fields[1].name;
      // a step, and more opacity than a pixel can use
      if (trial % 5 == 0)
        scene.volume.extinction->points = {{0, {1}}, {0.4, {2}}, {0.4, {9}}, {1, {40}}};
      Comparison comparison(mesh, scene);
      EXPECT_LE(comparison.difference(allowed), std::max(2 * allowed, 1e-12))
          << map << " " << cells << ", allowed " << allowed;
      segments += comparison.segments;
      undone += comparison.undone;
    }
  }
  EXPECT_LE(undone, segments / 50);
}

TEST_P(CellIntegrals, FieldsAreThoseOfShapeFunctions) {
  unsigned trial = 0;
  std::size_t segments = 0, undone = 0;
  for (auto& [cells, map, mesh] : meshes_of(GetParam())) {
    test::add_random_field(mesh, "f", FieldLocation::node, 19);
    test::add_random_field(mesh, "g", FieldLocation::node, 20);
    for (const double allowed : {1e-9, 0.0}) {
      Scene scene =
          cube_scene(++trial % 3 == 0 ? Projection::perspective : Projection::orthographic, 14, 12);
      if (trial % 2 == 0) scene.volume.color->field = mesh.fields[1].name;
      Comparison comparison(mesh, scene);
      EXPECT_LE(comparison.field_difference(allowed), std::max(2 * allowed, 1e-12))
          << map << " " << cells << ", allowed " << allowed;
      segments += comparison.segments;
      undone += comparison.undone;
    }
  }
  EXPECT_LE(undone, segments / 50);
}

// In a thick volume pieces are halved until a rule has nodes enough.
TEST_P(CellIntegrals, OfThickVolumesAreThoseOfSingleSegments) {
  ZooMesh mesh =
      test::of_order(test::moved(test::structured(1, Cut::bricks), test::tapered), GetParam());
  test::add_random_field(mesh, "f", FieldLocation::node, 18);
  for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
    Scene scene = cube_scene(Projection::perspective, 12, 10);
    scene.volume.glow = glow;
    scene.volume.extinction->points = {{0, {100}}, {0.3, {2000}}, {0.7, {300}}};
    Comparison comparison(mesh, scene);
    EXPECT_LE(comparison.difference(1e-13), 1e-12);
    EXPECT_EQ(comparison.undone, 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, CellIntegrals,
                         testing::Values(CellOrder::linear, CellOrder::quadratic, CellOrder::cubic),
                         [](const auto& instance) {
                           return "Order" + std::to_string(static_cast<int>(instance.param));
                         });

// Differences of one order more than a polynomial's degree vanish, of fewer factors of the width
// they do not.
TEST(LineQuotients, AreThoseOfShapeFunctions) {
  for (const CellShape shape : {CellShape::pyramid, CellShape::wedge})
    for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic, CellOrder::cubic}) {
      const CellKind kind = kind_of(shape, order);
      const auto [degree, pole_order] = quotient_along_lines(kind);
      const std::array<double, 3> from{0.11, 0.23, 0.07}, step{0.036, 0.021, 0.055};
      const auto difference = [&](std::size_t factors, std::size_t node) {
        const std::size_t n = degree + 1;
        double sum = 0, binomial = 1;
        for (std::size_t j = 0; j <= n; ++j) {
          std::array<double, 3> xi;
          for (std::size_t a = 0; a < 3; ++a) xi[a] = from[a] + static_cast<double>(j) * step[a];
          std::array<double, kMaxNodesPerCell> value;
          shape_functions<double>(kind, xi, value);
          const double width = shape == CellShape::pyramid ? 1 - xi[2] : 2 - xi[1] - xi[2];
          sum += binomial * value[node] * std::pow(width, static_cast<double>(factors));
          binomial *= -static_cast<double>(n - j) / static_cast<double>(j + 1);
        }
        return std::abs(sum);
      };
      double with_all = 0, with_fewer = 0;
      for (std::size_t node = 0; node < node_count(kind); ++node) {
        with_all = std::max(with_all, difference(pole_order, node));
        with_fewer = std::max(with_fewer, difference(pole_order - 1, node));
      }
      EXPECT_LE(with_all, 1e-13) << kind_name(kind);
      EXPECT_GE(with_fewer, 1e-10) << kind_name(kind);
    }
}

// A polynomial through all that a point is predicted from is met there.
TEST(PointPredictions, ReproducePolynomials) {
  const auto power = [](double x, std::size_t n) { return std::pow(2 * x - 1, n); };
  const auto check = [&](const PointPrediction& p, const ChebyshevPoints& known,
                         const ChebyshevPoints& wanted) {
    const double place = wanted.place(p.point);
    if (p.from.size() == 1) {
      EXPECT_NEAR(known.place(p.from[0]), place, 1e-15);
      EXPECT_EQ(p.weights[0], 1);
      return;
    }
    for (std::size_t n = 0; n < p.from.size(); ++n) {
      double sum = 0;
      for (std::size_t i = 0; i < p.from.size(); ++i)
        sum += p.weights[i] * power(known.place(p.from[i]), n);
      EXPECT_NEAR(sum, power(place, n), 1e-12);
    }
  };
  for (std::size_t n = 2; n <= kMostChebyshevDegree; n += 2) {
    const ChebyshevPoints& points = chebyshev_points(n);
    std::vector<bool> known(n + 1, false);
    known[0] = known[n] = true;
    for (const PointPrediction& p : points_in_turn(n)) {
      for (const std::size_t from : p.from) EXPECT_TRUE(known[from]);
      check(p, points, points);
      known[p.point] = true;
    }
    EXPECT_EQ(std::count(known.begin(), known.end(), true), static_cast<std::ptrdiff_t>(n + 1));
    for (std::size_t wanted = 2; wanted <= kMostChebyshevDegree; wanted += 2) {
      EXPECT_EQ(points_from(n, wanted).size(), wanted + 1);
      for (const PointPrediction& p : points_from(n, wanted))
        check(p, points, chebyshev_points(wanted));
    }
  }
}

}  // namespace
}  // namespace hiac

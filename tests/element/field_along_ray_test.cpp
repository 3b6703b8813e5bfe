#include "hiac/element/field_along_ray.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/element/chebyshev_points.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Point = CellMap::Point;
using Piece = FieldAlongRay::Piece;

enum class Form { affine, tapered, bent };

std::vector<Point> nodes_in_form(CellKind kind, Form form) {
  std::vector<Point> nodes;
  for (const Point& p : reference_nodes(kind)) {
    const Point q{2 + p[0] + 0.3 * p[1], p[1] - 0.1 * p[2] + 0.2 * p[0], 3 + 0.9 * p[2]};
    const double w = form == Form::tapered ? 1 + 0.4 * p[2] + 0.2 * p[0] : 1;
    const double by = form == Form::bent ? 0.05 : 0;
    nodes.push_back({q[0] / w + by * std::sin(3 * p[1]), q[1] / w + by * p[0] * p[2], q[2] / w});
  }
  if (form != Form::tapered) return nodes;
  // straight edges: nodes between corners where the map of the corners has them
  const CellMap map(kind_of(shape_of(kind), CellOrder::linear),
                    std::span(nodes).first(corner_count(kind)));
  for (std::size_t k = corner_count(kind); k < nodes.size(); ++k)
    nodes[k] = map.position(reference_nodes(kind)[k]);
  return nodes;
}

CellField field_within(double least, double most) {
  CellField field{};
  field.least = least;
  field.most = most;
  return field;
}

CellField random_field(CellKind kind, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  CellField field{};
  for (std::size_t k = 0; k < node_count(kind); ++k) field.values[k] = number(random);
  const ValueRange range = interpolant_range(kind, field.values);
  field.least = range.least;
  field.most = range.most;
  return field;
}

// A mean of the corners, weighted at random.
Point point_of_reference_cell(CellKind kind, std::mt19937& random) {
  std::exponential_distribution<double> weight;
  Point sum{};
  double all = 0;
  for (std::size_t k = 0; k < corner_count(kind); ++k) {
    const double w = weight(random);
    all += w;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += w * reference_nodes(kind)[k][c];
  }
  for (double& x : sum) x /= all;
  return sum;
}

// From one point at t = 1.5 to another at t = 4.
RayStretch stretch_between(const Point& from, const Point& to) {
  RayStretch stretch{{}, {}, 1.5, 4};
  for (std::size_t c = 0; c < 3; ++c) {
    stretch.direction[c] = (to[c] - from[c]) / 2.5;
    stretch.origin[c] = from[c] - 1.5 * stretch.direction[c];
  }
  return stretch;
}

double value_at(CellKind kind, const CellField& field, const Point& xi) {
  std::array<double, kMaxNodesPerCell> shape;
  shape_functions<double>(kind, xi, shape);
  double sum = 0;
  for (std::size_t k = 0; k < node_count(kind); ++k) sum += shape[k] * field.values[k];
  return sum;
}

void expect_one_after_another(const std::vector<Piece>& pieces) {
  ASSERT_FALSE(pieces.empty());
  EXPECT_EQ(pieces.front().begin, 0);
  EXPECT_EQ(pieces.back().end, 1);
  for (std::size_t k = 1; k < pieces.size(); ++k) EXPECT_EQ(pieces[k].begin, pieces[k - 1].end);
}

// The largest difference of the polynomials from the field at points all along the stretch.
double largest_error(CellKind kind, const CellMap& map, const CellField& field, std::size_t number,
                     const RayStretch& stretch, const std::vector<Piece>& pieces) {
  double most = 0;
  for (const Piece& piece : pieces)
    for (int i = 0; i <= 10; ++i) {
      const double u = piece.begin + i / 10.0 * (piece.end - piece.begin);
      const Point xi = map.reference(stretch.at(stretch.front + u * (stretch.back - stretch.front)),
                                     map.middle());
      most = std::max(
          most, std::abs(evaluate(piece.fields[number], i / 10.0) - value_at(kind, field, xi)));
    }
  return most;
}

TEST(FieldAlongRay, IsTheInterpolantInCellsOfAllForms) {
  std::mt19937 random(1);
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < kKindCount; ++k)
    for (const Form form : {Form::affine, Form::tapered, Form::bent})
      for (int trial = 0; trial < 4; ++trial) {
        const auto kind = static_cast<CellKind>(k);
        const std::vector<Point> nodes = nodes_in_form(kind, form);
        const CellMap map(kind, nodes);
        std::vector<CellField> fields{random_field(kind, random), random_field(kind, random)};
        const RayStretch stretch =
            stretch_between(map.position(point_of_reference_cell(kind, random)),
                            map.position(point_of_reference_cell(kind, random)));
        FieldAlongRay(kind, map, fields).along(stretch, pieces);
        expect_one_after_another(pieces);
        for (std::size_t f = 0; f < 2; ++f)
          EXPECT_LE(largest_error(kind, map, fields[f], f, stretch, pieces), 2e-13)
              << kind_name(kind) << " form " << static_cast<int>(form);
        if (map.affine() && degree_along_lines(kind) > 0) {
          ASSERT_EQ(pieces.size(), 1U);
          EXPECT_LE(pieces[0].fields[0].degree, degree_along_lines(kind));
        }
        // an allowed error saves terms, and is kept
        const std::size_t exact = pieces.size();
        const std::size_t degree = pieces[0].fields[1].degree;
        for (CellField& field : fields) field.allowed = 1e-4;
        FieldAlongRay(kind, map, fields).along(stretch, pieces);
        expect_one_after_another(pieces);
        EXPECT_LE(pieces.size(), exact);
        if (pieces.size() == exact) {
          EXPECT_LE(pieces[0].fields[1].degree, degree);
        }
        for (std::size_t f = 0; f < 2; ++f)
          EXPECT_LE(largest_error(kind, map, fields[f], f, stretch, pieces), 2e-4)
              << kind_name(kind) << " form " << static_cast<int>(form);
      }
}

TEST(FieldAlongRay, HasTheDegreesOfItsKind) {
  const std::vector<std::size_t> expected{1, 2, 3, 0, 0, 0, 2, 3, 4, 0, 0, 0, 3, 4, 5};
  std::mt19937 random(2);
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    EXPECT_EQ(degree_along_lines(kind), expected[k]) << kind_name(kind);
    if (expected[k] == 0) continue;
    const CellMap map(kind, nodes_in_form(kind, Form::affine));
    const std::vector<CellField> fields{random_field(kind, random)};
    FieldAlongRay(kind, map, fields)
        .along(stretch_between(map.position(point_of_reference_cell(kind, random)),
                               map.position(point_of_reference_cell(kind, random))),
               pieces);
    EXPECT_EQ(pieces[0].fields[0].degree, expected[k]) << kind_name(kind);
  }
}

TEST(FieldAlongRay, OfConstantFieldsIsOnePiece) {
  const CellKind kind = CellKind::wedge18;
  const CellMap map(kind, nodes_in_form(kind, Form::bent));
  std::mt19937 random(3);
  std::vector<CellField> fields(2, field_within(4, 4));
  const RayStretch stretch =
      stretch_between(map.position({0.2, 0.1, 0.1}), map.position(map.middle()));
  std::vector<Piece> pieces(7);
  fields[1].least = fields[1].most = -3;
  FieldAlongRay(kind, map, fields).along(stretch, pieces);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].begin, 0);
  EXPECT_EQ(pieces[0].end, 1);
  EXPECT_EQ(pieces[0].fields[0].degree, 0U);
  EXPECT_EQ(pieces[0].fields[0].c[0], 4);
  EXPECT_EQ(pieces[0].fields[1].c[0], -3);
  // one of two fields
  fields[1] = random_field(kind, random);
  FieldAlongRay(kind, map, fields).along(stretch, pieces);
  EXPECT_LE(largest_error(kind, map, fields[1], 1, stretch, pieces), 1e-13);
}

// In a cubic cell, along its first edge: x, and terms of degree 2 and 3 of a thousandth each.
TEST(FieldAlongRay, LeavesOutTermsThatAreNegligibleTogether) {
  const CellKind kind = CellKind::tetrahedron20;
  const auto reference = reference_nodes(kind);
  const CellMap map(kind, std::vector<Point>(reference.begin(), reference.end()));
  CellField field = field_within(-2, 2);
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const double z = 2 * reference[k][0] - 1;
    field.values[k] = z + 1e-3 * (2 * z * z - 1) - 1e-3 * (4 * z * z * z - 3 * z);
  }
  for (const auto& [allowed, degree] :
       {std::pair{0.0, 3U}, {0.9e-3, 3U}, {1.1e-3, 2U}, {1.9e-3, 2U}, {2.1e-3, 1U}}) {
    field.allowed = allowed;
    const std::vector<CellField> fields{field};
    std::vector<Piece> pieces;
    FieldAlongRay(kind, map, fields).along(stretch_between({0, 0, 0}, {1, 0, 0}), pieces);
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_EQ(pieces[0].fields[0].degree, degree) << allowed;
  }
}

// A linear field in a brick: its terms of degree 2 and 3 are rounding.
TEST(FieldAlongRay, LeavesOutTermsOfTheSizeOfRounding) {
  const CellKind kind = CellKind::brick8;
  const std::vector<Point> nodes = nodes_in_form(kind, Form::affine);
  const CellMap map(kind, nodes);
  CellField field = field_within(-10, 10);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    field.values[k] = 0.7 * nodes[k][0] - 1.3 * nodes[k][1] + 0.1 * nodes[k][2];
  const std::vector<CellField> fields{field};
  std::vector<Piece> pieces;
  FieldAlongRay(kind, map, fields)
      .along(stretch_between(map.position({0.1, 0.2, 0.3}), map.position({0.7, 0.9, 0.4})), pieces);
  EXPECT_EQ(pieces[0].fields[0].degree, 1U);
}

// A twisted cube that is its own image under reflection in its middle: along its diagonal, the
// first reference coordinate is an odd function, t / (1 + t^2 / 5), and every other term is 0.
TEST(FieldAlongRay, OddFunctionsAreResolvedToo) {
  const CellKind kind = CellKind::brick8;
  std::vector<Point> nodes;
  CellField field = field_within(-1, 1);
  for (const Point& p : reference_nodes(kind)) {
    const Point q{2 * p[0] - 1, 2 * p[1] - 1, 2 * p[2] - 1};
    field.values[nodes.size()] = q[0];
    nodes.push_back({q[0] + 0.2 * q[0] * q[1] * q[2], q[1], q[2]});
  }
  const CellMap map(kind, nodes);
  const std::vector<CellField> fields{field};
  std::vector<Piece> pieces;
  FieldAlongRay(kind, map, fields)
      .along(stretch_between({-0.9, -0.9, -0.9}, {0.9, 0.9, 0.9}), pieces);
  expect_one_after_another(pieces);
  for (const Piece& piece : pieces)
    for (int i = 0; i <= 16; ++i) {
      const double u = piece.begin + i / 16.0 * (piece.end - piece.begin), t = 1.8 * u - 0.9;
      EXPECT_NEAR(evaluate(piece.fields[0], i / 16.0), t / (1 + 0.2 * t * t), 1e-13);
    }
}

// Where the map has no inverse, values are those of the cell still.
TEST(FieldAlongRay, StaysInTheRangeOfFlatCells) {
  std::mt19937 random(6);
  for (const CellKind kind : {CellKind::tetrahedron4, CellKind::pyramid5, CellKind::wedge7,
                              CellKind::brick8, CellKind::prism15}) {
    std::vector<Point> nodes = nodes_in_form(kind, Form::tapered);
    for (Point& p : nodes) p[2] = 1;
    const CellMap map(kind, nodes);
    const std::vector<CellField> fields{random_field(kind, random)};
    std::vector<Piece> pieces;
    FieldAlongRay(kind, map, fields).along(stretch_between({0, 0, 0}, {1, 0.5, 2}), pieces);
    expect_one_after_another(pieces);
    for (const Piece& piece : pieces)
      for (const double end : {0.0, 1.0}) {
        const double value = evaluate(piece.fields[0], end);
        EXPECT_GE(value, fields[0].least - 1e-12) << kind_name(kind);
        EXPECT_LE(value, fields[0].most + 1e-12) << kind_name(kind);
      }
  }
}

// Past the apex of a pyramid, nearer and nearer: halves near the apex are halved again.
TEST(FieldAlongRay, IsHalvedTowardsTheApexOfAPyramid) {
  const CellKind kind = CellKind::pyramid5;
  const CellMap map(kind, nodes_in_form(kind, Form::affine));
  std::mt19937 random(4);
  const std::vector<CellField> fields{random_field(kind, random)};
  std::size_t before = 0;
  for (const double gap : {1e-1, 1e-3, 1e-5, 1e-7}) {
    const RayStretch stretch = stretch_between(map.position({0.7 * gap, 0.2 * gap, 1 - gap}),
                                               map.position({0.1 * gap, 0.6, 0.35}));
    std::vector<Piece> pieces;
    FieldAlongRay(kind, map, fields).along(stretch, pieces);
    expect_one_after_another(pieces);
    EXPECT_LE(largest_error(kind, map, fields[0], 0, stretch, pieces), 1e-12 / gap * 1e-2 + 1e-12);
    EXPECT_GE(pieces.size(), before);
    EXPECT_LE(pieces.size(), 40U);
    before = pieces.size();
  }
  EXPECT_GT(before, 5U);
}

// By hand in the unit cube, whose map changes reference coordinates by 1 per unit of length:
// coordinates of the ray's points are at most 3 + 5 * 2.
TEST(FieldAlongRay, RoundingIsThatOfTheFieldAndOfTheRaysPoints) {
  const CellKind kind = CellKind::brick8;
  const auto reference = reference_nodes(kind);
  const std::vector<Point> unit(reference.begin(), reference.end());
  const CellMap map(kind, unit);
  const CellField field = field_within(-7, 2);
  const std::vector<CellField> fields{field};
  const FieldAlongRay along(kind, map, fields);
  const RayStretch forward{{1, -3, 2}, {0.5, 0, -2}, -5, 4};
  const RayStretch backward{{1, -3, 2}, {0.5, 2, 0}, 4, 5};
  for (const RayStretch& stretch : {forward, backward})
    EXPECT_DOUBLE_EQ(along.rounding(stretch, field), 0x1p-53 * (8 * 7 + 16 * 13 * 9));
  EXPECT_DOUBLE_EQ(along.rounding(forward, field_within(1, 10)), 0x1p-53 * (8 * 10 + 16 * 13 * 9));
  // half as large a cell
  std::vector<Point> half = unit;
  for (Point& p : half)
    for (double& x : p) x *= 0.5;
  const CellMap small(kind, half);
  EXPECT_DOUBLE_EQ(FieldAlongRay(kind, small, fields).rounding(forward, field),
                   0x1p-53 * (8 * 7 + 16 * 13 * 2 * 9));
}

// The polynomial through values at the points, in Chebyshev polynomials and in powers.
TEST(ChebyshevPoints, CoefficientsAreThoseOfThePolynomialThroughTheValues) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (std::size_t n = 1; n <= kMostChebyshevDegree; ++n) {
    const ChebyshevPoints& points = chebyshev_points(n);
    EXPECT_EQ(points.degree(), n);
    EXPECT_EQ(points.place(0), 0);
    EXPECT_EQ(points.place(n), 1);
    std::vector<double> values(3 * n + 1), c(n + 1);
    for (double& v : values) v = number(random);
    points.coefficients(values.data(), 3, c.data());
    for (std::size_t j = 0; j <= n; ++j) {
      const double angle = M_PI * static_cast<double>(n - j) / static_cast<double>(n);
      EXPECT_NEAR(points.place(j), 0.5 + 0.5 * std::cos(angle), 1e-15);
      double chebyshev = 0, powers = 0;
      for (std::size_t k = 0; k <= n; ++k) {
        chebyshev += c[k] * std::cos(static_cast<double>(k) * angle);
        double of_power = 0;
        for (std::size_t i = 0; i <= n; ++i) of_power += points.power(k, i) * values[3 * i];
        powers += of_power * std::pow(std::cos(angle), static_cast<double>(k));
      }
      EXPECT_NEAR(chebyshev, values[3 * j], 1e-13) << n;
      EXPECT_NEAR(powers, values[3 * j], 1e-15 * std::pow(2.5, n) + 1e-13) << n;
    }
  }
}

}  // namespace
}  // namespace hiac

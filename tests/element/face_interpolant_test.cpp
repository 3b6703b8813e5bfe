#include "hiac/element/face_interpolant.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Place = std::array<double, 3>;

// A cell whose nodes have any numbers and offsets.
struct Numbered {
  CellKind kind;
  std::vector<NodeId> nodes;
  std::vector<double> offsets;
  std::vector<Place> places;

  Numbered(CellKind of_kind, double bend, std::mt19937& random) : kind(of_kind) {
    std::uniform_real_distribution<double> number(-1, 1);
    const auto reference = reference_nodes(kind);
    for (const Place& p : reference) {
      nodes.push_back(static_cast<NodeId>(100 + 3 * nodes.size()));
      offsets.push_back(number(random));
      places.push_back({p[0] + 0.1 * p[1] + bend * number(random),
                        p[1] - 0.2 * p[2] + bend * number(random),
                        p[2] + 0.15 * p[0] + bend * number(random)});
    }
    std::shuffle(nodes.begin(), nodes.end(), random);
  }
  [[nodiscard]] std::size_t index(NodeId node) const {
    return static_cast<std::size_t>(std::ranges::find(nodes, node) - nodes.begin());
  }
};

Place between(const Place& a, const Place& b, double s) {
  return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
}

// The nodes between a face's corners lie between them in the reference cell, in this order.
void expect_in_order(const Numbered& cell, const FaceOffsets& face) {
  const auto reference = reference_nodes(cell.kind);
  const auto at = [&](std::size_t k) { return reference[cell.index(face.nodes[k])]; };
  const auto order = static_cast<std::size_t>(face.order);
  const auto expect_at = [&](std::size_t k, const Place& p) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(at(k)[c], p[c], 1e-14) << kind_name(cell.kind);
  };
  std::size_t node = face.count;
  for (std::size_t k = 0; k < face.count; ++k)
    for (std::size_t j = 1; j < order; ++j)
      expect_at(node++, between(at(k), at((k + 1) % face.count),
                                static_cast<double>(j) / static_cast<double>(order)));
  if (face.centred) expect_at(node++, between(at(0), between(at(1), at(2), 0.5), 2.0 / 3));
  EXPECT_EQ(face.node_count(), node);
  for (std::size_t k = 0; k < node; ++k)
    EXPECT_EQ(face.offsets[k], cell.offsets[cell.index(face.nodes[k])]);
}

TEST(FaceOffsets, AreThoseOfTheFacesNodesAroundIt) {
  std::mt19937 random(1);
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const Numbered cell(static_cast<CellKind>(k), 0, random);
    for (std::size_t f = 0; f < face_count(cell.kind); ++f) {
      const FaceOffsets face = face_offsets(cell.kind, f, cell.nodes, cell.offsets);
      const ShapeFace& corners = topology_of(cell.kind).faces[f];
      ASSERT_EQ(face.count, corners.corner_count);
      for (std::size_t c = 0; c < face.count; ++c)
        EXPECT_EQ(face.nodes[c], cell.nodes[corners.corners[c]]);
      EXPECT_EQ(face.centred, cell.kind == CellKind::tetrahedron20);
      expect_in_order(cell, face);
    }
  }
}

TEST(FaceOffsets, CanonicalFacesGoFromTheSmallestNodeToItsSmallerNeighbour) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 10; ++trial)
    for (std::size_t k = 0; k < kKindCount; ++k) {
      const Numbered cell(static_cast<CellKind>(k), 0, random);
      for (std::size_t f = 0; f < face_count(cell.kind); ++f) {
        const FaceOffsets face =
            canonical_face(face_offsets(cell.kind, f, cell.nodes, cell.offsets));
        const auto corners = std::span(face.nodes).first(face.count);
        EXPECT_EQ(face.nodes[0], std::ranges::min(corners));
        EXPECT_LT(face.nodes[1], face.nodes[face.count - 1]);
        std::vector<NodeId> expected;
        for (std::size_t c = 0; c < face.count; ++c)
          expected.push_back(cell.nodes[topology_of(cell.kind).faces[f].corners[c]]);
        EXPECT_TRUE(std::ranges::is_permutation(corners, expected));
        expect_in_order(cell, face);
      }
    }
}

// The interpolant of the cell at a point of a face of a distorted cell is that of the face's own
// nodes; the corners and edges included.
TEST(FaceValue, IsThatOfTheCellsShapeFunctionsOnTheFace) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0, 1);
  for (std::size_t k = 0; k < kKindCount; ++k)
    for (int trial = 0; trial < 20; ++trial) {
      const auto kind = static_cast<CellKind>(k);
      const Numbered cell(kind, 0.03, random);
      const auto reference = reference_nodes(kind);
      for (std::size_t f = 0; f < face_count(kind); ++f) {
        const ShapeFace& corners = topology_of(kind).faces[f];
        const auto corner = [&](std::size_t c) { return reference[corners.corners[c]]; };
        double u = number(random), v = number(random);
        if (trial < 4) u = trial % 2, v = trial < 2 ? 0 : number(random);
        const Place xi = between(between(corner(0), corner(1), u),
                                 between(corner(corners.corner_count - 1), corner(2), u), v);
        std::array<double, kMaxNodesPerCell> shape;
        shape_functions<double>(kind, xi, shape);
        double expected = 0;
        Place point{};
        for (std::size_t n = 0; n < cell.nodes.size(); ++n) {
          expected += shape[n] * cell.offsets[n];
          for (std::size_t c = 0; c < 3; ++c) point[c] += shape[n] * cell.places[n][c];
        }
        const FaceOffsets face = canonical_face(face_offsets(kind, f, cell.nodes, cell.offsets));
        std::vector<Place> from;
        for (std::size_t n = 0; n < face.node_count(); ++n) {
          const Place& p = cell.places[cell.index(face.nodes[n])];
          from.push_back({p[0] - point[0], p[1] - point[1], p[2] - point[2]});
        }
        EXPECT_NEAR(face_value_at(face, from), expected, 1e-12)
            << kind_name(kind) << " face " << f << " at " << u << ' ' << v;
      }
    }
}

TEST(FaceValue, OfAFaceWithoutAreaIsThatOfACorner) {
  FaceOffsets face;
  for (const double offset : {3.0, 4.0, 5.0}) face.add(7, offset);
  const std::vector<Place> from(3, Place{1, 2, 3});
  EXPECT_EQ(face_value_at(face, from), 3);
}

FaceOffsets face_with(CellOrder order, const std::vector<double>& offsets) {
  FaceOffsets face;
  face.order = order;
  face.count = offsets.size() / static_cast<std::size_t>(order);
  std::ranges::copy(offsets, face.offsets.begin());
  std::iota(face.nodes.begin(), face.nodes.end(), NodeId{0});
  return face;
}

TEST(FaceOffsets, HaveASignWhereItIsCertain) {
  const auto sign = [](CellOrder order, const std::vector<double>& offsets) {
    bool mixed = false;
    const double found = face_with(order, offsets).sign(mixed);
    return mixed ? 2 : static_cast<int>(found);
  };
  constexpr CellOrder kLinear = CellOrder::linear, kQuadratic = CellOrder::quadratic;
  EXPECT_EQ(sign(kLinear, {1, 2, 3}), 1);
  EXPECT_EQ(sign(kLinear, {0, 0, 3}), 1);
  EXPECT_EQ(sign(kLinear, {0, 0, 0, 0}), 0);
  EXPECT_EQ(sign(kLinear, {0, -1, 0}), -1);
  EXPECT_EQ(sign(kLinear, {-2, -1, -3, -4}), -1);
  EXPECT_EQ(sign(kLinear, {0, -1, 2}), 2);
  EXPECT_EQ(sign(kQuadratic, {0, 0, 0, 0, 0, 0}), 0);
  EXPECT_EQ(sign(kQuadratic, {-2, -2, -2, -2, -2, -2}), -1);
  // control values between corners are twice the nodes' less half of the corners' sum
  EXPECT_EQ(sign(kQuadratic, {1, 1, 1, 0.51, 0.51, 0.51}), 1);
  EXPECT_EQ(sign(kQuadratic, {1, 1, 1, 0.49, 0.51, 0.51}), 2);
  EXPECT_EQ(sign(kQuadratic, {-1, -1, -1, -0.51, -0.51, -0.51}), -1);
  EXPECT_EQ(sign(kQuadratic, {-1, -1, -1, -0.51, -0.51, -0.49}), 2);
}

TEST(TetrahedronFaces, LackOneCorner) {
  EXPECT_EQ(tetrahedron_face_without(0), 1U);  // of the corners 1, 2 and 3
  EXPECT_EQ(tetrahedron_face_without(1), 2U);
  EXPECT_EQ(tetrahedron_face_without(2), 0U);
  EXPECT_EQ(tetrahedron_face_without(3), 3U);
}

}  // namespace
}  // namespace hiac

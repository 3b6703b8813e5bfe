// Volumes of cells against closed forms.
#include "hiac/geometry/cell_volume.hpp"

#include <array>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Position;

double triple(const Position& a, const Position& b, const Position& c) {
  return dot(a, cross(b, c));
}

TEST(CellVolume, OfAffineImagesOfEveryKind) {
  constexpr std::array<double, kShapeCount> kReference{1.0 / 6, 1.0 / 3, 0.5, 1, 1};
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    std::vector<Position> positions;
    std::vector<NodeId> nodes;
    for (const auto& [x, y, z] : reference_nodes(kind)) {
      positions.push_back({2 * x + 0.25 * y, y - 0.5 * z, 1.5 * z + 0.125 * x});
      nodes.push_back(static_cast<NodeId>(nodes.size()));
    }
    const double factor = triple({2, 0.25, 0}, {0, 1, -0.5}, {0.125, 0, 1.5});
    const ZooMesh mesh = test::make_mesh(positions, {{kind, nodes}});
    EXPECT_NEAR(signed_volume(mesh, 0),
                factor * kReference[static_cast<std::size_t>(shape_of(kind))], 1e-13)
        << kind_name(kind);
  }
}

// what lies under the faces of linear cells that are no affine images
TEST(CellVolume, OfLinearCellsIsThatWithinTheirFaces) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(-0.15, 0.15);
  for (std::size_t s = 0; s < kShapeCount; ++s) {
    const CellKind kind = kind_of(static_cast<CellShape>(s), CellOrder::linear);
    std::vector<Position> positions;
    std::vector<NodeId> nodes;
    for (const auto& [x, y, z] : reference_nodes(kind)) {
      positions.push_back({x + off(random), y + off(random), z + off(random)});
      nodes.push_back(static_cast<NodeId>(nodes.size()));
    }
    double twelve = 0;
    for (const ShapeFace& face : topology_of(kind).faces)
      for (std::size_t k = 0; k < face.corner_count; ++k) {
        const auto at = [&](std::size_t i) {
          return positions[face.corners[(k + i) % face.corner_count]];
        };
        twelve += triple(at(0), at(1), at(2)) * (face.corner_count == 3 ? 2.0 / 3 : 1);
      }
    const ZooMesh mesh = test::make_mesh(positions, {{kind, nodes}});
    EXPECT_NEAR(signed_volume(mesh, 0), twelve / 12, 1e-14) << kind_name(kind);
  }
}

}  // namespace
}  // namespace hiac

#include "hiac/render/refine/extended_cell.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

using test::Position;
using Real = long double;

// What the tests look at: every linear kind but the tetrahedron, tapered.
std::vector<ZooMesh> meshes() {
  return {test::moved(test::structured(1, test::Cut::bricks), test::tapered),
          test::moved(test::structured(1, test::Cut::prisms), test::tapered),
          test::moved(test::structured(1, test::Cut::pyramids), test::tapered),
          test::moved(test::two_wedges(), test::tapered)};
}

class Look {
 public:
  Look(ZooMesh mesh, Projection projection)
      : mesh_(std::move(mesh)),
        scene_(test::cube_scene(projection, 8, 8)),
        projector_(scene_.camera, scene_.image) {
    test::add_node_field(mesh_, "f", [](const Position& p) { return p[0]; });
    frame_.emplace(mesh_, scene_, projector_);
  }

  [[nodiscard]] const Frame& frame() const { return *frame_; }

 private:
  ZooMesh mesh_;
  Scene scene_;
  Projector projector_;
  std::optional<Frame> frame_;
};

// A field that is linear in the world is so in every linear cell: here the distance from a plane,
// of a stretch between two points in the cell that a ray through the eye or along the view meets.
TEST(ExtendedCell, ReproducesLinearFieldsToItsPrecision) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::size_t tried = 0;
  for (const Projection projection : {Projection::perspective, Projection::orthographic})
    for (const ZooMesh& mesh : meshes()) {
      const Look look(mesh, projection);
      tried += mesh.cell_count();
      for (CellId id = 0; id < mesh.cell_count(); ++id) {
        const ExtendedCell cell(look.frame(), id);
        const auto corners = cell.corners();
        ExtendedCell::Field field{{}, 1e30L, -1e30L, 1e-18L};
        const auto plane = [](const ExtendedVector& p) {
          return 0.3L * p[0] - 0.8L * p[1] + 0.5L * p[2];
        };
        for (std::size_t k = 0; k < corners.size(); ++k) {
          field.values[k] = plane(corners[k]);
          field.least = std::min(field.least, field.values[k]);
          field.most = std::max(field.most, field.values[k]);
        }
        std::array<ExtendedVector, 2> ends{};
        for (ExtendedVector& end : ends) {
          std::vector<Real> weights;
          Real sum = 0;
          for (std::size_t k = 0; k < corners.size(); ++k)
            sum += weights.emplace_back(uniform(engine));
          for (std::size_t k = 0; k < corners.size(); ++k)
            for (std::size_t c = 0; c < 3; ++c) end[c] += weights[k] / sum * corners[k][c];
        }
        ExtendedRay ray(look.frame().projector, 0, 0);
        ray.origin = ends[0];
        ray.direction = minus(ends[1], ends[0]);
        std::vector<ExtendedCell::Piece> pieces;
        ASSERT_TRUE(cell.along(ray, 0, 1, {&field, 1}, pieces));
        for (const ExtendedCell::Piece& piece : pieces)
          for (const Real u : {0.0L, 0.3L, 1.0L}) {
            const Real t = piece.begin + u * (piece.end - piece.begin);
            EXPECT_NEAR(static_cast<double>(evaluate(piece.fields[0], u) - plane(ray.at(t))), 0,
                        2e-17);
          }
        // its derivatives are those of the plane: J^T n
        ExtendedCell::Derivatives d;
        ASSERT_TRUE(cell.derivatives(ray.at(0.5L), field.values, d));
        for (std::size_t a = 0; a < 3; ++a)
          EXPECT_NEAR(static_cast<double>(d.gradient[a] - plane(d.columns[a])), 0, 2e-17);
      }
    }
  EXPECT_EQ(tried, 2U * (1 + 2 + 6 + 2));
}

// The cells of a mesh take turns along a ray: where it leaves one it enters the next, to the bit,
// on the plane of their face.
TEST(ExtendedCell, LeavesWhereTheNextIsEntered) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    const Look look(test::moved(test::structured(3, test::Cut::bricks), test::tapered), projection);
    const ZooMesh& mesh = look.frame().mesh;
    std::size_t entered = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const ExtendedRay ray(look.frame().projector, x, y);
        std::vector<std::pair<Real, Real>> parts;
        for (CellId id = 0; id < mesh.cell_count(); ++id) {
          const ExtendedCell cell(look.frame(), id);
          EXPECT_LT(cell.bent(), 1e-15);
          const ExtendedCell::Part part = cell.inside(ray);
          if (!(part.front < part.back)) continue;
          parts.emplace_back(part.front, part.back);
          const ShapeFace& face = topology_of(mesh.kinds[id]).faces[part.front_face];
          const auto at = [&](std::size_t k) { return cell.corners()[face.corners[k]]; };
          const ExtendedVector normal = cross(minus(at(1), at(0)), minus(at(2), at(0)));
          EXPECT_NEAR(static_cast<double>(dot(unit(normal), minus(ray.at(part.front), at(0)))), 0,
                      1e-14);
        }
        std::ranges::sort(parts);
        for (std::size_t k = 1; k < parts.size(); ++k)
          EXPECT_EQ(parts[k - 1].second, parts[k].first) << x << ' ' << y;
        entered += parts.size();
      }
    EXPECT_GT(entered, 40U);
  }
}

}  // namespace
}  // namespace hiac

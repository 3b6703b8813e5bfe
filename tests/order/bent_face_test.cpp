#include "hiac/order/gaps/bent_face.hpp"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/order/gaps/gap_relation.hpp"
#include "hiac/order/visibility_order.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Position;
using Hull = std::vector<Vector>;

// A square about the z axis, its corners by turns at z and z + warp.
Hull square(double z, double warp, double x = 0) {
  return {{x - 1, -1, z}, {x + 1, -1, z + warp}, {x + 1, 1, z}, {x - 1, 1, z + warp}};
}

const View kUpwards{false, {}, {0, 0, 1}}, kDownwards{false, {}, {0, 0, -1}};
const View kFromBelow{true, {0.1, 0.2, -9}, {}}, kFromAbove{true, {0.1, 0.2, 9}, {}};

TEST(BentFace, OneBeyondTheOtherIsMetSecond) {
  const Hull low = square(0, 0.1), high = square(2, -0.1);
  for (const View& view : {kUpwards, kFromBelow}) {
    EXPECT_TRUE(may_be_met_first(low, high, view, 0));
    EXPECT_FALSE(may_be_met_first(high, low, view, 0));
  }
  for (const View& view : {kDownwards, kFromAbove}) {
    EXPECT_FALSE(may_be_met_first(low, high, view, 0));
    EXPECT_TRUE(may_be_met_first(high, low, view, 0));
  }
}

TEST(BentFace, OnesBesideOneAnotherAreNotBothMet) {
  for (const View& view : {kUpwards, kDownwards}) {
    for (const double x : {-2.0, 2.0, 2.5}) {
      EXPECT_FALSE(may_be_met_first(square(0, 0.1), square(2, -0.1, x), view, 0)) << x;
      EXPECT_FALSE(may_be_met_first(square(2, -0.1, x), square(0, 0.1), view, 0)) << x;
    }
    for (const double x : {-1.9, 1.9})
      EXPECT_NE(may_be_met_first(square(0, 0.1), square(2, -0.1, x), view, 0),
                may_be_met_first(square(2, -0.1, x), square(0, 0.1), view, 0))
          << x;
  }
  // from the eye the farther one is smaller: beside what is nearer, or hidden by it
  EXPECT_TRUE(may_be_met_first(square(0, 0.1), square(2, -0.1, 2.1), kFromBelow, 0));
  EXPECT_FALSE(may_be_met_first(square(0, 0.1), square(2, -0.1, 2.7), kFromBelow, 0));
}

// Those that pierce one another are met either way round.
TEST(BentFace, OnesThatPierceOneAnotherAreMetBothWays) {
  const Hull rising = square(0, 0.5), falling = square(0.3, -0.5);
  for (const View& view : {kUpwards, kDownwards, kFromBelow, kFromAbove}) {
    EXPECT_TRUE(may_be_met_first(rising, falling, view, 0));
    EXPECT_TRUE(may_be_met_first(falling, rising, view, 0));
  }
}

// An exit and an entry in one plane, or within the slack of one, are crossed one after the other.
TEST(BentFace, OnesInOnePlaneTouch) {
  const Hull f = square(0, 0);
  for (const View& view : {kUpwards, kDownwards, kFromBelow, kFromAbove})
    for (const double x : {0.0, 0.3, -1.99}) {
      EXPECT_TRUE(may_be_met_first(f, square(0, 0, x), view, 0));
      EXPECT_TRUE(may_be_met_first(square(0, 0, x), f, view, 0));
      EXPECT_TRUE(may_be_met_first(square(0, 1e-4, x), f, view, 1e-4));
      EXPECT_TRUE(may_be_met_first(square(1e-4, -2e-4, x), f, view, 1.1e-4));
    }
  EXPECT_FALSE(may_be_met_first(f, square(0, 0, 2), kUpwards, 0));
  // seen from the side no ray crosses either
  EXPECT_FALSE(may_be_met_first(f, square(0, 0, 0.3), {false, {}, {1, 0.2, 0}}, 0));
  EXPECT_FALSE(may_be_met_first(f, square(0, 0, 0.3), {true, {-3, 0.2, 0}, {}}, 0));
  // a fold: both have an edge in common, and the one rises from the plane of the other
  const Hull roof{{-1, -1, 0}, {1, -1, 0}, {1, 1, -1}, {-1, 1, -1}};
  EXPECT_FALSE(may_be_met_first(f, roof, kUpwards, 1e-4));
  EXPECT_TRUE(may_be_met_first(roof, f, kUpwards, 1e-4));
}

// An entry may lie in front of the exit by the slack, and by no more.
TEST(BentFace, OverlapsWithinTheSlackAreTouches) {
  for (const double warp : {0.0, 1e-5}) {
    const Hull exit = square(1, warp), entry = square(1 - 5e-4, warp);
    for (const View& view : {kUpwards, kFromBelow}) {
      EXPECT_TRUE(may_be_met_first(exit, entry, view, 1e-3));
      EXPECT_FALSE(may_be_met_first(exit, entry, view, 1e-4));
      EXPECT_TRUE(may_be_met_first(entry, exit, view, 1e-4));
    }
  }
}

// An exit that an entry in front of it pierces by less than the slack is beyond it.
TEST(BentFace, OnesThatPierceOneAnotherWithinTheSlackAreMetOneWay) {
  const Hull far = square(0, 0.1), near = square(5e-4, -0.1);
  for (const View& view : {kUpwards, kFromBelow}) {
    EXPECT_FALSE(may_be_met_first(far, near, view, 1e-3));
    EXPECT_TRUE(may_be_met_first(far, near, view, 1e-4));
    EXPECT_TRUE(may_be_met_first(near, far, view, 1e-3));
  }
}

// By 0.9 and 1.1 times the slack.
TEST(BentFace, TheSlackIsWhatTheyMayPierceBy) {
  for (const View& view : {kUpwards, kFromBelow}) {
    EXPECT_FALSE(may_be_met_first(square(0, 0.1), square(9e-4, -0.1), view, 1e-3));
    EXPECT_TRUE(may_be_met_first(square(0, 0.1), square(1.1e-3, -0.1), view, 1e-3));
  }
}

// Two folded squares, the ridge of the lower one along x and right below that of the upper one,
// along y: of all planes along edges of theirs only the one along both ridges has them on its two
// sides.
TEST(BentFace, OnesThatMeetInCrossingEdgesAreInOneOrder) {
  for (const double apart : {0.0, 1e-3}) {
    const Hull low{{-1, 0, 0}, {1, 0, 0}, {0.1, 1, -1}, {0, -1, -1}};
    const Hull high{{0, -1, apart}, {0, 1, apart}, {1, 0.1, 1 + apart}, {-1, 0, 1 + apart}};
    for (const View& view : {kUpwards, kFromBelow}) {
      EXPECT_TRUE(may_be_met_first(low, high, view, 0)) << apart;
      EXPECT_FALSE(may_be_met_first(high, low, view, 0)) << apart;
    }
    for (const View& view : {kDownwards, kFromAbove}) {
      EXPECT_FALSE(may_be_met_first(low, high, view, 0)) << apart;
      EXPECT_TRUE(may_be_met_first(high, low, view, 0)) << apart;
    }
  }
}

// A brick with sides of 1 on the square [0, 1]^2, from z to z + 1, its bottom and top warped.
test::Cell add_brick(std::vector<Position>& positions, double z, double warp) {
  test::Cell brick{CellKind::brick8, {}};
  for (const double at : {z, z + 1})
    for (const auto& [x, y, up] :
         std::array<Position, 4>{{{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}}}) {
      brick.nodes.push_back(static_cast<NodeId>(positions.size()));
      positions.push_back({x, y, at + up * warp});
    }
  return brick;
}

// The order in which two bricks, the second above the first, are met.
std::vector<CellId> order_of_two(double below, double above, double warp, const View& view,
                                 double planarity, bool far_first) {
  std::vector<Position> positions;
  std::vector<test::Cell> cells;
  const bool low_first = (view.direction[2] > 0) != far_first;
  cells.push_back(add_brick(positions, low_first ? below : above, warp));
  cells.push_back(add_brick(positions, low_first ? above : below, warp));
  const ZooMesh mesh = test::make_mesh(positions, cells);
  const OrderResult result = exact_order(mesh, build_face_adjacency(mesh), view, planarity);
  EXPECT_TRUE(result.order.groups.empty());
  return {result.order.cells.begin(), result.order.cells.end()};
}

TEST(BentFace, TheFarCellComesLastWhateverItsNumber) {
  for (const View& view : {kUpwards, kDownwards})
    for (const double warp : {0.0, 0.1}) {
      SCOPED_TRACE(warp);
      EXPECT_EQ(order_of_two(0, 2, warp, view, 1e-10, true), (std::vector<CellId>{1, 0}));
      EXPECT_EQ(order_of_two(0, 2, warp, view, 1e-10, false), (std::vector<CellId>{0, 1}));
    }
}

// Bricks that overlap along the view by half of the planarity.
TEST(BentFace, CellsThatOverlapWithinThePlanarityAreInOrder) {
  for (const View& view : {kUpwards, kDownwards})
    for (const double warp : {0.0, 0.1}) {
      SCOPED_TRACE(warp);
      EXPECT_EQ(order_of_two(0, 1 - 5e-4, warp, view, 1e-3, true), (std::vector<CellId>{1, 0}));
      EXPECT_EQ(order_of_two(0, 1 - 5e-4, warp, view, 1e-3, false), (std::vector<CellId>{0, 1}));
    }
}

}  // namespace
}  // namespace hiac

#include "hiac/derive/deform.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

TEST(Deform, MovesNodesByTheScaledVector) {
  const ZooMesh before = test::structured(2, test::Cut::bricks);
  ZooMesh mesh = before;
  std::vector<double> shift(mesh.xyz.size());
  for (std::size_t i = 0; i < shift.size(); ++i) shift[i] = 0.25 * static_cast<double>(i % 7);
  deform(mesh, {"u", "", FieldLocation::node, 3, std::vector<double>(shift)}, -2);
  for (std::size_t i = 0; i < shift.size(); ++i)
    EXPECT_EQ(mesh.xyz[i], before.xyz[i] - 0.5 * static_cast<double>(i % 7));
  EXPECT_EQ(mesh.nodes.size(), before.nodes.size());
  EXPECT_EQ(mesh.kinds[0], before.kinds[0]);
}

TEST(Deform, RefusesWhatMovesNoNodes) {
  ZooMesh mesh = test::structured(1, test::Cut::bricks);
  EXPECT_THROW(deform(mesh, {"u", "", FieldLocation::node, 1, std::vector<double>(8)}, 1),
               UsageError);
  EXPECT_THROW(deform(mesh, {"u", "", FieldLocation::cell, 3, std::vector<double>(3)}, 1),
               UsageError);
  std::vector<double> odd(24, 0);
  odd[4] = std::numeric_limits<double>::quiet_NaN();
  const auto before = std::vector<double>(mesh.xyz.begin(), mesh.xyz.end());
  try {
    deform(mesh, {"u", "", FieldLocation::node, 3, std::move(odd)}, 1);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "u: node 1 is moved to no finite position (finite values expected, nan found)");
  }
  EXPECT_EQ(std::vector<double>(mesh.xyz.begin(), mesh.xyz.end()), before);
}

}  // namespace
}  // namespace hiac

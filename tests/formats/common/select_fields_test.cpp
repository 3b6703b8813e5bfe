#include "formats/common/mesh/select_fields.hpp"

#include <gtest/gtest.h>

#include "formats/common/cells/keep_corners.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

/// A quadratic tetrahedron with a vector on nodes, an id on nodes and cells, a field on corners.
ZooMesh sample() {
  ZooMesh mesh;
  mesh.kinds = std::vector{CellKind::tetrahedron10};
  mesh.elems = std::vector<std::uint64_t>{0, 10};
  mesh.nodes = std::vector<NodeId>{9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
  std::vector<double> xyz;
  std::vector<double> velocity;
  std::vector<double> numbers;
  for (int i = 0; i < 10; ++i) {
    xyz.insert(xyz.end(), {1.0 * i, 2.0 * i, 3.0 * i});
    velocity.insert(velocity.end(), {3.0 * i, 0.0, 4.0 * i});
    numbers.push_back(i);
  }
  mesh.xyz = std::move(xyz);
  mesh.fields.push_back({"v", "m/s", FieldLocation::node, 3, std::move(velocity)});
  mesh.fields.push_back({"id", "", FieldLocation::node, 1, std::vector<double>(numbers)});
  mesh.fields.push_back({"id", "", FieldLocation::cell, 1, std::vector<double>{7}});
  mesh.fields.push_back({"a=b", "", FieldLocation::corner, 1, std::move(numbers)});
  return mesh;
}

std::vector<Field> select(const std::vector<std::string>& requests) {
  return select_fields(sample(), requests);
}

TEST(SelectFields, WithoutRequestsAllAreKept) { EXPECT_EQ(select({}).size(), 4U); }

TEST(SelectFields, RequestsNameRenameAndTakeComponents) {
  const auto fields = select({"v=u", "v:z", "v:magnitude=speed", "cell/id=cells", "a=b", "a=b=c"});
  ASSERT_EQ(fields.size(), 6U);
  EXPECT_EQ(fields[0].name, "u");
  EXPECT_EQ(fields[0].components, 3U);
  EXPECT_EQ(fields[1].name, "v:z");
  EXPECT_DOUBLE_EQ(fields[1].values[1], 4);
  EXPECT_EQ(fields[2].name, "speed");
  EXPECT_DOUBLE_EQ(fields[2].values[1], 5);
  EXPECT_EQ(fields[3].name, "cells");
  EXPECT_EQ(fields[3].location, FieldLocation::cell);
  EXPECT_EQ(fields[4].name, "a=b");
  EXPECT_EQ(fields[5].name, "c");
}

TEST(SelectFields, SharedNamesMeanAll) {
  EXPECT_EQ(select({"id"}).size(), 2U);
  EXPECT_EQ(select({"node/id"}).size(), 1U);
  EXPECT_THROW(select({"id=x"}), UsageError);
}

TEST(SelectFields, WhatIsNotThereIsRefused) {
  EXPECT_THROW(select({"w"}), UsageError);
  EXPECT_THROW(select({"v:w"}), UsageError);
  EXPECT_THROW(select({"v="}), UsageError);
}

TEST(SelectFields, RefusalsSayWhatIsExpected) {
  const auto complaint = [](const ZooMesh& mesh, const std::string& request) -> std::string {
    try {
      select_fields(mesh, std::vector{request});
    } catch (const UsageError& error) {
      return error.what();
    }
    return "none";
  };
  const ZooMesh mesh = sample();
  EXPECT_EQ(complaint(mesh, "id=x"),
            "field id=x: several fields have that name (node/NAME, cell/NAME or corner/NAME "
            "expected)");
  EXPECT_EQ(complaint(mesh, "node/id=x"), "none");
  EXPECT_EQ(complaint(mesh, "v="), "field v=: the new name is empty");
  const std::string expected =
      "there is no such field (expected one of v, id, id, a=b, or a component NAME:x or "
      "NAME:magnitude)";
  EXPECT_EQ(complaint(mesh, "w"), "field w: " + expected);
  EXPECT_EQ(complaint(mesh, "v:w"), "field v:w: " + expected);
  EXPECT_EQ(complaint(mesh, "w=v"), "field w=v: " + expected);
  EXPECT_EQ(complaint(mesh, "cell/v"), "field cell/v: " + expected);
  EXPECT_EQ(complaint(mesh, "id:x"), "field id:x: " + expected);
  EXPECT_EQ(complaint(ZooMesh(), "w"), "field w: there is no such field (the mesh has none)");
}

TEST(KeepCorners, DropsMidEdgeNodesAndTheirData) {
  ZooMesh mesh = sample();
  std::vector<std::string> notes;
  keep_corners(mesh, notes);
  validate(mesh, "mesh");
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(mesh.kinds[0], CellKind::tetrahedron4);
  EXPECT_EQ(mesh.node_count(), 4U);
  // nodes 9 8 7 6 stay, renumbered in their old order
  EXPECT_EQ(std::vector<NodeId>(mesh.nodes.begin(), mesh.nodes.end()),
            (std::vector<NodeId>{3, 2, 1, 0}));
  EXPECT_DOUBLE_EQ(mesh.position(3)[1], 18);
  EXPECT_DOUBLE_EQ(mesh.fields[1].values[0], 6);
  EXPECT_DOUBLE_EQ(mesh.fields[2].values[0], 7);
  EXPECT_EQ(mesh.fields[3].values.size(), 4U);
  EXPECT_DOUBLE_EQ(mesh.fields[3].values[3], 3);
}

}  // namespace
}  // namespace hiac::formats

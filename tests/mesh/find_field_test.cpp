#include "hiac/mesh/fields/find_field.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

ZooMesh with_fields() {
  ZooMesh mesh;
  mesh.fields.push_back({"p", "", FieldLocation::cell, 1, {}});
  mesh.fields.push_back({"v", "", FieldLocation::node, 3, {}});
  mesh.fields.push_back({"v", "", FieldLocation::corner, 3, {}});
  mesh.fields.push_back({"q@cell", "", FieldLocation::node, 1, {}});
  return mesh;
}

TEST(FindField, ByItsNameWithItsLocationOrWithout) {
  const ZooMesh mesh = with_fields();
  EXPECT_EQ(find_field(mesh, "p"), &mesh.fields[0]);
  EXPECT_EQ(find_field(mesh, "p@cell"), &mesh.fields[0]);
  EXPECT_EQ(find_field(mesh, "p@node"), nullptr);
  EXPECT_EQ(find_field(mesh, "v@node"), &mesh.fields[1]);
  EXPECT_EQ(find_field(mesh, "v@corner"), &mesh.fields[2]);
  EXPECT_EQ(find_field(mesh, "q@cell"), &mesh.fields[3]);
  EXPECT_EQ(find_field(mesh, "q"), nullptr);
  for (const Field& field : mesh.fields)
    EXPECT_EQ(find_field(mesh, distinct_name(mesh, field)), &field);
}

TEST(FindField, RefusesAnAmbiguousName) {
  try {
    find_field(with_fields(), "v");
    FAIL() << "found";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("one field expected, v@node and v@corner found"));
  }
}

}  // namespace
}  // namespace hiac

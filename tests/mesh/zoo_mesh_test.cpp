#include "hiac/mesh/zoo_mesh.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "tests/mesh/sample_meshes.hpp"

namespace hiac {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string complaint_about(const ZooMesh& mesh) {
  try {
    validate(mesh, "m.zoo");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

template <typename T>
std::vector<T> copy(const SharedArray<T>& array) {
  return {array.begin(), array.end()};
}

TEST(Validate, AcceptsEveryKindAndTheEmptyMesh) {
  EXPECT_EQ(complaint_about(samples::one_of_each_kind()), "");
  EXPECT_EQ(complaint_about(samples::make_mesh({}, 0)), "");
}

TEST(Validate, NamesTheCellOfUnknownKind) {
  ZooMesh mesh = samples::brick_grid(2);
  auto kinds = copy(mesh.kinds);
  kinds[5] = static_cast<CellKind>(15);
  mesh.kinds = std::move(kinds);
  EXPECT_EQ(complaint_about(mesh), "m.zoo: cell 5: unknown kind (below 15 expected, 15 found)");
}

TEST(Validate, NamesTheCellWithTheWrongNumberOfNodes) {
  ZooMesh mesh = samples::brick_grid(2);
  auto elems = copy(mesh.elems);
  elems[4] += 1;
  mesh.elems = std::move(elems);
  EXPECT_THAT(complaint_about(mesh),
              HasSubstr("cell 3: wrong number of nodes (8 expected of a brick8"));
  elems = copy(mesh.elems);
  elems[3] = 1000, elems[4] = 0;
  mesh.elems = std::move(elems);
  EXPECT_THAT(complaint_about(mesh), HasSubstr("cell 2: wrong number of nodes"));
}

TEST(Validate, NamesTheCellWhoseNodeIsOutOfRange) {
  ZooMesh mesh = samples::brick_grid(2);
  auto nodes = copy(mesh.nodes);
  nodes[8 * 6 + 3] = 27;
  nodes[8 * 7] = 99;
  mesh.nodes = std::move(nodes);
  EXPECT_EQ(complaint_about(mesh),
            "m.zoo: cell 6: node out of range (below 27 expected, 27 found)");
}

TEST(Validate, NamesTheNodeThatIsNotFinite) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    ZooMesh mesh = samples::brick_grid(2);
    auto xyz = copy(mesh.xyz);
    xyz[3 * 20 + 1] = bad;
    mesh.xyz = std::move(xyz);
    EXPECT_THAT(complaint_about(mesh), HasSubstr("node 20: coordinate y is not finite"));
  }
}

TEST(Validate, NamesTheFieldOfTheWrongSize) {
  ZooMesh mesh = samples::one_of_each_kind();
  mesh.fields[1].components = 2;
  EXPECT_THAT(complaint_about(mesh), HasSubstr("field \"velocity\": wrong number of values"));
  mesh.fields[1].components = 0;
  EXPECT_THAT(complaint_about(mesh), HasSubstr("field \"velocity\": no components"));
}

TEST(Validate, AcceptsValuesThatAreNotNumbers) {
  ZooMesh mesh = samples::brick_grid(1);
  mesh.fields.push_back({"f", "", FieldLocation::cell, 1, std::vector<double>{std::nan("")}});
  EXPECT_EQ(complaint_about(mesh), "");
}

TEST(Validate, ChecksTheAdjacency) {
  ZooMesh mesh = samples::brick_grid(1);
  mesh.adjacency = FaceAdjacency{std::vector<CellId>(5, kNoCell), 0};
  EXPECT_THAT(complaint_about(mesh), HasSubstr("6 faces expected, 5 found"));
  mesh.adjacency = FaceAdjacency{std::vector<CellId>{kNoCell, 0, 1, 0, 0, 0}, 0};
  EXPECT_THAT(complaint_about(mesh), HasSubstr("face 2: neighbour out of range"));
}

TEST(FaceOffsets, CountFacesCellByCell) {
  const auto offsets = face_offsets(samples::one_of_each_kind());
  EXPECT_THAT(offsets, ElementsAre(0, 4, 8, 12, 17, 22, 27, 32, 37, 42, 48, 54, 60, 66, 72, 78));
}

TEST(ContentHash, DependsOnTheMeshAndItsFieldsAlone) {
  const ZooMesh mesh = samples::one_of_each_kind();
  const std::string hash = content_hash(mesh);
  EXPECT_EQ(hash.size(), 32u);
  EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);

  ZooMesh same = samples::one_of_each_kind();
  same.metadata.clear();
  same.adjacency = FaceAdjacency{std::vector<CellId>(78, kNoCell), 0};
  EXPECT_EQ(content_hash(same), hash);

  std::vector<ZooMesh> others(6, mesh);
  others[0].fields.pop_back();
  others[1].fields[0].name += "s";
  others[2].fields[0].unit = "";
  others[3].xyz = [&] {
    auto v = copy(mesh.xyz);
    v[5] += 1e-15;
    return v;
  }();
  others[4].nodes = [&] {
    auto v = copy(mesh.nodes);
    std::swap(v[0], v[1]);
    return v;
  }();
  others[5].fields[3].values = [&] {
    auto v = copy(mesh.fields[3].values);
    v[0] += 1;
    return v;
  }();
  for (const ZooMesh& other : others) EXPECT_NE(content_hash(other), hash);
}

// An order file made by an earlier build must still find its mesh.
TEST(ContentHash, StaysTheSameFromBuildToBuild) {
  EXPECT_EQ(content_hash(samples::one_of_each_kind()), "eef6941e0718fbb5f12fc9c1f05a0403");
}

ZooMesh vector_mesh() {
  ZooMesh mesh = samples::brick_grid(1);
  mesh.fields.push_back({"p", "Pa", FieldLocation::cell, 1, std::vector<double>{7}});
  mesh.fields.push_back({"v", "m/s", FieldLocation::cell, 3, std::vector<double>{2, -3, 6}});
  mesh.fields.push_back({"s", "", FieldLocation::cell, 6, std::vector<double>{1, 2, 3, 4, 5, 6}});
  mesh.fields.push_back({"q", "", FieldLocation::cell, 4, std::vector<double>{1, 2, 3, 4}});
  mesh.fields.push_back({"a:x", "", FieldLocation::cell, 1, std::vector<double>{11}});
  return mesh;
}

TEST(ScalarField, PicksComponentsAndMagnitudes) {
  const ZooMesh mesh = vector_mesh();
  const auto value = [&](const char* name) { return scalar_field(mesh, name).values[0]; };
  EXPECT_EQ(value("p"), 7);
  EXPECT_EQ(value("p:0"), 7);
  EXPECT_EQ(value("v:x"), 2);
  EXPECT_EQ(value("v:z"), 6);
  EXPECT_EQ(value("v:1"), -3);
  EXPECT_EQ(value("v:magnitude"), 7);
  EXPECT_EQ(value("s:yy"), 2);
  EXPECT_EQ(value("s:xz"), 6);
  EXPECT_EQ(value("q:3"), 4);
  EXPECT_EQ(value("a:x"), 11);
  EXPECT_EQ(scalar_field(mesh, "v:x").unit, "m/s");
  EXPECT_EQ(scalar_field(mesh, "v:x").components, 1u);
}

TEST(ScalarField, CopiesNothingOfAScalar) {
  const ZooMesh mesh = vector_mesh();
  EXPECT_EQ(scalar_field(mesh, "p").values.data(), mesh.fields[0].values.data());
}

TEST(ScalarField, MagnitudeNeitherOverflowsNorVanishes) {
  ZooMesh mesh = samples::brick_grid(1);
  mesh.fields.push_back({"huge", "", FieldLocation::cell, 2, std::vector<double>{3e200, 4e200}});
  mesh.fields.push_back({"tiny", "", FieldLocation::cell, 2, std::vector<double>{3e-200, 4e-200}});
  EXPECT_DOUBLE_EQ(scalar_field(mesh, "huge:magnitude").values[0], 5e200);
  EXPECT_DOUBLE_EQ(scalar_field(mesh, "tiny:magnitude").values[0], 5e-200);
}

TEST(ScalarField, NamesWhatThereIsWhenThereIsNoSuchField) {
  const ZooMesh mesh = vector_mesh();
  for (const char* wrong : {"nothing", "v", "v:w", "v:3", "v:", "s:zx", "q:4", ":x", "p:y"}) {
    try {
      scalar_field(mesh, wrong);
      FAIL() << wrong;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr("p, v:x, v:y, v:z, v:magnitude, s:xx"));
    }
  }
  EXPECT_THROW(scalar_field(samples::brick_grid(1), "p"), UsageError);
}

TEST(ScalarField, AcceptsEveryNameThatIsListed) {
  const ZooMesh mesh = vector_mesh();
  const auto names = scalar_field_names(mesh);
  EXPECT_EQ(names.size(), 1 + 4 + 13 + 5 + 1u);
  for (const std::string& name : names) EXPECT_EQ(scalar_field(mesh, name).values.size(), 1u);
}

TEST(ScalarField, RefusesAnAmbiguousName) {
  ZooMesh mesh = vector_mesh();
  mesh.fields.push_back({"p", "", FieldLocation::node, 1, std::vector<double>(8)});
  EXPECT_THROW(scalar_field(mesh, "p"), UsageError);
}

TEST(ScalarField, FieldsOfOneNameAreToldApartByLocation) {
  ZooMesh mesh;
  mesh.fields.push_back({"p", "", FieldLocation::node, 1, std::vector<double>{1}});
  mesh.fields.push_back({"p", "", FieldLocation::cell, 2, std::vector<double>{3, 4}});
  EXPECT_THROW(scalar_field(mesh, "p"), UsageError);
  EXPECT_EQ(scalar_field(mesh, "p@node").values[0], 1);
  EXPECT_EQ(scalar_field(mesh, "p@cell:y").values[0], 4);
  EXPECT_EQ(scalar_field(mesh, "p@cell:magnitude").values[0], 5);
  EXPECT_EQ(scalar_field_names(mesh),
            (std::vector<std::string>{"p@node", "p@cell:x", "p@cell:y", "p@cell:magnitude"}));
}

}  // namespace
}  // namespace hiac

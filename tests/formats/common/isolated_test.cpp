// What a separate process has read of a file arrives in this one with all its parts, and cells that
// cannot be right do not.
#include "formats/common/io/isolated.hpp"

#include <array>

#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

constexpr std::array<std::uint8_t, 4> kTurned{1, 0, 2, 3};

/// A mesh in which every member differs from its default.
ForeignMesh whole_mesh() {
  ForeignMesh mesh;
  mesh.xyz = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 4, 4, 4};
  mesh.node_numbers = {7, 5, 3, 1, -2};
  mesh.first_node = -4;
  mesh.types = {{"turned", 4, converted_to(CellKind::tetrahedron4, kTurned)},
                {"line", 2, kNoVolume},
                {"large", 5, unsupported_with(CellKind::tetrahedron4, kTurned)},
                {"odd", 3, kWrongCount},
                {"poly", 0, kUnsupported}};
  mesh.types[0].conversion.further_nodes = true;
  mesh.cell_types = {0, 1, 2, 4};
  mesh.cell_nodes = {7, 5, 3, 1, 7, 5, 1, 3, 5, 7, -2};
  mesh.polyhedra.cells = {3};
  mesh.polyhedra.ends = {4};
  mesh.polyhedra.faces = {3, 7, 5, 1};
  mesh.cell_numbers = {10, 20, 30, 40};
  mesh.blocks = {{"all", {{0, 1}, {2, 4}}}, {"none", {}}};
  mesh.times = {0.5, 1.5, 9};
  mesh.metadata = {{"title", "of two words"}, {"made by", "a test"}};
  mesh.notes = {"first", "second"};
  mesh.field_steps = {{"p", {0, 2}}, {"q", {1}}};
  const auto add = [&](const std::string& name, FieldLocation location, std::uint32_t components,
                       std::vector<double> values) {
    mesh.fields.push_back(field_of(name, location, components, std::move(values)));
  };
  add("p", FieldLocation::node, 1, {1, 2, 3, 4, 5});
  add("q", FieldLocation::cell, 2, {1, 2, 3, 4, 5, 6, 7, 8});
  add("r", FieldLocation::corner, 1, std::vector<double>(11, -1));
  mesh.fields[0].step = 2;
  mesh.fields[1].step = 0;
  mesh.fields[0].unit = "K";
  mesh.fields[1].type = "int32";
  return mesh;
}

void expect_type(const ForeignType& found, const ForeignType& expected) {
  EXPECT_EQ(found.name, expected.name);
  EXPECT_EQ(found.nodes, expected.nodes);
  EXPECT_EQ(found.conversion.fate, expected.conversion.fate);
  EXPECT_EQ(found.conversion.kind, expected.conversion.kind);
  EXPECT_EQ(found.conversion.corners, expected.conversion.corners);
  EXPECT_EQ(found.conversion.further_nodes, expected.conversion.further_nodes);
  EXPECT_TRUE(std::ranges::equal(found.conversion.permutation, expected.conversion.permutation));
}

TEST(Isolated, AllPartsOfAMeshArrive) {
  const ScratchFolder folder;
  const std::string path = folder.write("a", "x");
  const ForeignMesh mesh = read_isolated(path, "lib", [](const std::string& file) {
    ForeignMesh made = whole_mesh();
    made.notes.push_back(file);
    return made;
  });
  const ForeignMesh expected = whole_mesh();
  EXPECT_EQ(mesh.xyz, expected.xyz);
  EXPECT_EQ(mesh.node_numbers, expected.node_numbers);
  EXPECT_EQ(mesh.first_node, -4);
  ASSERT_EQ(mesh.types.size(), expected.types.size());
  for (std::size_t t = 0; t < mesh.types.size(); ++t) expect_type(mesh.types[t], expected.types[t]);
  EXPECT_EQ(mesh.cell_types, expected.cell_types);
  EXPECT_EQ(mesh.cell_nodes, expected.cell_nodes);
  EXPECT_EQ(mesh.polyhedra.cells, expected.polyhedra.cells);
  EXPECT_EQ(mesh.polyhedra.ends, expected.polyhedra.ends);
  EXPECT_EQ(mesh.polyhedra.faces, expected.polyhedra.faces);
  EXPECT_EQ(mesh.cell_numbers, expected.cell_numbers);
  ASSERT_EQ(mesh.blocks.size(), 2U);
  EXPECT_EQ(mesh.blocks[0].name, "all");
  ASSERT_EQ(mesh.blocks[0].cells.size(), 2U);
  EXPECT_EQ(mesh.blocks[0].cells[1].begin, 2U);
  EXPECT_EQ(mesh.blocks[0].cells[1].end, 4U);
  EXPECT_EQ(mesh.blocks[1].name, "none");
  EXPECT_THAT(mesh.blocks[1].cells, IsEmpty());
  EXPECT_EQ(mesh.times, expected.times);
  EXPECT_EQ(mesh.metadata, expected.metadata);
  EXPECT_THAT(mesh.notes, ElementsAre("first", "second", path));
  EXPECT_THAT(mesh.field_steps,
              ElementsAre(Pair("p", ElementsAre(0, 2)), Pair("q", ElementsAre(1))));
}

TEST(Isolated, FieldsArriveWithTheirValuesOnRequest) {
  const ScratchFolder folder;
  const std::string path = folder.write("a", "x");
  const ForeignMesh mesh = read_isolated(path, "lib", [](const std::string&) {
    ForeignMesh made = whole_mesh();
    made.fields[2].values = []() -> std::vector<double> { throw InputError("v", "is damaged"); };
    return made;
  });
  const ForeignMesh expected = whole_mesh();
  ASSERT_EQ(mesh.fields.size(), 3U);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(mesh.fields[f].name, expected.fields[f].name);
    EXPECT_EQ(mesh.fields[f].unit, expected.fields[f].unit);
    EXPECT_EQ(mesh.fields[f].type, expected.fields[f].type);
    EXPECT_EQ(mesh.fields[f].location, expected.fields[f].location);
    EXPECT_EQ(mesh.fields[f].components, expected.fields[f].components);
    EXPECT_EQ(mesh.fields[f].step, expected.fields[f].step);
  }
  EXPECT_EQ(mesh.fields[1].values(), expected.fields[1].values());
  EXPECT_THAT(mesh.fields[2].values,
              testing::ThrowsMessage<InputError>(HasSubstr("v: is damaged")));
  // in any order, and more than once
  for (int i = 0; i < 2; ++i) EXPECT_EQ(mesh.fields[0].values(), expected.fields[0].values());
}

/// Whether a mesh with the cells of that type comes through.
bool arrives(const ForeignType& type, FieldLocation location = FieldLocation::node) {
  const ScratchFolder folder;
  try {
    read_isolated(folder.write("a", "x"), "lib", [&](const std::string&) {
      ForeignMesh mesh;
      mesh.types = {type};
      mesh.fields.push_back(field_of("f", location, 1, {}));
      return mesh;
    });
  } catch (const InputError&) {
    return false;
  }
  return true;
}

TEST(Isolated, CellsHaveTheNodesThatTheirConversionTakes) {
  constexpr CellKind kTetrahedron = CellKind::tetrahedron4;
  constexpr std::array<std::uint8_t, 5> kFive{0, 1, 2, 3, 4};
  constexpr std::array<std::uint8_t, 3> kThree{0, 1, 2};
  for (const auto& with : {&converted_to, &unsupported_with}) {
    EXPECT_TRUE(arrives({"t", 4, with(kTetrahedron, {})}));
    EXPECT_TRUE(arrives({"t", 5, with(kTetrahedron, {})}));
    EXPECT_FALSE(arrives({"t", 3, with(kTetrahedron, {})}));
    EXPECT_TRUE(arrives({"t", 4, with(kTetrahedron, kTurned)}));
    EXPECT_FALSE(arrives({"t", 3, with(kTetrahedron, kTurned)}));
    EXPECT_FALSE(arrives({"t", 4, with(kTetrahedron, kFive)}));
    EXPECT_TRUE(arrives({"t", 5, with(kTetrahedron, kFive)}));
    EXPECT_FALSE(arrives({"t", 4, with(kTetrahedron, kThree)}));
  }
  for (const CellConversion& conversion : {kUnsupported, kNoVolume, kWrongCount})
    EXPECT_TRUE(arrives({"t", 0, conversion}));
}

TEST(Isolated, NumbersThatNameNothingAreRefused) {
  const ForeignType line{"line", 2, kNoVolume};
  EXPECT_TRUE(arrives(line, FieldLocation::corner));
  EXPECT_FALSE(arrives(line, static_cast<FieldLocation>(3)));
  ForeignType type = line;
  type.conversion.fate = static_cast<CellFate>(4);
  EXPECT_FALSE(arrives(type));
  type = line;
  type.conversion.kind = static_cast<CellKind>(kKindCount);
  EXPECT_FALSE(arrives(type));
}

}  // namespace
}  // namespace hiac::formats

// Physical groups, values on the corners of elements, and the parameters of nodes in MSH files;
// what MSH files do not hold when they are written.
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/raw_bytes.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const std::string kMshFour =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
    "$EndNodes\n";

TEST(GmshGroups, OfTheFirstTagAreBlocks) {
  const ScratchFolder folder;
  const std::string tetrahedron = " 1 2 3 4\n";
  const std::string path = folder.write(
      "a.msh", kMshFour +
                   "$PhysicalNames\n2\n2 6 \"skin\"\n3 7 \"core\"\n$EndPhysicalNames\n"
                   "$Elements\n8\n1 4 2 6 1" +
                   tetrahedron + "2 4 2 6 1" + tetrahedron + "3 4 3 7 1 9" + tetrahedron +
                   "4 2 2 6 1 1 2 3\n5 4 2 6 1" + tetrahedron + "6 4 2 0 1" + tetrahedron +
                   "7 4 0" + tetrahedron + "8 4 1 7" + tetrahedron + "$EndElements\n");
  EXPECT_THAT(format_named("gmsh").inspect(path).blocks, UnorderedElementsAre("6", "core"));
  EXPECT_EQ(read_any(path).mesh.cell_count(), 7U);
  for (const auto& [block, cells] :
       std::vector<std::pair<std::string, std::size_t>>{{"6", 3}, {"core", 2}}) {
    ReadOptions options;
    options.block = block;
    EXPECT_EQ(read_any(path, options).mesh.cell_count(), cells) << block;
  }
}

TEST(GmshGroups, OfVersion1AreTheFirstNumber) {
  const ScratchFolder folder;
  const std::string path =
      folder.write("a.msh",
                   "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$ENDNOD\n$ELM\n3\n"
                   "1 4 5 8 4 1 2 3 4\n2 4 0 8 4 1 2 3 4\n3 4 8 5 4 1 2 3 4\n$ENDELM\n");
  EXPECT_THAT(format_named("gmsh").inspect(path).blocks, UnorderedElementsAre("5", "8"));
}

TEST(GmshNodes, ParametersOfVersion4ArePassedOver) {
  const ScratchFolder folder;
  const std::string elements = "$Elements\n1 1 1 1\n3 1 4 1\n9 1 2 3 4\n$EndElements\n";
  // on a point, a curve, a surface and in a volume; without parameters
  expect_unit_tetrahedron(
      read_any(folder.write("a.msh",
                            "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n4 4 1 4\n"
                            "0 1 1 1\n1\n0 0 0\n1 1 1 1\n2\n1 0 0 .5\n2 1 1 1\n3\n"
                            "0 1 0 .5 .5\n3 1 1 1\n4\n0 0 1 .5 .5 .5\n$EndNodes\n" +
                                elements))
          .mesh);
  expect_unit_tetrahedron(
      read_any(folder.write("b.msh",
                            "$MeshFormat\n4 0 8\n$EndMeshFormat\n$Nodes\n2 4\n"
                            "1 2 1 2\n1 0 0 0 .5 .5\n2 1 0 0 .5 .5\n1 3 0 2\n3 0 1 0\n"
                            "4 0 0 1\n$EndNodes\n$Elements\n1 1\n1 3 4 1\n9 1 2 3 4\n"
                            "$EndElements\n"))
          .mesh);
}

// Version 4.0 has integers of 32 bits: a point takes eight bytes.
TEST(GmshElements, OfVersion40InBinaryMayBeManyPoints) {
  const ScratchFolder folder;
  std::string text = "$MeshFormat\n4 1 8\n" + raw_bytes<std::int32_t>({1}) +
                     "\n$EndMeshFormat\n$Nodes\n" + raw_bytes<std::uint64_t>({1, 4}) +
                     raw_bytes<std::int32_t>({1, 3, 0}) + raw_bytes<std::uint64_t>({4});
  for (const int n : {1, 2, 3, 4})
    text += raw_bytes<std::int32_t>({n}) +
            raw_bytes<double>({n == 2 ? 1.0 : 0.0, n == 3 ? 1.0 : 0.0, n == 4 ? 1.0 : 0.0});
  text += "\n$EndNodes\n$Elements\n" + raw_bytes<std::uint64_t>({2, 31}) +
          raw_bytes<std::int32_t>({1, 3, 4}) + raw_bytes<std::uint64_t>({1}) +
          raw_bytes<std::int32_t>({99, 1, 2, 3, 4}) + raw_bytes<std::int32_t>({1, 0, 15}) +
          raw_bytes<std::uint64_t>({30});
  for (int point = 0; point < 30; ++point) text += raw_bytes<std::int32_t>({point + 1, 1});
  const Reading reading = read_any(folder.write("a.msh", text + "\n$EndElements\n"));
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, ElementsAre("dropped cells without volume: 30 Point"));
}

// Values at the corners of a quadratic element alone are linear along its edges.
TEST(GmshData, CornersOfQuadraticElementsGiveTheEdges) {
  const ScratchFolder folder;
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n";
  const auto places = reference_nodes(CellKind::tetrahedron10);
  for (std::size_t n = 0; n < 10; ++n)
    text += fmt::format("{} {} {} {}\n", n + 1, places[n][0], places[n][1], places[n][2]);
  // Gmsh's last two edges are 3-2 and 3-1
  text += "$EndNodes\n$Elements\n2\n1 11 0 1 2 3 4 5 6 7 8 10 9\n2 2 0 1 2 3\n$EndElements\n";
  const auto data = [&](const std::string& values) {
    return folder.write("a.msh", text + "$ElementNodeData\n1\n\"p\"\n0\n3\n0\n1\n2\n" + values +
                                     "2 5 9 9 9 9 9\n$EndElementNodeData\n");
  };
  const ZooMesh mesh = read_any(data("1 4 0 2 4 8\n")).mesh;
  ASSERT_EQ(mesh.kinds[0], CellKind::tetrahedron10);
  const Field& p = field_named(mesh, "p");
  for (std::size_t n = 0; n < 10; ++n)
    EXPECT_EQ(p.values[n], 2 * places[n][0] + 4 * places[n][1] + 8 * places[n][2]) << n;
  const ZooMesh whole = read_any(data("1 10 0 1 2 3 4 5 6 7 9 8\n")).mesh;
  for (std::size_t n = 0; n < 10; ++n)
    EXPECT_EQ(field_named(whole, "p").values[n], static_cast<double>(n)) << n;
  EXPECT_THAT(refusal(data("1 5 0 1 2 3 4\n")),
              testing::EndsWith("values at the 10 nodes of a Tetrahedron 10 expected (5 found)"));
}

/// The unit tetrahedron with a field on its cell by each name.
ZooMesh mesh_with_fields(const std::vector<std::string>& names, std::uint32_t components = 1) {
  ZooMesh mesh;
  mesh.kinds = std::vector<CellKind>{CellKind::tetrahedron4};
  mesh.elems = std::vector<std::uint64_t>{0, 4};
  mesh.nodes = std::vector<NodeId>{0, 1, 2, 3};
  mesh.xyz = std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (const std::string& name : names)
    mesh.fields.push_back(
        {name, "", FieldLocation::cell, components, std::vector<double>(components, 1)});
  return mesh;
}

TEST(GmshWriting, FieldsHaveNamesOfTheirOwn) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.msh");
  const auto said = [&](const ZooMesh& mesh) {
    try {
      format_to_write(path).write(path, mesh);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path.size());
    }
    return std::string();
  };
  EXPECT_EQ(said(mesh_with_fields({"p", "q"})), "");
  EXPECT_EQ(said(mesh_with_fields({"p", "q", "p"})),
            ": Gmsh cannot hold two fields of one name in one place ('p' found twice: rename one)");
  for (const std::string name : {"a\"b", "a\nb", "a\rb", ""})
    EXPECT_EQ(said(mesh_with_fields({name})),
              ": Gmsh cannot hold a field of the name '" + name + "' (rename it)");
  ZooMesh apart = mesh_with_fields({"p"});
  apart.fields.push_back({"p", "", FieldLocation::node, 1, std::vector<double>{1, 2, 3, 4}});
  EXPECT_EQ(said(apart), "");
  EXPECT_EQ(read_any(path).mesh.fields.size(), 2U);
}

TEST(GmshWriting, NotesTellWhatIsLeftOut) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.msh");
  const auto notes = [&](const ZooMesh& mesh) { return format_to_write(path).write(path, mesh); };
  EXPECT_THAT(notes(mesh_with_fields({"p"})), IsEmpty());
  for (const std::uint32_t components : {1U, 3U, 9U})
    EXPECT_THAT(notes(mesh_with_fields({"p"}, components)), IsEmpty());
  for (const std::uint32_t components : {2U, 4U, 6U, 8U, 10U})
    EXPECT_THAT(notes(mesh_with_fields({"p"}, components)),
                ElementsAre(fmt::format("field 'p' has {} components; Gmsh itself shows fields "
                                        "with 1, 3 or 9",
                                        components)));
  ZooMesh mesh = mesh_with_fields({"p"});
  mesh.fields[0].unit = "K";
  mesh.metadata = {{"time", "0.5 s"}, {"source", "x"}, {"title", "y"}};
  EXPECT_THAT(notes(mesh), ElementsAre("left out, Gmsh having no place for them: time, title",
                                       "the unit of 'p' is left out, Gmsh having no place for it"));
  mesh = mesh_with_fields({"p"});
  mesh.metadata = {{"time", "0.5"}};
  EXPECT_THAT(notes(mesh), IsEmpty());
  EXPECT_THAT(format_named("gmsh").inspect(path).times, ElementsAre(0.5));
}

}  // namespace
}  // namespace hiac::formats

#include <cmath>
#include <limits>

#include "hiac/base/parallel.hpp"
#include "hiac/base/process/isolated_process.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/files.hpp"
#include "tests/support/threads.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// One cell of every kind in `kinds`, side by side, with fields of awkward numbers.
ZooMesh mesh_of(const std::vector<CellKind>& kinds) {
  ZooMesh mesh;
  std::vector<std::uint64_t> elems{0};
  std::vector<NodeId> nodes;
  std::vector<double> xyz;
  for (std::size_t c = 0; c < kinds.size(); ++c) {
    for (const auto& p : reference_nodes(kinds[c])) {
      nodes.push_back(static_cast<NodeId>(nodes.size()));
      xyz.insert(xyz.end(), {p[0] + 3.1 * static_cast<double>(c), p[1] / 3, p[2]});
    }
    elems.push_back(nodes.size());
  }
  std::vector<double> node_field;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    node_field.insert(node_field.end(), {std::sin(static_cast<double>(i)), 1.0 / 3, -0.0});
  node_field[0] = std::numeric_limits<double>::quiet_NaN();
  node_field[1] = std::numeric_limits<double>::denorm_min();
  node_field[3] = std::numeric_limits<double>::infinity();
  mesh.fields.push_back({"velocity", "m/s", FieldLocation::node, 3, std::move(node_field)});
  mesh.fields.push_back(
      {"region", "", FieldLocation::cell, 1, std::vector<double>(kinds.size(), 1e-300)});
  mesh.kinds = std::vector<CellKind>(kinds);
  mesh.elems = std::move(elems);
  mesh.nodes = std::move(nodes);
  mesh.xyz = std::move(xyz);
  mesh.metadata = {{"source", "solver.frd"}, {"time", "0.1"}, {"remark", "a <b> & \"c\""}};
  return mesh;
}

const Format& vtu() { return format_named("vtu"); }

TEST(VtuWriting, EverythingComesBackBitForBit) {
  const ScratchFolder folder;
  const ZooMesh mesh =
      mesh_of({CellKind::tetrahedron4, CellKind::pyramid5, CellKind::prism6, CellKind::brick8,
               CellKind::tetrahedron10, CellKind::pyramid13, CellKind::prism15, CellKind::brick20,
               CellKind::tetrahedron20, CellKind::wedge7, CellKind::wedge18});
  const std::string path = folder.file("all.vtu");
  const auto notes = vtu().write(path, mesh);
  EXPECT_THAT(notes, Contains(HasSubstr("1 wedge7 cells written as bricks")));
  EXPECT_THAT(notes, Contains(HasSubstr("1 wedge18 cells written as bricks")));
  const ZooMesh back = read_any(path).mesh;
  EXPECT_EQ(content_hash(back), content_hash(mesh));
  EXPECT_EQ(back.metadata, mesh.metadata);
  EXPECT_EQ(back.fields[0].unit, "m/s");
  const std::string text = text_of(path);
  EXPECT_THAT(text, HasSubstr("header_type=\"UInt64\""));
  EXPECT_THAT(text, HasSubstr("<AppendedData encoding=\"raw\">"));
}

// Only a number, and all of the text, is the time; a number of another name is none.
TEST(VtuWriting, MetadataThatLookLikeTimes) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtu");
  ZooMesh mesh = mesh_of({CellKind::tetrahedron4});
  for (const char* text : {"soon", "0.5 s", "0.5"}) {
    mesh.metadata = {{"source", "a.vtu"}, {"revision", "7"}, {"time", text}};
    vtu().write(path, mesh);
    EXPECT_THAT(read_any(path).mesh.metadata, testing::UnorderedElementsAreArray(mesh.metadata));
    const std::size_t times = std::string(text) == "0.5" ? 1 : 0;
    EXPECT_EQ(vtu().inspect(path).times.size(), times) << text;
  }
}

TEST(VtuWriting, KindsThatVtuLacksAreRefusedByName) {
  const ScratchFolder folder;
  for (const CellKind kind :
       {CellKind::pyramid21, CellKind::prism24, CellKind::wedge29, CellKind::brick32}) {
    const std::string path = folder.file("no.vtu");
    try {
      vtu().write(path, mesh_of({kind, kind}));
      ADD_FAILURE() << kind_name(kind);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(kind_name(kind)));
      EXPECT_THAT(error.what(), HasSubstr("2 found"));
    }
    EXPECT_FALSE(std::filesystem::exists(path));
  }
}

TEST(VtuWriting, CornerFieldsAreLeftOutWithANote) {
  const ScratchFolder folder;
  ZooMesh mesh = mesh_of({CellKind::tetrahedron4});
  mesh.fields.push_back({"stress", "", FieldLocation::corner, 1, std::vector<double>(4, 1)});
  const std::string path = folder.file("a.vtu");
  EXPECT_THAT(vtu().write(path, mesh), Contains(HasSubstr("'stress' lives on cell corners")));
  EXPECT_EQ(read_any(path).mesh.fields.size(), 2U);
}

// A fork of this process reads the file, and has no thread but the one that forked.
TEST(VtuWriting, NoThreadOfItsOwnIsLeftWhenTheFileIsRead) {
  const ScratchFolder folder;
  const ThreadLimit four(4);
  vtu().write(folder.file("a.vtu"), mesh_of({CellKind::tetrahedron4}));
  ASSERT_GT(test::threads_here(), 1);
  const IsolatedProcess process("nothing", [](const auto&...) {});
  EXPECT_TRUE(test::one_thread_remains());
}

TEST(VtuWriting, TwoFieldsOfOneNameAreRefused) {
  const ScratchFolder folder;
  ZooMesh mesh = mesh_of({CellKind::tetrahedron4});
  mesh.fields.push_back({"region", "", FieldLocation::node, 1, std::vector<double>(4, 1)});
  EXPECT_NO_THROW(vtu().write(folder.file("a.vtu"), mesh));
  mesh.fields.push_back(mesh.fields.back());
  EXPECT_THROW(vtu().write(folder.file("b.vtu"), mesh), InputError);
}

TEST(VtuWriting, AFolderThatIsNotThereIsAnError) {
  const ScratchFolder folder;
  EXPECT_THROW(vtu().write(folder.file("no/a.vtu"), mesh_of({CellKind::tetrahedron4})), InputError);
}

TEST(VtuWriting, RealFilesComeBack) {
  const ScratchFolder folder;
  for (const char* name : {"/vtk_legacy/classic/spx.vtk", "/vtk_xml/fe_results/notch_disp.vtu",
                           "/vtk_legacy/tets/flat-tet-sphere.vtk"}) {
    const std::string path = data_dir() + name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const ZooMesh mesh = read_any(path).mesh;
    vtu().write(folder.file("b.vtu"), mesh);
    EXPECT_EQ(content_hash(read_any(folder.file("b.vtu")).mesh), content_hash(mesh)) << name;
  }
}

// VTKHDF is optional: a build without HDF5 cannot write it.
const Format* vtkhdf() {
  for (const Format& format : all_formats())
    if (format.name == "vtkhdf") return &format;
  return nullptr;
}

TEST(VtkHdfWriting, EverythingComesBackBitForBit) {
  if (vtkhdf() == nullptr) GTEST_SKIP() << "this build has no HDF5";
  const ScratchFolder folder;
  for (const bool timed : {false, true}) {
    ZooMesh mesh =
        mesh_of({CellKind::tetrahedron4, CellKind::pyramid5, CellKind::prism6, CellKind::brick8,
                 CellKind::tetrahedron10, CellKind::pyramid13, CellKind::prism15, CellKind::brick20,
                 CellKind::tetrahedron20, CellKind::wedge7, CellKind::wedge18});
    mesh.fields[0].unit = "";
    mesh.metadata = {{"source", "all.vtkhdf"}};
    if (timed) mesh.metadata.emplace_back("time", "0.1");
    const std::string path = folder.file("all.vtkhdf");
    const auto notes = format_to_write(path).write(path, mesh);
    EXPECT_THAT(notes, Contains(HasSubstr("1 wedge7 cells written as bricks")));
    const ZooMesh back = read_any(path).mesh;
    EXPECT_EQ(content_hash(back), content_hash(mesh));
    EXPECT_EQ(back.metadata, mesh.metadata);
  }
}

TEST(VtkHdfWriting, WhatCannotBeHeldIsToldOrRefused) {
  if (vtkhdf() == nullptr) GTEST_SKIP() << "this build has no HDF5";
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  ZooMesh mesh = mesh_of({CellKind::tetrahedron4});
  mesh.fields.push_back({"stress", "", FieldLocation::corner, 1, std::vector<double>(4, 1)});
  mesh.fields.push_back({"a/b", "", FieldLocation::node, 1, std::vector<double>(4, 1)});
  const auto notes = vtkhdf()->write(path, mesh);
  EXPECT_THAT(notes, Contains(HasSubstr("'stress' lives on cell corners")));
  EXPECT_THAT(notes, Contains(HasSubstr("'a/b' is called 'a_b'")));
  EXPECT_THAT(notes, Contains(HasSubstr("the unit of field 'velocity' (m/s)")));
  EXPECT_THAT(notes, Contains(HasSubstr("metadata 'remark'")));
  EXPECT_EQ(read_any(path).mesh.fields.size(), 3U);
  EXPECT_THROW(vtkhdf()->write(folder.file("b.vtkhdf"), mesh_of({CellKind::brick32})), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.vtkhdf")));
  EXPECT_THROW(vtkhdf()->write(folder.file("no/a.vtkhdf"), mesh), InputError);
  // a name stands once on the nodes and once on the cells
  ZooMesh twice = mesh_of({CellKind::tetrahedron4});
  twice.fields.push_back({"region", "", FieldLocation::node, 1, std::vector<double>(4, 1)});
  EXPECT_NO_THROW(vtkhdf()->write(path, twice));
  twice.fields.push_back(twice.fields.back());
  for (const std::string name : {"region", ""}) {
    twice.fields.back().name = name;
    EXPECT_THAT([&] { vtkhdf()->write(path, twice); },
                testing::ThrowsMessage<InputError>(
                    HasSubstr("nor one without a name ('" + name + "' found")));
  }
}

TEST(VtkHdfWriting, MetadataThatLookLikeTimes) {
  if (vtkhdf() == nullptr) GTEST_SKIP() << "this build has no HDF5";
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  ZooMesh mesh = mesh_of({CellKind::tetrahedron4});
  mesh.fields.clear();
  for (const char* text : {"soon", "0.5 s", "0.5"}) {
    mesh.metadata = {{"source", "a.vtkhdf"}, {"revision", "7"}, {"time", text}};
    const bool timed = std::string(text) == "0.5";
    std::vector<std::string> left_out{"metadata 'revision' is left out"};
    if (!timed) left_out.emplace_back("metadata 'time' is left out");
    EXPECT_EQ(vtkhdf()->write(path, mesh), left_out) << text;
    EXPECT_EQ(vtkhdf()->inspect(path).times.size(), timed ? 1U : 0U) << text;
  }
}

}  // namespace
}  // namespace hiac::formats

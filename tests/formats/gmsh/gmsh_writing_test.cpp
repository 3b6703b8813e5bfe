// What is written as MSH comes back to the last bit: kinds, nodes, places, fields wherever they
// live, and the time.
#include <random>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;

/// One cell of each kind given, side by side, with random fields of all locations, NaN among them.
ZooMesh mesh_of_kinds(const std::vector<CellKind>& kinds) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<double> xyz;
  std::vector<NodeId> nodes;
  std::vector<std::uint64_t> elems{0};
  for (const CellKind kind : kinds) {
    for (const auto& xi : reference_nodes(kind)) {
      nodes.push_back(static_cast<NodeId>(xyz.size() / 3));
      for (std::size_t c = 0; c < 3; ++c)
        xyz.push_back(xi[c] / 3 + (c == 0 ? 3.0 * static_cast<double>(elems.size()) : 0.1));
    }
    elems.push_back(nodes.size());
  }
  ZooMesh mesh;
  const std::array<std::size_t, 3> tuples{xyz.size() / 3, kinds.size(), nodes.size()};
  mesh.kinds = std::vector<CellKind>(kinds);
  mesh.elems = std::move(elems);
  mesh.nodes = std::move(nodes);
  mesh.xyz = std::move(xyz);
  for (std::size_t location = 0; location < 3; ++location) {
    for (const std::uint32_t components : {1U, 3U, 6U}) {
      std::vector<double> values(tuples[location] * components);
      for (double& v : values) v = value(random);
      values.front() = -0.0;
      mesh.fields.push_back({"field " + std::to_string(components), "",
                             static_cast<FieldLocation>(location), components, std::move(values)});
    }
  }
  return mesh;
}

const std::vector<CellKind> kAll{
    CellKind::tetrahedron4, CellKind::tetrahedron10, CellKind::tetrahedron20, CellKind::pyramid5,
    CellKind::pyramid13,    CellKind::pyramid21,     CellKind::prism6,        CellKind::prism15,
    CellKind::prism24,      CellKind::brick8,        CellKind::brick20,       CellKind::brick32,
    CellKind::brick8,       CellKind::wedge7,        CellKind::tetrahedron4,  CellKind::wedge18};

TEST(GmshWriting, EverythingComesBackToTheBit) {
  ZooMesh mesh = mesh_of_kinds(kAll);
  mesh.metadata.emplace_back("time", "0.1");
  const ScratchFolder folder;
  const std::string path = folder.file("all.msh");
  const std::vector<std::string> notes = format_to_write(path).write(path, mesh);
  EXPECT_THAT(notes, testing::Contains(HasSubstr("1 wedge7 cells written as bricks")));
  const ZooMesh back = read_any(path).mesh;
  EXPECT_EQ(content_hash(back), content_hash(mesh));
  EXPECT_THAT(back.metadata, testing::Contains(testing::Pair("time", "0.1")));
}

TEST(GmshWriting, AMeshWithoutTimeStaysWithout) {
  const ZooMesh mesh = mesh_of_kinds({CellKind::brick20, CellKind::prism15});
  const ScratchFolder folder;
  const std::string path = folder.file("m.msh");
  format_to_write(path).write(path, mesh);
  const ZooMesh back = read_any(path).mesh;
  EXPECT_EQ(content_hash(back), content_hash(mesh));
  for (const auto& [key, text] : back.metadata) EXPECT_NE(key, "time");
}

TEST(GmshWriting, WhatTheFormatCannotHoldIsToldOrRefused) {
  const ScratchFolder folder;
  const std::string path = folder.file("m.msh");
  ZooMesh mesh = mesh_of_kinds({CellKind::brick8});
  mesh.metadata.emplace_back("analyst", "N. N.");
  mesh.fields[0].unit = "K";
  const auto notes = format_to_write(path).write(path, mesh);
  EXPECT_THAT(notes, testing::Contains(HasSubstr("analyst")));
  EXPECT_THAT(notes, testing::Contains(HasSubstr("the unit of 'field 1'")));
  mesh.fields[1].name = mesh.fields[0].name;
  EXPECT_THROW(format_to_write(path).write(path, mesh), InputError);
  mesh.fields[1].name = "with \" in it";
  EXPECT_THROW(format_to_write(path).write(path, mesh), InputError);
}

}  // namespace
}  // namespace hiac::formats

// What a deck holds besides its mesh does not keep the mesh from being read.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/formats/files.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::string kGrids =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n";

TEST(LenientDecks, NastranReplicationOfWhatIsNotReadIsPassedOver) {
  const ScratchFolder folder;
  expect_unit_tetrahedron(
      read_any(folder.write("a.bdf", "BEGIN BULK\nSPC1,1,123,1\n=,*1,=,=\n=(2)\n" + kGrids +
                                         "FORCE,1,1,0,1.,0.,0.,1.\n=,=,*1,==\n"
                                         "CTETRA,1,1,1,2,3,4\nENDDATA\n"))
          .mesh);
  for (const char* read : {"GRID,9,,5.,5.,5.\n", "CTETRA,1,1,1,2,3,4\n",
                           "CORD2R,1,,0.,0.,0.,0.,0."
                           "\n,1.,1.,0.,0.\n"})
    EXPECT_THAT(
        refusal(folder.write("b.bdf", "BEGIN BULK\n" + kGrids + read + "=,*1,=,=\nENDDATA\n")),
        HasSubstr("replicated entries"))
        << read;
}

TEST(LenientDecks, AbaqusSetsOfUnknownInstancesAreLeftOut) {
  const ScratchFolder folder;
  const Reading reading = read_any(folder.write(
      "a.inp",
      "*PART,NAME=P\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=E\n"
      "1,1,2,3,4\n*END PART\n*ASSEMBLY,NAME=A\n*INSTANCE,NAME=I,PART=P\n*END INSTANCE\n"
      "*ELSET,ELSET=S,INSTANCE=GONE\n1,2,3\n*ELSET,ELSET=T,INSTANCE=I\n1\n"
      "*NSET,NSET=N,INSTANCE=GONE\n1,2\n*SURFACE,NAME=F\nS,S1\n*END ASSEMBLY\n"));
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, Contains(HasSubstr("instance 'GONE'")));
}

TEST(LenientDecks, MfemPartsOfOneProcessAreItsElements) {
  const ScratchFolder folder;
  const std::string mesh =
      "elements\n2\n0 1 4 0 0 1 2 3\n1 1 4 0 4 1 2 3\n\nboundary\n0\n\ncoordinates\n5\n3\n"
      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n\nmfem_mesh_end\n";
  const std::string title = "MFEM NC mesh v1.0\n\ndimension\n3\n\n";
  EXPECT_EQ(read_any(folder.write("a.mesh", title + mesh)).mesh.cell_count(), 2U);
  expect_unit_tetrahedron(read_any(folder.write("b.mesh", title + "rank\n0\n\n" + mesh)).mesh);
  const ZooMesh other = read_any(folder.write("c.mesh", title + "rank\n1\n\n" + mesh)).mesh;
  ASSERT_EQ(other.cell_count(), 1U);
  EXPECT_EQ(other.position(other.nodes[0])[0] + other.position(other.nodes[1])[0] +
                other.position(other.nodes[2])[0] + other.position(other.nodes[3])[0],
            2);
  EXPECT_THAT(refusal(folder.write("d.mesh", title + "rank\nx\n" + mesh)), HasSubstr("a rank"));
}

TEST(LenientDecks, FrdValuesOfUnknownNodesAreLeftOut) {
  const ScratchFolder folder;
  const auto node = [](int number, double x, double y, double z) {
    return fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", number, x, y, z);
  };
  const auto file = [&](const std::string& values) {
    return "    1C\n    2C                             4                                     1\n" +
           node(1, 0, 0, 0) + node(2, 1, 0, 0) + node(3, 0, 1, 0) + node(4, 0, 0, 1) +
           " -3\n    3C                             1                                     1\n" +
           fmt::format(" -1{:10}{:5}{:5}{:5}\n -2{:10}{:10}{:10}{:10}\n -3\n", 1, 3, 0, 1, 1, 2, 3,
                       4) +
           "    1PSTEP                         1           1           1\n"
           "  100CL  101 1.000000000           6                     0    1           1\n"
           " -4  NDTEMP      1    1\n -5  T           1    1    0    0\n" +
           values + " -3\n 9999\n";
  };
  std::string values;
  for (const int n : {1, 2, 7, 3, 4, 9}) values += fmt::format(" -1{:10}{:12.5E}\n", n, 10.0 * n);
  const Reading reading = read_any(folder.write("a.frd", file(values)));
  expect_unit_tetrahedron(reading.mesh);
  ASSERT_EQ(reading.mesh.fields.size(), 1U);
  for (std::size_t n = 0; n < 4; ++n)
    EXPECT_EQ(reading.mesh.fields[0].values[n], 10.0 * static_cast<double>(n + 1));
  EXPECT_THAT(reading.notes, Contains(HasSubstr("values of 2 nodes that the file does not have, "
                                                "the first of them is node 7")));
}

TEST(LenientDecks, AnsysElementsEndWithTheirLastNode) {
  const ScratchFolder folder;
  // ten places, of which all mid-side nodes but the first, or none but the first, are missing
  const auto deck = [](const std::string& nodes, int count) {
    std::string text = "/PREP7\nET,1,187\nN,1,0,0,0\nN,2,1,0,0\nN,3,0,1,0\nN,4,0,0,1\nN,5,.5,0,0\n";
    text += "EBLOCK,19,SOLID\n(19i9)\n";
    for (const int field : {1, 1, 1, 1, 0, 0, 0, 0, count, 0, 1})
      text += fmt::format("{:9}", field);
    return text + nodes + "\n-1\n";
  };
  const std::string corners = fmt::format("{:9}{:9}{:9}{:9}", 1, 2, 3, 4);
  const auto middles = [](int zeros) {
    std::string text = fmt::format("{:9}", 5);
    for (int i = 0; i < zeros; ++i) text += fmt::format("{:9}", 0);
    return text;
  };
  for (int zeros = 0; zeros < 4; ++zeros) {  // as many as fit into the line
    const ZooMesh mesh =
        read_any(folder.write("a.cdb", deck(corners + middles(zeros), 5 + zeros))).mesh;
    ASSERT_EQ(mesh.cell_count(), 1U) << zeros;
    EXPECT_EQ(mesh.kinds[0], CellKind::tetrahedron10);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(mesh.position(mesh.nodes[4])[c], c == 0 ? 0.5 : 0);  // given
      EXPECT_EQ(mesh.position(mesh.nodes[9])[c], c == 0 ? 0 : 0.5);  // made
    }
  }
}

}  // namespace
}  // namespace hiac::formats

// The dialects of the formats that the real files at hand do not show: binary variants of either
// byte order, includes, instances, coordinate systems, free fields.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

/// Bytes of numbers in one byte order.
class Bytes {
 public:
  explicit Bytes(std::endian order) : swapped_(order != std::endian::native) {}
  template <typename Number>
  Bytes& add(std::initializer_list<Number> numbers) {
    for (const Number number : numbers) {
      char raw[sizeof(Number)];
      std::memcpy(raw, &number, sizeof(Number));
      if (swapped_) std::reverse(std::begin(raw), std::end(raw));
      text_.append(raw, sizeof(Number));
    }
    return *this;
  }
  Bytes& text(const std::string& words) {
    text_ += words;
    return *this;
  }
  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  bool swapped_;
  std::string text_;
};

constexpr std::array kOrders{std::endian::little, std::endian::big};

const std::string kAbaqusPart =
    "*Heading\n*Part, name=P\n*Node\n5,0,0,0\n6,1,0,0\n7,0,1,0\n8,0,0,1\n*Element, type=C3D4\n"
    "3,5,6,7,8\n*Elset, elset=All, generate\n1,9,1\n*End Part\n";

TEST(AbaqusDialects, InstancesArePutInTheirPlaces) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "a.inp", kAbaqusPart +
                   "*Assembly, name=A\n*Instance, name=One, part=P\n*End Instance\n"
                   "*Instance, name=Two, part=P\n10., 0., 0.\n10.,0.,0., 10.,0.,1., 90.\n"
                   "*End Instance\n*Elset, elset=Second, instance=Two\n3\n*End Assembly\n");
  const ZooMesh mesh = read_any(path).mesh;
  ASSERT_EQ(mesh.cell_count(), 2U);
  const auto x = mesh.position(mesh.cell_nodes(1)[1]);
  EXPECT_THAT(x, ElementsAre(DoubleNear(10, 1e-15), DoubleNear(1, 1e-15), 0));
  EXPECT_THAT(read_any(path).mesh.cell_count(), 2U);
  EXPECT_THAT(format_named("abaqus").inspect(path).blocks,
              testing::UnorderedElementsAre("All", "One", "Two", "Second"));
  ReadOptions options;
  options.block = "Second";
  EXPECT_EQ(read_any(path, options).mesh.position(0)[0], 10);
}

TEST(AbaqusDialects, FilesAreIncluded) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("nodes.inc", "5,0,0,0\n6,1,0,0\n7,0,1,0\n8,0,0,1\n"));
  static_cast<void>(folder.write("cells.inc", "*ELEMENT,\nTYPE=C3D4\n3,5,6,\n7,8\n"));
  const std::string path = folder.write(
      "a.inp", "** note\n*NODE, INPUT=nodes.inc\n*INCLUDE, INPUT=cells.inc\n*STEP\n*END STEP\n");
  expect_unit_tetrahedron(read_any(path).mesh);
  const std::string again = folder.write("b.inp", "*NODE\n1,0,0,0\n*INCLUDE, INPUT=b.inp\n");
  EXPECT_THAT(refusal(again), HasSubstr("more than 10 deep"));
  const std::string missing = folder.write("c.inp", "*NODE\n*INCLUDE, INPUT=none.inp\n");
  EXPECT_THAT(refusal(missing), HasSubstr("c.inp:2: in the included file"));
}

TEST(AbaqusDialects, WhatMakesMeshesIsRefused) {
  const ScratchFolder folder;
  EXPECT_THAT(refusal(folder.write("a.inp", "*NODE\n1,0,0,0\n*NMAP\n1,5\n")),
              HasSubstr(":3: *NMAP makes nodes or elements"));
  EXPECT_THAT(refusal(folder.write("b.inp", "*NODE\n1,0,zero,0\n")),
              HasSubstr("b.inp:2: a real number expected"));
  EXPECT_THAT(refusal(folder.write("c.inp",
                                   "*NODE\n1,0,0,0\n*ELEMENT,TYPE=C3D27\n1,1,1,1,1,1,1,1,"
                                   "1,1,1\n")),
              HasSubstr("1 C3D27"));
}

const std::string kNastranGrids =
    "GRID,1,,0.,0.,0.\nGRID           2              1.     0.0     0.0\n"
    "GRID*                  3                             0.0       1.0000000D+0\n*       "
    "             0.0\nGRID,4,7,1.,90.,0.\n";

TEST(NastranDialects, FieldsOfAllThreeFormsAndCoordinateSystems) {
  const ScratchFolder folder;
  // system 7 is cylindrical, its axis -y, its angle from x to z
  const std::string path = folder.write(
      "a.bdf", "SOL 101\nCEND\nBEGIN BULK\n$ comment\n" + kNastranGrids +
                   "CORD2C,7,0,0.,0.,0.,0.,-1.,0.,\n,1.,0.,0.\nCTETRA,9,1,1,2,3,4\nENDDATA\nx");
  const ZooMesh mesh = read_any(path).mesh;
  ASSERT_EQ(mesh.cell_count(), 1U);
  EXPECT_THAT(mesh.position(mesh.nodes[2]), ElementsAre(0, 1, 0));
  EXPECT_THAT(mesh.position(mesh.nodes[3]),
              ElementsAre(DoubleNear(0, 1e-15), DoubleNear(0, 1e-15), DoubleNear(1, 1e-15)));
}

TEST(NastranDialects, MissingSystemsAndBadNumbersAreNamed) {
  const ScratchFolder folder;
  EXPECT_THAT(refusal(folder.write("a.bdf", "BEGIN BULK\n" + kNastranGrids)),
              HasSubstr("there is no coordinate system 7"));
  EXPECT_THAT(refusal(folder.write("b.bdf", "BEGIN BULK\nGRID,1,,x,0.,0.\n")),
              HasSubstr("b.bdf:2: GRID: a real in field 4 expected ('x' found)"));
}

TEST(AnsysDialects, LeftOutNodesAndShellsBesides) {
  const ScratchFolder folder;
  std::string text = "/PREP7\nET,1,187\nET,2,181\nNBLOCK,3\n(3i8,6e16.9)\n";
  const std::array<std::array<double, 3>, 5> points{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}}};
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{:8}{:8}{:8}{:16.9E}{:16.9E}{:16.9E}\n", i + 1, 0, 0, points[i][0],
                        points[i][1], points[i][2]);
  text += "-1\nEBLOCK,19,SOLID\n(19i8)\n";
  const auto add = [&](std::initializer_list<int> fields) {
    for (const int field : fields) text += fmt::format("{:8}", field);
    text += "\n";
  };
  add({1, 1, 1, 1, 0, 0, 0, 0, 10, 0, 77, 1, 2, 3, 4, 5, 0, 0, 0});
  add({0, 0});
  add({1, 2, 1, 1, 0, 0, 0, 0, 4, 0, 78, 1, 2, 3, 4});
  text += "      -1\n";
  const Reading reading = read_any(folder.write("a.cdb", text));
  ASSERT_EQ(reading.mesh.cell_count(), 1U);
  EXPECT_EQ(reading.mesh.kinds[0], CellKind::tetrahedron10);
  EXPECT_THAT(reading.mesh.position(reading.mesh.nodes[9]), ElementsAre(0, 0.5, 0.5));
  EXPECT_THAT(reading.notes, testing::Contains(HasSubstr("1 type181")));
}

TEST(GmshDialects, Version1And40AndBinaryOfBothOrders) {
  const ScratchFolder folder;
  const std::string points = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  expect_unit_tetrahedron(read_any(folder.write("v1.msh", "$NOD\n4\n" + points +
                                                              "$ENDNOD\n$ELM\n1\n9 4 1 1 4 1 2 3 "
                                                              "4\n$ENDELM\n"))
                              .mesh);
  const std::string v40 =
      folder.write("v40.msh",
                   "$MeshFormat\n4 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 6 \"core\"\n"
                   "$EndPhysicalNames\n$Entities\n0 0 0 1\n5 0 0 0 1 1 1 1 6 0\n$EndEntities\n"
                   "$Nodes\n1 4\n5 3 0 4\n" +
                       points + "$EndNodes\n$Elements\n1 1\n5 3 4 1\n1 1 2 3 4\n$EndElements\n");
  expect_unit_tetrahedron(read_any(v40).mesh);
  EXPECT_THAT(format_named("gmsh").inspect(v40).blocks, ElementsAre("core"));
  for (const std::endian order : kOrders) {
    Bytes bytes(order);
    bytes.text("$MeshFormat\n2.2 1 8\n")
        .add<std::int32_t>({1})
        .text("\n$EndMeshFormat\n$Nodes\n4\n");
    bytes.add<std::int32_t>({1}).add<double>({0, 0, 0});
    bytes.add<std::int32_t>({2}).add<double>({1, 0, 0});
    bytes.add<std::int32_t>({3}).add<double>({0, 1, 0});
    bytes.add<std::int32_t>({4}).add<double>({0, 0, 1});
    bytes.text("\n$EndNodes\n$Elements\n1\n").add<std::int32_t>({4, 1, 2, 9, 6, 5, 1, 2, 3, 4});
    bytes.text("\n$EndElements\n$ElementData\n1\n\"p\"\n0\n3\n0\n1\n1\n");
    bytes.add<std::int32_t>({9}).add<double>({2.5}).text("\n$EndElementData\n");
    const ZooMesh mesh = read_any(folder.write("v22.msh", bytes.str())).mesh;
    expect_unit_tetrahedron(mesh);
    EXPECT_EQ(mesh.fields.at(0).values[0], 2.5);
  }
}

/// A tetrahedron and a triangle as Gmsh's GModelIO_MSH3.cpp writes them: entities with what bounds
/// them, nodes with the parameters of their entities, elements with nodes and partitions.
std::string msh3(const std::string& nodes, const std::string& tetrahedron) {
  return "$MeshFormat\n3 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 7 \"skin\"\n3 6 \"core\"\n"
         "$EndPhysicalNames\n$Entities\n1 2 1 2\n1 0 \n1 2 1 1 0 \n2 0 0 \n1 2 1 -2 1 7 \n"
         "1 1 1 0 \n5 0 2 6 8 \n$EndEntities\n$Nodes\n4\n" +
         nodes + "$EndNodes\n$Elements\n2\n" + tetrahedron +
         "\n2 2 1 3 1 2 3\n$EndElements\n$NodeData\n1\n\"p\"\n1\n0.5\n3\n0\n1\n1\n3 2.5\n"
         "$EndNodeData\n";
}

TEST(GmshDialects, Version3) {
  const ScratchFolder folder;
  const std::string nodes =
      "1 0 0 0 1 0 \n2 1 0 0 1 1 0.5\n3 0 1 0 1 2 0.1 0.2\n4 0 0 1 5 3 0 0 1\n";
  const std::string bare = "1 0 0 0 0\n2 1 0 0 0\n3 0 1 0 0\n4 0 0 1 0\n";
  for (const std::string& text :
       {msh3(nodes, "1 4 5 4 1 2 3 4"), msh3(bare, "1 4 5 6 1 2 3 4 1 2")}) {
    const std::string path = folder.write("a.msh", text);
    const ZooMesh mesh = read_any(path).mesh;
    expect_unit_tetrahedron(mesh);
    EXPECT_EQ(mesh.fields.at(0).values[2], 2.5);
    EXPECT_THAT(format_named("gmsh").inspect(path).blocks,
                testing::UnorderedElementsAre("core", testing::_));
  }
  EXPECT_THAT(refusal(folder.write("b.msh", msh3(bare, "1 4 5 3 1 2 3"))),
              HasSubstr("b.msh:27: a Tetrahedron 4 has 4 nodes (3 found)"));
  EXPECT_THAT(refusal(folder.write("c.msh", msh3("1 0 0 0 1 4 \n" + bare, "1 4 5 4 1 2 3 4"))),
              HasSubstr("an entity's dimension: impossible (0 to 3 expected, 4 found)"));
  EXPECT_THAT(refusal(folder.write("d.msh", msh3(bare, "1 4 5 99999 1 2 3 4"))),
              HasSubstr("a number of data: impossible"));
  EXPECT_THAT(refusal(folder.write("e.msh", "$MeshFormat\n3.5 0 8\n")),
              HasSubstr("version 3.5 of the format is not known"));
}

TEST(GmshDialects, Version3Binary) {
  const ScratchFolder folder;
  for (const std::endian order : kOrders) {
    Bytes bytes(order);
    bytes.text("$MeshFormat\n3 1 8\n").add<std::int32_t>({1}).text("\n$EndMeshFormat\n");
    bytes.text("$Entities\n0 0 0 1\n5 0 1 6 \n$EndEntities\n$Nodes\n4\n");
    bytes.add<std::int32_t>({1}).add<double>({0, 0, 0}).add<std::int32_t>({0});
    bytes.add<std::int32_t>({2}).add<double>({1, 0, 0}).add<std::int32_t>({7, 1});
    bytes.add<double>({0.5});
    bytes.add<std::int32_t>({3}).add<double>({0, 1, 0}).add<std::int32_t>({7, 0});
    bytes.add<std::int32_t>({4}).add<double>({0, 0, 1}).add<std::int32_t>({5, 3});
    bytes.add<double>({0, 0, 1}).text("\n$EndNodes\n$Elements\n1\n");
    bytes.add<std::int32_t>({9, 4, 5, 6, 1, 2, 3, 4, 1, 3}).text("\n$EndElements\n");
    const std::string path = folder.write("a.msh", bytes.str());
    expect_unit_tetrahedron(read_any(path).mesh);
    EXPECT_EQ(format_named("gmsh").inspect(path).blocks.size(), 1U);
  }
}

TEST(FrdDialects, BinaryBlocks) {
  const ScratchFolder folder;
  const auto head = [](const char* key, int count, int encoding) {
    return fmt::format("    {}{:18}{:12}{:37}{}\n", key, "", count, "", encoding);
  };
  Bytes bytes(std::endian::little);
  bytes.text("    1C\n    1UPGM test\n" + head("2C", 4, 3));
  bytes.add<std::int32_t>({1}).add<double>({0, 0, 0});
  bytes.add<std::int32_t>({2}).add<double>({1, 0, 0});
  bytes.add<std::int32_t>({3}).add<double>({0, 1, 0});
  bytes.add<std::int32_t>({4}).add<double>({0, 0, 1});
  bytes.text(head("3C", 1, 2)).add<std::int32_t>({1, 3, 0, 1, 1, 2, 3, 4});
  bytes.text(fmt::format("  100CL  101{:12.5E}{:12}{:20} 0{:5}{:10} 2\n", 0.5, 1, "", 1, ""));
  bytes.text(" -4  T           1    1\n -5  T           1    1    0    0\n");
  bytes.add<std::int32_t>({3}).add<float>({1.25F}).text(" 9999\n");
  const ZooMesh mesh = read_any(folder.write("a.frd", bytes.str())).mesh;
  expect_unit_tetrahedron(mesh);
  EXPECT_TRUE(std::isnan(mesh.fields.at(0).values[0]));
  EXPECT_EQ(mesh.fields[0].values[2], 1.25);
}

TEST(UcdDialects, BinaryOfBothOrders) {
  const ScratchFolder folder;
  for (const std::endian order : kOrders) {
    Bytes bytes(order);
    bytes.text("\7").add<std::int32_t>({4, 1, 1, 0, 0, 4}).add<std::int32_t>({1, 8, 4, 4});
    bytes.add<std::int32_t>({1, 2, 3, 4});
    bytes.add<float>({0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    std::string labels = "T.";
    std::string units = "K.";
    labels.resize(1024);
    units.resize(1024);
    bytes.text(labels).text(units).add<std::int32_t>({1, 1}).add<float>({1, 4, 1, 2, 3, 4});
    bytes.add<std::int32_t>({1});
    const Reading reading = read_any(folder.write("a.inp", bytes.str()));
    expect_unit_tetrahedron(reading.mesh);
    EXPECT_THAT(reading.notes, testing::Contains(HasSubstr("mirror image")));
    const Field field = scalar_field(reading.mesh, "T");
    EXPECT_EQ(field.unit, "K");
    EXPECT_THAT(field.values.view(), ElementsAre(1, 2, 3, 4));
  }
}

TEST(MeditDialects, BinaryVersionsOfBothOrders) {
  const ScratchFolder folder;
  for (const std::endian order : kOrders) {
    for (const std::int32_t version : {1, 2, 3, 4}) {
      Bytes bytes(order);
      const auto position = [&](std::size_t at) {
        if (version >= 3)
          bytes.add<std::int64_t>({static_cast<std::int64_t>(at)});
        else
          bytes.add<std::int32_t>({static_cast<std::int32_t>(at)});
      };
      const auto integers = [&](std::initializer_list<std::int32_t> numbers) {
        for (const std::int32_t number : numbers)
          version >= 4 ? bytes.add<std::int64_t>({number}) : bytes.add<std::int32_t>({number});
      };
      const std::size_t place = version >= 3 ? 8 : 4;
      const std::size_t integer = version >= 4 ? 8 : 4;
      const std::size_t real = version == 1 ? 4 : 8;
      bytes.add<std::int32_t>({1, version, 3});
      std::size_t next = 8 + 4 + place + 4;
      position(next);
      bytes.add<std::int32_t>({3, 4});
      next += 4 + place + integer + 4 * (3 * real + integer);
      position(next);
      integers({4});
      for (const auto& point :
           std::vector<std::array<double, 3>>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
        for (const double x : point)
          version == 1 ? bytes.add<float>({static_cast<float>(x)}) : bytes.add<double>({x});
        integers({6});
      }
      bytes.add<std::int32_t>({8});
      next += 4 + place + 6 * integer;
      position(next);
      integers({1, 1, 2, 3, 4, 12});
      bytes.add<std::int32_t>({54});
      position(0);
      const ZooMesh mesh = read_any(folder.write("a.meshb", bytes.str())).mesh;
      expect_unit_tetrahedron(mesh);
      EXPECT_EQ(scalar_field(mesh, "ref@cell").values[0], 12);
    }
  }
}

TEST(UgridDialects, AllBinaryVariants) {
  const ScratchFolder folder;
  for (const std::string variant : {"b8", "lb8", "b4", "lb4", "r8", "lr8", "r4", "lr4"}) {
    const bool little = variant.front() == 'l';
    const bool marked = variant.find('r') != std::string::npos;
    Bytes bytes(little ? std::endian::little : std::endian::big);
    if (marked) bytes.add<std::int32_t>({28});
    bytes.add<std::int32_t>({4, 1, 0, 1, 0, 0, 0});
    const int real = variant.back() - '0';
    const std::int32_t rest = 12 * real + 4 * 8;
    if (marked) bytes.add<std::int32_t>({28, rest});
    for (const int x : {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})
      real == 8 ? bytes.add<double>({static_cast<double>(x)})
                : bytes.add<float>({static_cast<float>(x)});
    bytes.add<std::int32_t>({1, 2, 3, 7, 1, 2, 3, 4});
    if (marked) bytes.add<std::int32_t>({rest});
    for (const std::string& name : {"a." + variant + ".ugrid", std::string("a.ugrid")})
      expect_unit_tetrahedron(read_any(folder.write(name, bytes.str())).mesh);
  }
}

/// Two tetrahedra over one face, and a polygon, as the Data Format Guide has faces: how many nodes
/// each has, which, the elements to the left and right.
std::string polyhedral_zones(const std::string& left) {
  return "VARIABLES = X, Y, Z, c\n"
         "ZONE T=\"p\", ZONETYPE=FEPOLYHEDRON, NODES=5, ELEMENTS=2, FACES=7, TotalNumFaceNodes=21, "
         "NumConnectedBoundaryFaces=1, TotalNumBoundaryConnections=1, DATAPACKING=BLOCK, "
         "VARLOCATION=([4]=CELLCENTERED)\n"
         "0 1 0 0 1\n0 0 1 0 1\n0 0 0 1 1\n7 8\n"
         "3 3 3 3 3 3 3\n# nodes\n1 3 2 1 2 4 2 3 4 1 4 3 2 3 5 3 4 5 2 5 4\n" +
         left +
         "\n0 0 2 0 0 -1 0\n1\n1\n2\n"
         "ZONE T=\"flat\", ZONETYPE=FEPOLYGON, NODES=3, ELEMENTS=1, FACES=3, TotalNumFaceNodes=6, "
         "DATAPACKING=BLOCK, VARLOCATION=([4]=CELLCENTERED)\n"
         "0 1 0\n0 0 1\n0 0 0\n9\n1 2 2 3 3 1\n1 1 1\n0 0 0\n";
}

TEST(TecplotDialects, PolyhedraAreToldByTheirFaces) {
  const ScratchFolder folder;
  const Reading reading = read_any(folder.write("p.dat", polyhedral_zones("1 1 1 1 2 2 2")));
  ASSERT_EQ(reading.mesh.cell_count(), 2U);
  EXPECT_EQ(reading.mesh.kinds[1], CellKind::tetrahedron4);
  EXPECT_NEAR(volume_of(reading.mesh, 0), 1.0 / 6, 1e-12);
  EXPECT_NEAR(std::abs(volume_of(reading.mesh, 1)), 1.0 / 3, 1e-12);
  EXPECT_THAT(reading.mesh.fields.at(0).values.view(), testing::ElementsAre(7, 8));
  EXPECT_THAT(reading.notes, testing::Contains(HasSubstr("without volume: 1 POLYGON")));
  EXPECT_THAT(refusal(folder.write("q.dat", polyhedral_zones("1 1 1 1 2 2 3"))),
              HasSubstr("no element 3 beside a face"));
}

TEST(TecplotDialects, OrderedBlocksWithCellDataSharedVariablesAndTimes) {
  const ScratchFolder folder;
  const std::string path =
      folder.write("a.dat",
                   "# comment\nTITLE=\"t\"\nVARIABLES = X Y \"Z\" p\nZONE T=\"one\" I=2, J=2, K=2 "
                   "DATAPACKING=BLOCK VARLOCATION=([4]=CELLCENTERED) SOLUTIONTIME=1.5\n"
                   "0 1 0 1 0 1 0 1\n2*0 2*1 2*0 2*1\n4*0, 4*1\n7.5\n"
                   "ZONE T=\"two\" I=2, J=2, K=2 DATAPACKING=BLOCK VARLOCATION=([4]=CELLCENTERED) "
                   "SOLUTIONTIME=2 VARSHARELIST=([1-3]=1)\n9.5\n");
  const ZooMesh last = read_any(path).mesh;
  ASSERT_EQ(last.cell_count(), 1U);
  EXPECT_EQ(last.kinds[0], CellKind::brick8);
  EXPECT_THAT(last.position(last.nodes[6]), ElementsAre(1, 1, 1));
  EXPECT_EQ(last.fields.at(0).values[0], 9.5);
  ReadOptions options;
  options.time = 1.5;
  EXPECT_EQ(read_any(path, options).mesh.fields.at(0).values[0], 7.5);
}

// ten nodes as `tetgen -o2` writes them (its library, TetGen 1.5)
TEST(TetgenDialects, TenNodesComeInTetgensOrder) {
  const ScratchFolder folder;
  const std::string ele = folder.write("a.ele", "# 10 nodes\n1 10 0\n0 0 1 2 3 4 5 6 7 8 9\n");
  static_cast<void>(
      folder.write("a.node",
                   "10 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0 .5 .5\n5 0 0 .5\n"
                   "6 .5 0 0\n7 .5 .5 0\n8 .5 0 .5\n9 0 .5 0\n"));
  const ZooMesh mesh = read_any(ele).mesh;
  EXPECT_EQ(mesh.kinds[0], CellKind::tetrahedron10);
  EXPECT_THAT(refusal(folder.write("b.ele", "1 4 0\n1 1 2 3 4\n")), HasSubstr("b.node"));
}

}  // namespace
}  // namespace hiac::formats

// What ASCII files of Tecplot are refused for, with the line, and what is just allowed; what zones
// share, repeat and leave out.
#include <cmath>

#include <fmt/format.h>

#include "formats/tecplot/tecplot_tokens.hpp"
#include "tests/formats/complaints.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kTecNames = "VARIABLES = X Y Z P\n";
const std::string kTecBlock = "ZONE T=\"a\" N=4 E=1 DATAPACKING=BLOCK ZONETYPE=FETETRAHEDRON";
const std::string kTecPlaces = "0 1 0 0\n0 0 1 0\n0 0 0 1\n";
const std::string kTecZone = kTecBlock + "\n" + kTecPlaces + "5 6 7 8\n1 2 3 4\n";

TEST(TecplotComplaints, FilesHaveVariablesAndZones) {
  expect_complaints(
      "a.dat",
      {{kTecNames + kTecZone, ""},
       {"VARIABLES = X Y Z\n" + kTecBlock + "\n" + kTecPlaces + "1 2 3 4\n", ""},
       {"VARIABLES = X Y\n" + kTecBlock + "\n0 1 0 0\n0 0 1 0\n1 2 3 4\n",
        ": three coordinates expected among the variables (2 variables found)"},
       {kTecNames, ":2: no ZONE found"},
       {kTecNames + "\n# c\n", ":4: no ZONE found"},
       {kTecNames + kTecZone + "FOO = 1\n", ":8: TITLE, VARIABLES or ZONE expected ('FOO' found)"},
       {"TITLE = \"a\nVARIABLES = X Y Z\n", ":1: a text without its end"},
       {"VARIABLES = \"X\"\n\"Y", ":2: a text without its end"},
       {"VARIABLES = \"X\"\n'Y\"\n", ":2: a text without its end"},
       {kTecNames + kTecBlock + "\nVARLOCATION=([4]=CELLCENTERED\n0 1 2\n",
        ":3: a list without its end"},
       {kTecNames + kTecBlock + "\nVARLOCATION=(([4])=CELLCENTERED\n",
        ":3: a list without its end"}});
}

TEST(TecplotComplaints, HeadsOfZonesAreNamesWithValues) {
  const auto zone = [](const std::string& head) {
    return kTecNames + "ZONE " + head + "\n" + kTecPlaces + "5 6 7 8\n1 2 3 4\n";
  };
  const std::string ok = "N=4 E=1 F=FEBLOCK ET=TETRAHEDRON";
  expect_complaints(
      "a.dat",
      {{zone(ok), ""},
       {zone("NODES=4, ELEMENTS=1, DATAPACKING=BLOCK, ZONETYPE=FETETRAHEDRON"), ""},
       {zone(ok + " AUXDATA a=\"1\" b"), ""},
       {zone(ok + " EQUAL"), ":2: NAME=VALUE of a zone or numbers expected ('EQUAL' found)"},
       {kTecNames + "ZONE\nN =", ":3: a value expected (the file ends)"},
       {zone("N=x E=1 F=FEBLOCK ET=TETRAHEDRON"), ":2: a count expected ('x' found)"},
       {zone("N=-1 E=1 F=FEBLOCK ET=TETRAHEDRON"), ":2: a count expected ('-1' found)"},
       {zone("N=9999 E=1 F=FEBLOCK ET=TETRAHEDRON"), ":2: a count expected ('9999' found)"},
       {zone("N=4 E=1 F=FELINES ET=TETRAHEDRON"),
        ":2: POINT or BLOCK packing expected ('LINES' found)"},
       {zone("N=4 E=1 DATAPACKING=LIST ET=TETRAHEDRON"),
        ":2: POINT or BLOCK packing expected ('LIST' found)"},
       {zone("N=4 E=1 F=FEBLOCK ET=PYRAMID"),
        ":2: element type 'PYRAMID' is not supported (BRICK, TETRAHEDRON, QUADRILATERAL, TRIANGLE, "
        "LINESEG, POLYGON or POLYHEDRON expected)"},
       {zone("I=0 J=2 K=2"), ":2: a zone's size is impossible or more than the file can hold"},
       {zone("I=9 J=9 K=9"), ":2: a zone's size is impossible or more than the file can hold"},
       {zone("N=4 E=99 F=FEBLOCK ET=TETRAHEDRON"),
        ":2: more elements announced than the file can hold"},
       {zone("N=4 E=2 F=FEBLOCK ET=TETRAHEDRON"),
        ":8: the file ends too early (a node number expected)"}});
}

TEST(TecplotComplaints, CellCentredVariablesNeedBlocks) {
  const auto zone = [](const std::string& locations) {
    return kTecNames + kTecBlock + " VARLOCATION=" + locations + "\n";
  };
  const std::string tail = "1 2 3 4\n";
  expect_complaints(
      "a.dat",
      {{zone("([4]=CELLCENTERED)") + kTecPlaces + "9\n" + tail, ""},
       {zone("([4]=cellcentered, [1-3]=NODAL)") + kTecPlaces + "9\n" + tail, ""},
       {zone("(NODAL, NODAL, NODAL, CELLCENTERED)") + kTecPlaces + "9\n" + tail, ""},
       {zone("([3]=CELLCENTERED)") + "0 1 0 0\n0 0 1 0\n5\n5 6 7 8\n" + tail,
        ": zone 'a': a coordinate is cell-centred"},
       {zone("(CELLCENTERED)") + "5\n0 0 1 0\n0 0 1 0\n5 6 7 8\n" + tail,
        ": zone 'a': a coordinate is cell-centred"},
       {kTecNames +
            "ZONE N=4 E=1 F=FEPOINT ET=TETRAHEDRON VARLOCATION=([4]=CELLCENTERED)\n0 0 0 1\n"
            "1 0 0 2\n0 1 0 3\n0 0 1 4\n" +
            tail,
        ":6: cell-centred variables need BLOCK packing"}});
  const ScratchFolder folder;
  const ZooMesh mesh =
      read_any(folder.write("a.dat", zone("([9,4]=CELLCENTERED)") + kTecPlaces + "9\n" + tail))
          .mesh;
  EXPECT_EQ(mesh.fields.at(0).location, FieldLocation::cell);
  EXPECT_THAT(mesh.fields[0].values.view(), ElementsAre(9));
}

TEST(TecplotComplaints, ValuesAreRepeatedOnceOrMore) {
  const auto values = [](const std::string& p) {
    return kTecNames + kTecBlock + "\n" + kTecPlaces + p + "\n1 2 3 4\n";
  };
  expect_complaints("a.dat",
                    {{values("1*5 3*6.5"), ""},
                     {values("4*5"), ""},
                     {values("3*5,7"), ""},
                     {values("5 6\n# c\n2*7"), ""},
                     {values("0*5 4*6"), ":6: a repeated value N*VALUE expected"},
                     {values("5 -1*6"), ":6: a repeated value N*VALUE expected"},
                     {values("5 6\nx*6"), ":7: a repeated value N*VALUE expected"},
                     {values("*6"), ":6: a repeated value N*VALUE expected"},
                     {values("2*x"), ":6: not understood (a value expected, 'x' found)"},
                     {values("5,x,7"), ":6: not understood (a value expected, 'x,7' found)"}});
  const ScratchFolder folder;
  const auto read = [&](const std::string& p) {
    const ZooMesh mesh = read_any(folder.write("b.dat", values(p))).mesh;
    return std::vector<double>(mesh.fields.at(0).values.begin(), mesh.fields[0].values.end());
  };
  EXPECT_THAT(read("1*5 3*6.5"), ElementsAre(5, 6.5, 6.5, 6.5));
  EXPECT_THAT(read("2*5,2*-7"), ElementsAre(5, 5, -7, -7));
  EXPECT_THAT(read("1,2,\n3,4"), ElementsAre(1, 2, 3, 4));
  // what a repetition is too long for is no value of the next list
  EXPECT_THAT(read("1 9*2"), ElementsAre(1, 2, 2, 2));
}

TEST(TecplotZones, ShareVariablesAndElements) {
  const std::string share = "ZONE T=\"b\" N=4 E=1 DATAPACKING=BLOCK ZONETYPE=FETETRAHEDRON ";
  const ScratchFolder folder;
  const ZooMesh mesh =
      read_any(folder.write("a.dat", kTecNames + kTecZone + share +
                                         "VARSHARELIST=([1,2]=1,[3]=1) CONNECTIVITYSHAREZONE=1\n"
                                         "11 12 13 14\n" +
                                         share +
                                         "PASSIVEVARLIST=([4,9]) VARSHARELIST=([1-3]) "
                                         "CONNECTIVITYSHAREZONE=2\n"))
          .mesh;
  ASSERT_EQ(mesh.cell_count(), 3U);
  const auto values = mesh.fields.at(0).values.view();
  EXPECT_THAT(values.subspan(0, 8), ElementsAre(5, 6, 7, 8, 11, 12, 13, 14));
  for (std::size_t i = 8; i < 12; ++i) EXPECT_TRUE(std::isnan(values[i]));
  EXPECT_THAT(mesh.position(mesh.cell_nodes(2)[3]), ElementsAre(0, 0, 1));
  expect_complaints(
      "b.dat",
      {{kTecNames + kTecZone + share + "VARSHARELIST=([1-4]=2) CONNECTIVITYSHAREZONE=1\n",
        ":8: VARSHARELIST: there is no such variable, or it has another size"},
       {kTecNames + kTecZone + share + "VARSHARELIST=([1-5]=1) CONNECTIVITYSHAREZONE=1\n",
        ":8: VARSHARELIST: there is no such variable, or it has another size"},
       {kTecNames + kTecZone +
            "ZONE N=5 E=1 DATAPACKING=BLOCK ZONETYPE=FETETRAHEDRON VARSHARELIST=([1]=1)\n",
        ":8: VARSHARELIST: there is no such variable, or it has another size"},
       {kTecNames + kTecZone + share + "CONNECTIVITYSHAREZONE=2\n" + kTecPlaces + "1 2 3 4\n",
        ":8: the zone whose elements it shares is not there, or has other elements"},
       {kTecNames + kTecZone + share + "CONNECTIVITYSHAREZONE=(x)\n" + kTecPlaces + "1 2 3 4\n",
        ":8: the zone whose elements it shares is not there, or has other elements"},
       {kTecNames + kTecZone + "ZONE N=4 E=2 F=FEBLOCK ET=TETRAHEDRON CONNECTIVITYSHAREZONE=1\n" +
            kTecPlaces + "1 2 3 4\n",
        ":8: the zone whose elements it shares is not there, or has other elements"},
       {kTecNames + kTecZone + "ZONE N=4 E=1 F=FEBLOCK ET=QUADRILATERAL CONNECTIVITYSHAREZONE=1\n" +
            kTecPlaces + "1 2 3 4\n",
        ":8: the zone whose elements it shares is not there, or has other elements"},
       {kTecNames + kTecZone + "ZONE N=4 E=1 F=FEBLOCK ET=TETRAHEDRON D=(1,2,3,5)\n5 6 7 8\n",
        ":8: D=: there is no zone before, or it has another size"},
       {kTecNames + "ZONE N=4 E=1 F=FEBLOCK ET=TETRAHEDRON D=(FECONNECT)\n" + kTecPlaces +
            "5 6 7 8\n",
        ":2: the zone whose elements it shares is not there, or has other elements"}});
}

// A variable that is on nodes in one zone and on cells in another makes two fields with gaps.
TEST(TecplotZones, MayDifferInTheLocationsOfVariables) {
  const ScratchFolder folder;
  const ZooMesh mesh = read_any(folder.write("a.dat", kTecNames + kTecZone + kTecBlock +
                                                          " VARLOCATION=([4]=CELLCENTERED)\n" +
                                                          kTecPlaces + "9\n1 2 3 4\n"))
                           .mesh;
  ASSERT_EQ(mesh.fields.size(), 2U);
  EXPECT_EQ(mesh.fields[0].location, FieldLocation::node);
  const auto nodes = mesh.fields[0].values.view();
  EXPECT_THAT(nodes.first(4), ElementsAre(5, 6, 7, 8));
  for (std::size_t n = 4; n < 8; ++n) EXPECT_TRUE(std::isnan(nodes[n]));
  EXPECT_EQ(mesh.fields[1].location, FieldLocation::cell);
  EXPECT_TRUE(std::isnan(mesh.fields[1].values[0]));
  EXPECT_EQ(mesh.fields[1].values[1], 9);
}

TEST(TecplotZones, OfATimeAreReadWithThoseOfNone) {
  const ScratchFolder folder;
  const auto zone = [](const std::string& name, const std::string& time) {
    return "ZONE T=\"" + name + "\" N=4 E=1 F=FEBLOCK ET=TETRAHEDRON " + time + "\n" + kTecPlaces +
           "5 6 7 8\n1 2 3 4\n";
  };
  const std::string path =
      folder.write("a.dat", kTecNames + zone("late", "SOLUTIONTIME=2") + zone("always", "") +
                                zone("early", "SOLUTIONTIME=1") + zone("other", "SOLUTIONTIME=2"));
  EXPECT_THAT(format_named("tecplot").inspect(path).times, ElementsAre(1, 2));
  EXPECT_EQ(read_any(path).mesh.cell_count(), 3U);
  EXPECT_THAT(format_named("tecplot").inspect(path).blocks, ElementsAre("late", "always", "other"));
  ReadOptions options;
  options.time = 1;
  EXPECT_EQ(read_any(path, options).mesh.cell_count(), 2U);
}

TEST(TecplotZones, OtherRecordsAreLeftOutAndTitlesKept) {
  const ScratchFolder folder;
  const Reading reading = read_any(folder.write(
      "a.dat", "TITLE = 'the title'\nFILETYPE = FULL\n" + kTecNames +
                   "DATASETAUXDATA a=\"1\"\nTEXT X=5 Y=4\nT=\"no zone\"\nGEOMETRY X=0\n1 2\n" +
                   kTecZone + "VARAUXDATA 1 a=\"b\"\nCUSTOMLABELS \"inlet\"\n\"out\"\n"));
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, ElementsAre("left out a record TEXT", "left out a record GEOMETRY",
                                         "left out a record CUSTOMLABELS"));
  EXPECT_THAT(reading.mesh.metadata, Contains(testing::Pair("title", "the title")));
  EXPECT_THAT(field_named(reading.mesh, "P").values.view(), ElementsAre(5, 6, 7, 8));
}

TEST(TecplotZones, OrderedOnesOfNoThicknessHaveNoVolume) {
  const ScratchFolder folder;
  const auto ordered = [&](const std::string& sizes) {
    return folder.write("a.dat", kTecNames + kTecZone + "ZONE " + sizes +
                                     " F=POINT\n0 0 0 1\n"
                                     "1 0 0 2\n0 1 0 3\n"
                                     "1 1 0 4\n2 0 0 5\n"
                                     "2 1 0 6\n");
  };
  for (const auto& [sizes, cells] : std::vector<std::pair<std::string, int>>{
           {"I=6", 5}, {"I=3 J=2", 2}, {"IMAX=1, JMAX=2, KMAX=3", 2}, {"J=6", 5}, {"K=6", 5}}) {
    const Reading reading = read_any(ordered(sizes));
    EXPECT_EQ(reading.mesh.cell_count(), 1U) << sizes;
    EXPECT_THAT(
        reading.notes,
        Contains(fmt::format("dropped cells without volume: {} ordered surface or line", cells)))
        << sizes;
  }
  // two by three by two points: i fastest
  std::string points;
  for (int n = 0; n < 12; ++n) points += fmt::format("{} {} {} {}\n", n % 2, n / 2 % 3, n / 6, n);
  const ZooMesh mesh =
      read_any(folder.write("b.dat", kTecNames + "ZONE I=2 J=3 K=2\n" + points)).mesh;
  ASSERT_EQ(mesh.cell_count(), 2U);
  EXPECT_THAT(mesh.position(mesh.cell_nodes(1)[0]), ElementsAre(0, 1, 0));
  EXPECT_THAT(mesh.position(mesh.cell_nodes(1)[6]), ElementsAre(1, 2, 1));
}

TEST(TecplotZones, CoordinatesAreFoundByNameOrComeFirst) {
  const std::string data = "9 8 7 6\n" + kTecPlaces + "1 2 3 4\n";
  const ScratchFolder folder;
  for (const std::string names : {"P, x, y, z", "P CoordinateX CoordinateY CoordinateZ"}) {
    const ZooMesh mesh =
        read_any(folder.write("a.dat", "VARIABLES = " + names + "\n" + kTecBlock + "\n" + data))
            .mesh;
    expect_unit_tetrahedron(mesh);
    ASSERT_EQ(mesh.fields.size(), 1U);
    EXPECT_EQ(mesh.fields[0].name, "P");
    EXPECT_THAT(mesh.fields[0].values.view(), ElementsAre(9, 8, 7, 6));
  }
  const ZooMesh first = read_any(folder.write("b.dat", "VARIABLES = X Y h T\n" + kTecBlock + "\n" +
                                                           kTecPlaces + "9 8 7 6\n1 2 3 4\n"))
                            .mesh;
  expect_unit_tetrahedron(first);
  EXPECT_EQ(first.fields.at(0).name, "T");
}

TEST(TecplotComplaints, FacesHaveNodesAndElements) {
  const auto zone = [](const std::string& faces) {
    return "VARIABLES = X Y Z\nZONE ZONETYPE=FEPOLYHEDRON NODES=4 ELEMENTS=1 FACES=4 "
           "DATAPACKING=BLOCK\n" +
           kTecPlaces + faces;
  };
  const std::string nodes = "1 3 2 1 2 4 2 3 4 1 4 3\n";
  expect_complaints(
      "a.dat",
      {{zone("3 3 3 3\n" + nodes + "1 1 1 1\n0 0 0 0\n"), ""},
       {zone("3 3 3 3\n" + nodes + "1 1 1 1\n0 0 -1 0\n"), ""},
       {zone("3 3 3 3\n" + nodes + "1 1 1 1\n0 0 0 2\n"),
        ":9: there is no element 2 beside a face (1 to 1 expected)"},
       {zone("3 3 3 -3\n" + nodes), ":6: a face's number of nodes expected (-3 found)"},
       {zone("3 3 3 999999\n" + nodes), ":6: a face's number of nodes expected (999999 found)"},
       {zone("3 3 3 3\n1 3 2 1 2 4 2 3 4 1 4 5\n1 1 1 1\n0 0 0 0\n"),
        ": zone '': there is no node 5 (1 to 4 expected)"},
       {zone("3 3 3 3\n1 3 2 1 2 4 2 3 4 1 4 0\n1 1 1 1\n0 0 0 0\n"),
        ": zone '': there is no node 0 (1 to 4 expected)"}});
}

TEST(TecplotTokens, ListsOfNumbers) {
  const auto list = tecplot::number_list;
  EXPECT_THAT(list("[1-3,5]"), ElementsAre(0, 1, 2, 4));
  EXPECT_THAT(list("(2)"), ElementsAre(1));
  EXPECT_THAT(list("4 - 6"), ElementsAre(3, 5));
  EXPECT_THAT(list("4-6"), ElementsAre(3, 4, 5));
  EXPECT_THAT(list("3-3"), ElementsAre(2, 2));
  EXPECT_THAT(list("5-2"), ElementsAre(4, 1));
  EXPECT_THAT(list("-3"), ElementsAre(2));
  EXPECT_THAT(list("1,0,12"), ElementsAre(0, 11));
  EXPECT_THAT(list("=FECONNECT)"), IsEmpty());
  EXPECT_THAT(list("65536"), ElementsAre(65535));
  EXPECT_THAT(list("65537"), IsEmpty());
  EXPECT_EQ(list("1-65536").size(), 65536U);
}

}  // namespace
}  // namespace hiac::formats

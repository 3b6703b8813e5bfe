#include <cmath>

#include <fmt/format.h>

#include "formats/common/pieces/piece_field.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// A piece of one brick at x0, with whatever else belongs into it.
std::string brick_piece(double x0, const std::string& point_data = "",
                        const std::string& cell_data = "") {
  std::string points;
  for (const char* p : {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"}) {
    const std::string text(p);
    points += fmt::format("{} {} ", x0 + std::stod(text.substr(0, 1)), text.substr(2));
  }
  return fmt::format(
      "<Piece NumberOfPoints=\"8\" NumberOfCells=\"1\"><Points>"
      "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">{}"
      "</DataArray></Points><Cells>"
      "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 4 5 6 7</DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">8</DataArray>"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">12</DataArray></Cells>"
      "<PointData>{}</PointData><CellData>{}</CellData></Piece>",
      points, point_data, cell_data);
}

std::string vtu(const std::string& pieces, const std::string& attributes = "") {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" {}>"
      "<UnstructuredGrid>\n{}\n</UnstructuredGrid></VTKFile>\n",
      attributes, pieces);
}

std::string array(const std::string& name, const std::string& values,
                  const std::string& type = "Float64", int components = 1) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">{}"
      "</DataArray>",
      type, name, components, values);
}

TEST(VtkXml, PiecesOfOneFileBecomeOneMesh) {
  const ScratchFolder folder;
  const std::string path =
      folder.write("two.vtu", vtu(brick_piece(0, array("x", "0 1 1 0 0 1 1 0"), array("c", "3")) +
                                  brick_piece(1, array("x", "1 2 2 1 1 2 2 1"), array("c", "4"))));
  const Reading reading = read_any(path);
  EXPECT_EQ(reading.mesh.node_count(), 12U);
  EXPECT_EQ(reading.mesh.fields[1].values[1], 4);
  const FaceAdjacency adjacency = build_face_adjacency(reading.mesh);
  EXPECT_EQ(std::count(adjacency.neighbors.begin(), adjacency.neighbors.end(), kNoCell), 10);
  EXPECT_THAT(reading.notes, Contains(HasSubstr("4 nodes")));
}

TEST(VtkXml, ParallelFilesAreReadThroughTheirPieces) {
  const ScratchFolder folder;
  EXPECT_EQ(refusal(folder.write("p0.vtu", vtu(brick_piece(0)))), "");
  EXPECT_EQ(refusal(folder.write("p1.vtu", vtu(brick_piece(1)))), "");
  const std::string master =
      "<?xml version=\"1.0\"?><VTKFile type=\"PUnstructuredGrid\" version=\"1.0\">"
      "<PUnstructuredGrid GhostLevel=\"0\"><Piece Source=\"p0.vtu\"/><Piece Source=\"p1.vtu\"/>"
      "</PUnstructuredGrid></VTKFile>";
  const std::string path = folder.write("run.pvtu", master);
  EXPECT_EQ(read_any(path).mesh.node_count(), 12U);
  const Inventory inventory = format_to_read(path).inspect(path);
  EXPECT_EQ(inventory.points, 16U);
  EXPECT_EQ(inventory.cells.at(0).count, 2U);
  std::filesystem::remove(folder.file("p1.vtu"));
  EXPECT_THAT(refusal(path), HasSubstr("p1.vtu: cannot be opened"));
  EXPECT_THAT(refusal(folder.write("cut.pvtu", master.substr(0, 150))),
              HasSubstr("not well-formed"));
}

std::string vtr_piece(int x0, const std::string& extent) {
  return fmt::format(
      "<VTKFile type=\"RectilinearGrid\" version=\"1.0\"><RectilinearGrid WholeExtent=\"{0}\">"
      "<Piece Extent=\"{0}\"><PointData>{1}</PointData><Coordinates>{2}{3}{3}</Coordinates></Piece>"
      "</RectilinearGrid></VTKFile>",
      extent, array("f", fmt::format("{0} {1} {0} {1} {0} {1} {0} {1}", x0, x0 + 1)),
      array("a", fmt::format("{} {}", x0, x0 + 1)), array("b", "0 1"));
}

TEST(VtkXml, ParallelStructuredFilesAreReadThroughTheirPieces) {
  const ScratchFolder folder;
  EXPECT_EQ(refusal(folder.write("p0.vtr", vtr_piece(0, "0 1 0 1 0 1"))), "");
  EXPECT_EQ(refusal(folder.write("p1.vtr", vtr_piece(1, "1 2 0 1 0 1"))), "");
  const std::string path = folder.write(
      "run.pvtr",
      "<VTKFile type=\"PRectilinearGrid\" version=\"1.0\"><PRectilinearGrid WholeExtent=\"0 2 0 1 "
      "0 1\"><Piece Extent=\"0 1 0 1 0 1\" Source=\"p0.vtr\"/><Piece Extent=\"1 2 0 1 0 1\" "
      "Source=\"p1.vtr\"/></PRectilinearGrid></VTKFile>");
  const ZooMesh mesh = read_any(path).mesh;
  EXPECT_EQ(mesh.node_count(), 12U);
  EXPECT_EQ(mesh.cell_count(), 2U);
  EXPECT_THAT(mesh.metadata, Contains(testing::Pair("source", "run.pvtr")));
  for (NodeId node = 0; node < 12; ++node)
    EXPECT_EQ(mesh.fields[0].values[node], mesh.position(node)[0]);
  EXPECT_EQ(format_to_read(path).inspect(path).format, "pvtr");
}

TEST(VtkXml, ACollectionHasStepsOfParts) {
  const ScratchFolder folder;
  for (const int part : {0, 1})
    for (const int step : {0, 1})
      EXPECT_EQ(refusal(folder.write(
                    fmt::format("s{}p{}.vtu", step, part),
                    vtu(brick_piece(part, "", array("c", fmt::format("{}", 10 * step + part)))))),
                "");
  std::string sets;
  for (const int part : {0, 1})
    for (const int step : {1, 0})
      sets +=
          fmt::format("<DataSet timestep=\"{}\" part=\"{}\" name=\"part{}\" file=\"s{}p{}.vtu\"/>",
                      0.5 * step, part, part, step, part);
  const std::string path = folder.write(
      "run.pvd", "<VTKFile type=\"Collection\"><Collection>" + sets + "</Collection></VTKFile>");
  const Reading last = read_any(path);
  EXPECT_EQ(last.mesh.node_count(), 12U);
  EXPECT_THAT(last.mesh.fields.at(0).values.view(), testing::ElementsAre(10, 11));
  EXPECT_THAT(last.notes, Contains(HasSubstr("the last of 2 steps, time 0.5")));
  ReadOptions options;
  options.time = 0;
  EXPECT_THAT(read_any(path, options).mesh.fields.at(0).values.view(), testing::ElementsAre(0, 1));
  options.block = "part1";
  EXPECT_THAT(read_any(path, options).mesh.fields.at(0).values.view(), testing::ElementsAre(1));
  options.time = 3;
  EXPECT_THROW(read_any(path, options), UsageError);
  EXPECT_THAT(format_to_read(path).inspect(path).times, testing::ElementsAre(0, 0.5));
  const std::string itself = folder.write(
      "self.pvd",
      "<VTKFile type=\"Collection\"><Collection><DataSet file=\"self.pvd\"/></Collection>"
      "</VTKFile>");
  EXPECT_THAT(refusal(itself), HasSubstr("itself a list of files"));
}

TEST(VtkXml, NamesOfFilesThatBreakLinesAreRefused) {
  const ScratchFolder folder;
  for (const char* text :
       {"<VTKFile type=\"Collection\"><Collection><DataSet file=\"a\nb.vtu\"/></Collection>"
        "</VTKFile>",
        "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid><Piece Source=\"a\nb.vtu\"/>"
        "</PUnstructuredGrid></VTKFile>"})
    EXPECT_THAT(refusal(folder.write("names.xml", text)),
                testing::AllOf(HasSubstr("control characters"), testing::Not(HasSubstr("\n"))));
}

TEST(VtkXml, StepsOfOneFileAreReadOneByOne) {
  const ScratchFolder folder;
  const auto at = [](const char* step, std::string text) {
    return text.insert(text.find(" Name="), fmt::format(" TimeStep='{}'", step));
  };
  const std::string whole = vtu(brick_piece(0,
                                            at("0", array("p", "0 1 2 3 4 5 6 7")) +
                                                at("1 2", array("p", "10 11 12 13 14 15 16 nan")) +
                                                at("1", array("q", "0 0 0 0 0 0 0 1")),
                                            array("c", "5")));
  const auto with_times = [&](const std::string& times) {
    std::string text = whole;
    const std::string name = "<UnstructuredGrid";
    return text.insert(text.find(name) + name.size(),
                       fmt::format(" a='>' TimeValues = \"{}\" ", times));
  };
  const std::string path = folder.write("steps.vtu", with_times("\n0\n  0.5 2 "));
  const Reading last = read_any(path);
  ASSERT_EQ(last.mesh.fields.size(), 2U);
  EXPECT_EQ(last.mesh.fields[0].values[0], 10);
  EXPECT_TRUE(std::isnan(last.mesh.fields[0].values[7]));
  EXPECT_THAT(last.mesh.metadata, Contains(std::pair<std::string, std::string>("time", "2")));
  EXPECT_THAT(last.notes, Contains(HasSubstr("the last of 3 steps, time 2 ")));
  EXPECT_THAT(last.notes, Contains(HasSubstr("field 'q' is absent at step 2, time 2")));
  ReadOptions options;
  options.step = 0;
  EXPECT_EQ(read_any(path, options).mesh.fields[0].values[7], 7);
  options.step.reset();
  options.time = 0.5;
  const Reading second = read_any(path, options);
  EXPECT_EQ(second.mesh.fields.size(), 3U);
  EXPECT_THAT(second.notes, testing::Not(Contains(HasSubstr("the last of"))));
  options.time = 3;
  EXPECT_THROW(read_any(path, options), UsageError);
  EXPECT_THAT(format_to_read(path).inspect(path).times, testing::ElementsAre(0, 0.5, 2));
  // of two steps the third is none; of four one has no arrays
  EXPECT_THAT(refusal(folder.write("two.vtu", with_times("0 1"))), HasSubstr("to step 2 (0 to 1"));
  EXPECT_THAT(refusal(folder.write("four.vtu", with_times("0 1 2 3"))),
              HasSubstr("no array belongs to step 3"));
  // where no times are told, they are the steps' numbers
  const std::string counted = folder.write("counted.vtu", whole);
  EXPECT_THAT(format_to_read(counted).inspect(counted).times, testing::ElementsAre(0, 1, 2));
  options.time = 0;
  EXPECT_EQ(read_any(counted, options).mesh.fields[0].values[7], 7);
  options.time = 2;
  EXPECT_EQ(read_any(counted, options).mesh.fields[0].values[0], 10);
}

TEST(VtkXml, BlocksOfFilesAreReadUnderTheirNames) {
  const ScratchFolder folder;
  EXPECT_EQ(refusal(folder.write("a.vtu", vtu(brick_piece(0, "", array("c", "5"))))), "");
  EXPECT_EQ(refusal(folder.write("b.vtu", vtu(brick_piece(1, "", array("d", "6"))))), "");
  EXPECT_NE(refusal(folder.write("s.vtp", "<VTKFile type=\"PolyData\"><PolyData/></VTKFile>")), "");
  const std::string path = folder.write(
      "m.vtm",
      "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\"><vtkMultiBlockDataSet>"
      "<Block index=\"0\" name=\"solids\"><DataSet index=\"0\" name=\"left\" file=\"a.vtu\"/>"
      "<DataSet index=\"1\" name=\"right\" file=\"b.vtu\"/></Block>"
      "<DataSet index=\"1\" name=\"skin\" file=\"s.vtp\"/></vtkMultiBlockDataSet></VTKFile>");
  const Reading reading = read_any(path);
  EXPECT_EQ(reading.mesh.node_count(), 12U);
  ASSERT_EQ(reading.mesh.fields.size(), 2U);
  EXPECT_EQ(reading.mesh.fields[0].values[0], 5);
  EXPECT_TRUE(std::isnan(reading.mesh.fields[0].values[1]));
  EXPECT_THAT(reading.notes, Contains(HasSubstr("1 files of surfaces")));
  ReadOptions options;
  options.block = "right";
  EXPECT_EQ(read_any(path, options).mesh.cell_count(), 1U);
  options.block = "solids";
  EXPECT_EQ(read_any(path, options).mesh.cell_count(), 2U);
  EXPECT_THAT(format_to_read(path).inspect(path).blocks,
              testing::ElementsAre("solids", "left", "right", "skin"));
}

TEST(VtkXml, GhostCellsAreLeftOut) {
  const ScratchFolder folder;
  const std::string ghost = array("vtkGhostType", "1", "UInt8");
  const std::string here = array("vtkGhostType", "0", "UInt8");
  const Reading reading =
      read_any(folder.write("g.vtu", vtu(brick_piece(0, "", here) + brick_piece(1, "", ghost))));
  EXPECT_EQ(reading.mesh.cell_count(), 1U);
  EXPECT_TRUE(reading.mesh.fields.empty());
  EXPECT_THAT(reading.notes, Contains(HasSubstr("1 ghost")));
}

TEST(VtkXml, ValuesThatAreNotFiniteAreKept) {
  const ScratchFolder folder;
  const auto piece = [](double x0) {
    return brick_piece(x0, array("p", "0 1 nan 3 4 5 inf 7"),
                       array("v", "1 NaN -inf", "Float32", 3));
  };
  const std::string path = folder.write("n.vtu", vtu(piece(0) + piece(5)));
  const ZooMesh mesh = read_any(path).mesh;
  const Field p = scalar_field(mesh, "p");
  EXPECT_TRUE(std::isnan(p.values[2]));
  EXPECT_TRUE(std::isnan(p.values[10]));
  EXPECT_EQ(p.values[14], INFINITY);
  EXPECT_EQ(p.values[15], 7);
  EXPECT_EQ(scalar_field(mesh, "v:z").values[1], -INFINITY);
  const Inventory inventory = format_to_read(path).inspect(path);
  EXPECT_EQ(inventory.fields.at(0).not_finite, 4U);
  EXPECT_EQ(inventory.fields.at(0).high, 7);
}

TEST(VtkXml, TextsAndTimeOfTheDatasetAreMetadata) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "t.vtu",
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid><FieldData>"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.125"
      "</DataArray><Array type=\"String\" Name=\"run\" NumberOfTuples=\"1\" format=\"ascii\">"
      "65 66 0</Array></FieldData>" +
          brick_piece(0) + "</UnstructuredGrid></VTKFile>");
  const ZooMesh mesh = read_any(path).mesh;
  EXPECT_THAT(mesh.metadata, Contains(std::pair<std::string, std::string>("time", "0.125")));
  EXPECT_THAT(mesh.metadata, Contains(std::pair<std::string, std::string>("run", "AB")));
  EXPECT_THAT(format_to_read(path).inspect(path).times, testing::ElementsAre(0.125));
}

// The time of a step stands for the dataset's own; other data of the whole stay.
TEST(VtkXml, FilesOfOneStepTellItsTime) {
  const ScratchFolder folder;
  const Reading reading = read_any(folder.write(
      "t.vtu",
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid TimeValues=\"4\"><FieldData>"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.125"
      "</DataArray><Array type=\"String\" Name=\"run\" NumberOfTuples=\"1\" format=\"ascii\">"
      "65 66 0</Array></FieldData>" +
          brick_piece(0) + "</UnstructuredGrid></VTKFile>"));
  using Entry = std::pair<std::string, std::string>;
  EXPECT_THAT(reading.mesh.metadata,
              testing::UnorderedElementsAre(Entry("source", "t.vtu"), Entry("run", "AB"),
                                            Entry("time", "4")));
  EXPECT_THAT(reading.notes, testing::Not(Contains(HasSubstr("the last of"))));
}

TEST(VtkXml, TextArraysOnPointsAreLeftOut) {
  const ScratchFolder folder;
  const std::string texts =
      "<Array type=\"String\" Name=\"label\" format=\"ascii\">65 0 66 0 67 0 68 0 65 0 65 0 65 0 "
      "65 0</Array>";
  const Reading reading =
      read_any(folder.write("s.vtu", vtu(brick_piece(0, texts + array("p", "0 1 2 3 4 5 6 7")))));
  EXPECT_EQ(reading.mesh.fields.size(), 1U);
  const std::string of_cell = "<Array type=\"String\" Name=\"label\" format=\"ascii\">65 0</Array>";
  const Reading cells =
      read_any(folder.write("c.vtu", vtu(brick_piece(0, "", of_cell + array("c", "3")))));
  ASSERT_EQ(cells.mesh.fields.size(), 1U);
  EXPECT_EQ(cells.mesh.fields[0].values[0], 3);
  for (const Reading* one : {&reading, &cells})
    EXPECT_THAT(one->notes, testing::Not(Contains(HasSubstr("label"))));
}

TEST(VtkXml, WarningsOfVtkAreNotes) {
  const ScratchFolder folder;
  std::string text = vtu(brick_piece(0));
  text.replace(text.find("version=\"1.0\" "), 14, "version=\"9.0\" ");
  EXPECT_THAT(read_any(folder.write("a.vtu", text)).notes, Contains(HasSubstr("9.0")));
}

struct Malformed {
  std::string from;
  std::string to;
  std::string message;
};

TEST(VtkXml, MalformedFilesAreRefused) {
  const ScratchFolder folder;
  const std::string whole = vtu(brick_piece(0, array("p", "0 1 2 3 4 5 6 7")));
  EXPECT_EQ(refusal(folder.write("whole.vtu", whole)), "");
  const std::vector<Malformed> cases{
      {"</VTKFile>", "", "not well-formed"},
      {"<?xml", "<!DOCTYPE VTKFile [<!ENTITY a 'b'>]><?xml", "document type"},
      {"version=\"1.0\" >", "version=\"1.0\" byte_order=\"Middle\">", "unknown byte_order"},
      {"version=\"1.0\" >", "version=\"1.0\" header_type=\"UInt16\">", "unknown header_type"},
      {"version=\"1.0\" >", "version=\"1.0\" compressor=\"vtkMagic\">", "unknown compressor"},
      {"<UnstructuredGrid>", "<UnstructuredGrid TimeValues=\"0 x\">", "'x' found"},
      {"<UnstructuredGrid>", "<UnstructuredGrid TimeValues=\" \">", "tells no time"},
      {"<UnstructuredGrid>", "<UnstructuredGrid TimeValues=\"inf\">", "not finite"},
      {"Name=\"Points\"", "Name=\"Points\" TimeStep=\"0\"", "TimeValues expected"},
      {"NumberOfPoints=\"8\"", "", "wrong NumberOfPoints"},
      {"NumberOfPoints=\"8\"", "NumberOfPoints=\"" + std::string(41, '9') + "\"",
       "(a count expected, '" + std::string(40, '9') + "' found)"},
      {"NumberOfPoints=\"8\"", "NumberOfPoints=\"9\"", "27 values expected, 24 found"},
      {"NumberOfPoints=\"8\"", "NumberOfPoints=\"99999999999\"", "data end too soon"},
      {"NumberOfPoints=\"8\"", "NumberOfPoints=\"-8\"", "wrong NumberOfPoints"},
      {"NumberOfPoints=\"8\"", "NumberOfPoints=\"7\"", "no such point"},
      {"NumberOfCells=\"1\"", "NumberOfCells=\"2\"", "data end too soon"},
      {"NumberOfCells=\"1\"", "NumberOfCells=\"0\"", "holds no"},
      {"NumberOfComponents=\"3\"", "NumberOfComponents=\"2\"", "components"},
      {"NumberOfComponents=\"1\"", "NumberOfComponents=\"99999999\"", "number of components"},
      {">8</DataArray>", ">99999999999</DataArray>", "data end too soon"},
      {">8</DataArray>", ">-8</DataArray>", "wrong last offset"},
      {">8</DataArray>", ">7</DataArray>", "cannot have 7 nodes"},
      {"0 1 2 3 4 5 6 7</DataArray><DataArray type=\"Int64\" Name=\"offsets\"",
       "0 1 2 3 4 5 6 8</DataArray><DataArray type=\"Int64\" Name=\"offsets\"", "no such point"},
      {">12</DataArray>", ">13</DataArray>", "a Wedge cannot have 8 nodes"},
      {"Name=\"types\"", "Name=\"typez\"", "no array 'types'"},
      {"type=\"UInt8\"", "type=\"UInt9\"", "unknown type 'UInt9'"},
      {"format=\"ascii\"", "format=\"morse\"", "unknown format 'morse'"},
      {"format=\"ascii\"", "format=\"appended\" offset=\"10\"", "beyond the appended data"},
      {"format=\"ascii\"", "format=\"binary\"", "data end too soon"},
      {"<Points>", "<Points><DataArray type=\"Int8\" format=\"ascii\"/>", "2 arrays of points"},
      {"<CellData>", "<PointData></PointData><CellData>", "a second PointData"},
  };
  for (const Malformed& c : cases) {
    std::string text = whole;
    const std::size_t at = text.find(c.from);
    ASSERT_NE(at, std::string::npos) << c.from;
    text.replace(at, c.from.size(), c.to);
    EXPECT_THAT(refusal(folder.write("bad.vtu", text)), HasSubstr(c.message))
        << c.from << " -> " << c.to;
  }
}

// Only lists of faces with their ends make polyhedra.
TEST(VtkXml, ListsOfFacesWithoutEndsAreNotLookedAt) {
  const ScratchFolder folder;
  std::string text = vtu(brick_piece(0));
  const std::string cells = "<Cells>";
  text.insert(text.find(cells) + cells.size(), array("faces", "99", "Int64"));
  EXPECT_EQ(refusal(folder.write("a.vtu", text)), "");
}

TEST(VtkXml, ComplaintsNameThePieceOfSeveral) {
  const ScratchFolder folder;
  std::string wrong = brick_piece(1);
  wrong.replace(wrong.find(">12<"), 4, ">13<");
  const std::string path = folder.file("a.vtu");
  static_cast<void>(folder.write("a.vtu", vtu(wrong)));
  EXPECT_THAT(refusal(path), testing::StartsWith(path + ": cell 0: "));
  static_cast<void>(folder.write("a.vtu", vtu(brick_piece(0) + wrong)));
  EXPECT_THAT(refusal(path), testing::StartsWith(path + ": piece 1: cell 0: "));
}

TEST(VtkXml, CellsAreMarkedByTheirPieces) {
  const ScratchFolder folder;
  const auto pieces = [&](const std::string& path) {
    const PieceMarking marking;
    ZooMesh mesh = read_any(path).mesh;
    return take_pieces(mesh);
  };
  const std::string one = folder.write("one.vtu", vtu(brick_piece(0)));
  EXPECT_EQ(pieces(one), std::nullopt);
  const std::string two = folder.write("two.vtu", vtu(brick_piece(0) + brick_piece(1)));
  EXPECT_THAT(*pieces(two), testing::ElementsAre(0, 1));
  static_cast<void>(folder.write("far.vtu", vtu(brick_piece(5))));
  const auto listed = [](const std::string& sets) {
    return "<VTKFile type=\"Collection\"><Collection>" + sets + "</Collection></VTKFile>";
  };
  const std::string sets = "<DataSet file=\"two.vtu\"/>";
  EXPECT_EQ(pieces(folder.write("a.pvd", listed("<DataSet file=\"one.vtu\"/>"))), std::nullopt);
  EXPECT_THAT(*pieces(folder.write("a.pvd", listed(sets))), testing::ElementsAre(0, 1));
  EXPECT_THAT(*pieces(folder.write("a.pvd", listed("<DataSet file=\"far.vtu\"/>" + sets))),
              testing::ElementsAre(0, 1, 1));
  EXPECT_THAT(*pieces(folder.write("a.pvtu",
                                   "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>"
                                   "<Piece Source=\"one.vtu\"/><Piece Source=\"far.vtu\"/>"
                                   "</PUnstructuredGrid></VTKFile>")),
              testing::ElementsAre(0, 1));
}

std::string image(const std::string& whole, const std::string& piece, const std::string& data) {
  return fmt::format(
      "<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData WholeExtent=\"{}\" "
      "Origin=\"1 2 3\" Spacing=\"0.5 1 2\"><Piece Extent=\"{}\"><PointData>{}</PointData></Piece>"
      "</ImageData></VTKFile>",
      whole, piece, data);
}

TEST(VtkXml, ImagesAreBricks) {
  const ScratchFolder folder;
  const std::string data = array("p", "0 1 2 3 4 5 6 7");
  const ZooMesh mesh =
      read_any(folder.write("i.vti", image("0 1 0 1 0 1", "0 1 0 1 0 1", data))).mesh;
  EXPECT_EQ(mesh.cell_count(), 1U);
  EXPECT_THAT(mesh.metadata, Contains(testing::Pair("source", "i.vti")));
  EXPECT_EQ(mesh.position(7)[0], 1.5);
  EXPECT_EQ(mesh.position(7)[2], 5);
  EXPECT_THAT(refusal(folder.write("i.vti", image("0 2 0 1 0 1", "0 1 0 1 0 1", data))),
              HasSubstr("do not cover"));
  EXPECT_THAT(refusal(folder.write("i.vti", image("0 1 0 1 0 1", "0 2 0 1 0 1", data))),
              HasSubstr("data end too soon"));
  EXPECT_THAT(refusal(folder.write("i.vti", image("0 1 0 1 0 0", "0 1 0 1 0 0", data))),
              HasSubstr("no volume cells"));
  EXPECT_THAT(
      refusal(folder.write("i.vti", image("0 99999 0 99999 0 99", "0 99999 0 99999 0 99", ""))),
      HasSubstr("too many points"));
  EXPECT_THAT(refusal(folder.write("i.vti", image("0 999 0 999 0 999", "0 999 0 999 0 999", ""))),
              HasSubstr("holds no data"));
  EXPECT_THAT(refusal(folder.write("i.vti", image("0 1 0 1 1 0", "0 1 0 1 0 1", data))),
              HasSubstr("wrong WholeExtent"));
}

TEST(VtkXml, InventoriesNameTheirFormats) {
  const ScratchFolder folder;
  const auto inventory = [&](const std::string& name, const std::string& text) {
    const std::string path = folder.write(name, text);
    return format_to_read(path).inspect(path);
  };
  const std::string data = array("p", "0 1 2 3 4 5 6 7");
  const Inventory unstructured = inventory("a.xml", vtu(brick_piece(0, data)));
  EXPECT_EQ(unstructured.format, "vtu");
  const Inventory of_image = inventory("b.xml", image("0 1 0 1 0 1", "0 1 0 1 0 1", data));
  EXPECT_EQ(of_image.format, "vti");
  const Inventory rectilinear = inventory("c.xml", vtr_piece(0, "0 1 0 1 0 1"));
  EXPECT_EQ(rectilinear.format, "vtr");
  for (const Inventory& one : {unstructured, of_image, rectilinear}) {
    EXPECT_EQ(one.points, 8U);
    ASSERT_EQ(one.cells.size(), 1U) << one.format;
    EXPECT_EQ(one.cells[0].kind, "Hexahedron");
    ASSERT_EQ(one.fields.size(), 1U) << one.format;
    EXPECT_EQ(one.fields[0].tuples, 8U);
  }
}

}  // namespace
}  // namespace hiac::formats

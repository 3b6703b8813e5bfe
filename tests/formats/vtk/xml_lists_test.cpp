// Files that name other files: collections, trees of blocks, and the pieces of parallel runs.
#include <fmt/format.h>

#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A tetrahedron at x0 with a value on its cell.
std::string listed_tetrahedron(double x0, const std::string& field, double value) {
  return fmt::format(
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"4\" "
      "NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
      "format=\"ascii\">{0} 0 0 {1} 0 0 {0} 1 0 {0} 0 1</DataArray></Points><Cells><DataArray "
      "type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray><DataArray "
      "type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray><DataArray type=\"UInt8\" "
      "Name=\"types\" format=\"ascii\">10</DataArray></Cells><CellData><DataArray "
      "type=\"Float64\" Name=\"{2}\" format=\"ascii\">{3}</DataArray></CellData></Piece>"
      "</UnstructuredGrid></VTKFile>",
      x0, x0 + 1, field, value);
}

std::string collection_of(const std::string& sets) {
  return "<VTKFile type=\"Collection\"><Collection>" + sets + "</Collection></VTKFile>";
}

class XmlLists : public testing::Test {
 protected:
  XmlLists() {
    for (const int n : {0, 1, 2, 3})
      static_cast<void>(folder_.write(fmt::format("t{}.vtu", n),
                                      listed_tetrahedron(3 * n, n == 3 ? "q" : "p", 10 * n)));
  }

  [[nodiscard]] std::string said_of(const std::string& name, const std::string& text) const {
    const std::string path = folder_.write(name, text);
    const std::string message = refusal(path);
    return message.empty() ? message : message.substr(path.size() + 2);
  }

  ScratchFolder folder_;
};

TEST_F(XmlLists, CollectionsNameFilesAndTimes) {
  const auto said = [&](const std::string& sets) { return said_of("a.pvd", collection_of(sets)); };
  EXPECT_EQ(said(""), "names no files");
  EXPECT_EQ(said("<DataSet timestep=\"1\"/>"), "a DataSet without a file");
  EXPECT_EQ(said("<DataSet timestep=\"1\" file=\"\"/>"), "a DataSet without a file");
  const std::string wrong = "a DataSet with a wrong timestep (a number expected, '";
  EXPECT_EQ(said("<DataSet timestep=\"1s\" file=\"t0.vtu\"/>"), wrong + "1s' found)");
  EXPECT_EQ(said("<DataSet timestep=\"\" file=\"t0.vtu\"/>"), wrong + "' found)");
  EXPECT_EQ(said("<DataSet timestep=\"inf\" file=\"t0.vtu\"/>"), wrong + "inf' found)");
  EXPECT_EQ(said("<DataSet timestep=\"-1e3\" file=\"t0.vtu\"/>"), "");
  EXPECT_EQ(said("<DataSet file=\"t0.vtu\"/>"), "");
  EXPECT_EQ(said("<Other file=\"t0.vtu\"/>"), "names no files");
}

TEST_F(XmlLists, FilesOfOneTimeAreOneMesh) {
  const std::string path = folder_.write(
      "a.pvd", collection_of("<DataSet timestep=\"2\" group=\"g\" name=\"n\" file=\"t0.vtu\"/>"
                             "<DataSet timestep=\"1\" file=\"t1.vtu\"/>"
                             "<DataSet timestep=\"2\" group=\"g\" file=\"t2.vtu\"/>") +
                   "stray");
  const Reading reading = read_any(path);
  EXPECT_THAT(field_named(reading.mesh, "p").values.view(), ElementsAre(0, 20));
  using Entry = std::pair<std::string, std::string>;
  EXPECT_THAT(reading.mesh.metadata, Contains(Entry("time", "2")));
  EXPECT_THAT(reading.notes, Contains("5 bytes behind the end of </VTKFile> are not read"));
  const Inventory inventory = format_to_read(path).inspect(path);
  EXPECT_EQ(inventory.format, "pvd");
  EXPECT_EQ(inventory.points, 8U);
  EXPECT_THAT(inventory.blocks, ElementsAre("g", "n"));
  EXPECT_THAT(inventory.times, ElementsAre(1, 2));
  ReadOptions options;
  options.block = "n";
  EXPECT_THAT(field_named(read_any(path, options).mesh, "p").values.view(), ElementsAre(0));
  options.block = "m";
  EXPECT_THROW(read_any(path, options), UsageError);
  options.block.reset();
  options.step = 0;
  const Reading first = read_any(path, options);
  EXPECT_THAT(field_named(first.mesh, "p").values.view(), ElementsAre(10));
  EXPECT_THAT(first.notes, Not(Contains(HasSubstr("the last of"))));
}

TEST_F(XmlLists, FieldsOfSomeStepsAreToldInTheInventory) {
  const std::string path =
      folder_.write("a.pvd", collection_of("<DataSet timestep=\"1\" file=\"t0.vtu\"/>"
                                           "<DataSet timestep=\"2\" file=\"t3.vtu\"/>"
                                           "<DataSet timestep=\"3\" file=\"t2.vtu\"/>"));
  const Inventory inventory = format_to_read(path).inspect(path);
  EXPECT_THAT(inventory.notes, Contains(testing::AllOf(HasSubstr("p"), HasSubstr("2 of 3 steps"))));
  EXPECT_THAT(inventory.notes, Contains(testing::AllOf(HasSubstr("q"), HasSubstr("1 of 3 steps"))));
}

TEST_F(XmlLists, BytesOfAppendedDataAreNoFields) {
  std::string text = listed_tetrahedron(0, "p", 7);
  const std::size_t end = text.find("</VTKFile>");
  static_cast<void>(folder_.write(
      "raw.vtu", text.insert(end,
                             "<AppendedData encoding=\"raw\">_<CellData><D Name=\"z\"/>"
                             "</CellData></AppendedData>")));
  const std::string path =
      folder_.write("a.pvd", collection_of("<DataSet timestep=\"1\" file=\"raw.vtu\"/>"
                                           "<DataSet timestep=\"2\" file=\"t1.vtu\"/>"));
  EXPECT_THAT(format_to_read(path).inspect(path).notes, testing::IsEmpty());
}

TEST_F(XmlLists, MetadataOfTheFilesAreKept) {
  std::string text = listed_tetrahedron(0, "p", 7);
  const std::string grid = "<UnstructuredGrid>";
  text.insert(text.find(grid) + grid.size(),
              "<FieldData><Array type=\"String\" Name=\"run\" NumberOfTuples=\"1\" "
              "format=\"ascii\">65 66 0</Array></FieldData>");
  static_cast<void>(folder_.write("run.vtu", text));
  const ZooMesh mesh =
      read_any(folder_.write("a.pvd", collection_of("<DataSet timestep=\"3\" file=\"run.vtu\"/>")))
          .mesh;
  using Entry = std::pair<std::string, std::string>;
  EXPECT_THAT(mesh.metadata, testing::UnorderedElementsAre(Entry("source", "a.pvd"),
                                                           Entry("run", "AB"), Entry("time", "3")));
}

// What the points and the cells' lists are called is not looked at.
TEST_F(XmlLists, OnlyArraysOfPointsAndCellsAreFields) {
  const auto file = [&](const std::string& name, const std::string& data,
                        const std::string& points) {
    std::string text = listed_tetrahedron(0, "p", 7);
    text.insert(text.find("<Points>"), data);
    const std::string array = "<DataArray type=\"Float64\" NumberOfComponents=\"3\"";
    text.insert(text.find(array) + array.size(), points);
    static_cast<void>(folder_.write(name, text));
  };
  for (const std::string data :
       {"<PointData/>",
        "<PointData><DataArray type=\"Float64\" Name=\"q\" format=\"ascii\">1 2 3 4</DataArray>"
        "</PointData>"}) {
    file("a.vtu", data, " Name=\"places\"");
    file("b.vtu", data, "");
    const std::string path =
        folder_.write("a.pvd", collection_of("<DataSet timestep=\"1\" file=\"a.vtu\"/>"
                                             "<DataSet timestep=\"2\" file=\"b.vtu\"/>"));
    EXPECT_THAT(format_to_read(path).inspect(path).notes, testing::IsEmpty()) << data;
  }
}

std::string tree_of(const std::string& type, const std::string& blocks) {
  return fmt::format("<VTKFile type=\"{0}\"><{0}>{1}</{0}></VTKFile>", type, blocks);
}

TEST_F(XmlLists, TreesOfBlocks) {
  const std::string blocks = "vtkMultiBlockDataSet";
  EXPECT_EQ(said_of("a.vtm", tree_of(blocks, "")), "names no files");
  EXPECT_EQ(said_of("a.vtm", tree_of(blocks, "<Block name=\"b\"><DataSet/></Block>")),
            "names no files");
  EXPECT_EQ(said_of("a.vtm", tree_of(blocks, "<Other><DataSet file=\"t0.vtu\"/></Other>")),
            "names no files");
  for (const std::string& tree :
       {tree_of(blocks, "<Block><DataSet file=\"t0.vtu\"/><Piece file=\"t1.vtu\"/></Block>"),
        tree_of(blocks, "<Piece><DataSet file=\"t0.vtu\"/><DataSet file=\"t1.vtu\"/></Piece>"),
        tree_of("vtkPartitionedDataSetCollection",
                "<Partitions><DataSet file=\"t0.vtu\"/></Partitions><DataSet file=\"t1.vtu\"/>"),
        tree_of("vtkPartitionedDataSet", "<DataSet file=\"t0.vtu\"/><DataSet file=\"t1.vtu\"/>")}) {
    const std::string path = folder_.write("a.vtm", tree);
    EXPECT_THAT(field_named(read_any(path).mesh, "p").values.view(), ElementsAre(0, 10));
    EXPECT_EQ(format_to_read(path).inspect(path).format, "vtm");
  }
}

TEST_F(XmlLists, TreesHaveOneStep) {
  const std::string path = folder_.write(
      "a.vtm", tree_of("vtkMultiBlockDataSet", "<DataSet name=\"d\" file=\"t0.vtu\"/>"));
  const auto complaint = [&](const ReadOptions& options) -> std::string {
    try {
      read_any(path, options);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "none";
  };
  ReadOptions options;
  options.step = 0;
  EXPECT_EQ(complaint(options), "none");
  options.step = 1;
  EXPECT_EQ(complaint(options), "step: " + path + " holds one step");
  options.step.reset();
  options.time = 0;
  EXPECT_EQ(complaint(options), "time: " + path + " holds one step");
}

TEST_F(XmlLists, ListsDoNotNameLists) {
  const std::string tree = tree_of("vtkMultiBlockDataSet", "<DataSet file=\"t0.vtu\"/>");
  const std::string inner = folder_.write("inner.vtm", tree);
  const std::string listed = ", which is itself a list of files (a dataset expected)";
  EXPECT_EQ(said_of("a.vtm", tree_of("vtkPartitionedDataSet", "<DataSet file=\"inner.vtm\"/>")),
            "names " + inner + listed);
  // a collection may name trees, and no tree a collection
  EXPECT_EQ(said_of("a.pvd", collection_of("<DataSet file=\"inner.vtm\"/>")), "");
  const std::string collection =
      folder_.write("inner.pvd", collection_of("<DataSet file=\"t0.vtu\"/>"));
  EXPECT_EQ(said_of("a.vtm", tree_of("vtkMultiBlockDataSet", "<DataSet file=\"inner.pvd\"/>")),
            "names " + collection + listed);
}

TEST_F(XmlLists, SurfacesAndTablesAreLeftOut) {
  for (const std::string type : {"PolyData", "PPolyData", "Table", "PTable"}) {
    static_cast<void>(
        folder_.write("s.xml", fmt::format("<VTKFile type=\"{0}\"><{0}/></VTKFile>", type)));
    const Reading reading = read_any(
        folder_.write("a.pvd", collection_of("<DataSet file=\"s.xml\"/><DataSet file=\"t1.vtu\"/>"
                                             "<DataSet file=\"s.xml\"/>")));
    EXPECT_EQ(reading.mesh.cell_count(), 1U) << type;
    EXPECT_THAT(reading.notes, Contains("left out 2 files of surfaces or tables")) << type;
    EXPECT_THAT(format_to_read(folder_.file("a.pvd")).inspect(folder_.file("a.pvd")).notes,
                Contains("left out 2 files of surfaces or tables"))
        << type;
  }
}

TEST_F(XmlLists, PiecesOfRunsHaveTheirSources) {
  const auto run = [](const std::string& pieces) {
    return "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>" + pieces +
           "</PUnstructuredGrid></VTKFile>";
  };
  EXPECT_EQ(said_of("a.pvtu", run("")), "names no pieces");
  EXPECT_EQ(said_of("a.pvtu", run("<Piece Source=\"t0.vtu\"/><Piece/>")),
            "a piece without a Source");
  EXPECT_EQ(said_of("a.pvtu", run("<Piece Source=\"\"/>")), "a piece without a Source");
  const std::string path =
      folder_.write("a.pvtu", run("<Piece Source=\"t1.vtu\"/><Piece Source=\"t0.vtu\"/>"));
  const ZooMesh mesh = read_any(path).mesh;
  EXPECT_THAT(field_named(mesh, "p").values.view(), ElementsAre(10, 0));
  using Entry = std::pair<std::string, std::string>;
  EXPECT_THAT(mesh.metadata, Contains(Entry("pieces", "2")));
}

}  // namespace
}  // namespace hiac::formats

// What the check of VTK's XML files says about the frame of a file, its attributes and its cells:
// the whole complaint, and the nearest input that is fine.

#include "formats/vtk/xml/xml_array.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;

std::string xml_array(const std::string& attributes, const std::string& values) {
  return "<DataArray " + attributes + ">" + values + "</DataArray>";
}

const std::string kTetPointsArray = xml_array(
    "type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\"", "0 0 0 1 0 0 0 1 0 0 0 1");
const std::string kTetCellArrays =
    xml_array("type=\"Int64\" Name=\"connectivity\" format=\"ascii\"", "0 1 2 3") +
    xml_array("type=\"Int64\" Name=\"offsets\" format=\"ascii\"", "4") +
    xml_array("type=\"UInt8\" Name=\"types\" format=\"ascii\"", "10");

std::string tet_piece(const std::string& point_data = "", const std::string& cell_data = "") {
  return "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>" + kTetPointsArray +
         "</Points><Cells>" + kTetCellArrays + "</Cells><PointData>" + point_data +
         "</PointData><CellData>" + cell_data + "</CellData></Piece>";
}

std::string tet_grid(const std::string& content, const std::string& attributes = "",
                     const std::string& behind = "") {
  return "<VTKFile type=\"UnstructuredGrid\" " + attributes + "><UnstructuredGrid>" + content +
         "</UnstructuredGrid>" + behind + "</VTKFile>";
}

struct XmlRow {
  std::string name;
  std::string text;
  std::string message;  ///< after the file's name; empty where the file is read
};

void expect_xml_rows(const std::vector<XmlRow>& rows) {
  const ScratchFolder folder;
  for (const XmlRow& row : rows) {
    const std::string path = folder.write("a.vtu", row.text);
    EXPECT_EQ(refusal(path), row.message.empty() ? "" : path + ": " + row.message) << row.name;
  }
}

TEST(XmlRefusals, FramesOfFiles) {
  const std::string root = "<VTKFile type=\"UnstructuredGrid\"";
  const std::string open = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid></VTKFile>";
  const auto nested = [](int depth) {
    std::string begin;
    std::string end;
    for (int i = 0; i < depth; ++i) begin += "<a>";
    for (int i = 0; i < depth; ++i) end += "</a>";
    return tet_grid(tet_piece() + begin + end);
  };
  expect_xml_rows(
      {{"whole", tet_grid(tet_piece()), ""},
       {"entities", "<!DOCTYPE VTKFile>" + tet_grid(tet_piece()), "has a document type definition"},
       {"cut", open, "is not well-formed: Start-end tags mismatch at byte 53 of 61"},
       {"no root", "<a>" + tet_grid("") + "</a>", "has no VTKFile element"},
       {"no grid", root + "><ImageData/></VTKFile>", "has no UnstructuredGrid element"},
       {"no piece", tet_grid(""), "holds no piece"},
       {"byte order", tet_grid("", "byte_order=\"Middle\""), "unknown byte_order 'Middle'"},
       {"header", tet_grid("", "header_type=\"UInt16\""), "unknown header_type 'UInt16'"},
       {"compressor", tet_grid("", "compressor=\"vtkMagic\""), "unknown compressor 'vtkMagic'"},
       {"a hundred levels", nested(99), ""},
       {"one more", nested(100),
        "has elements that are nested too deeply (at most 100 expected)"}});
}

TEST(XmlRefusals, AppendedDataNeedTheirFrame) {
  const std::string grid = tet_grid(tet_piece());
  const auto behind = [](const std::string& text) { return tet_grid(tet_piece(), "", text); };
  const std::string begin = grid.substr(0, grid.size() - 10);
  expect_xml_rows(
      {{"empty", behind("<AppendedData encoding=\"raw\">_</AppendedData>"), ""},
       {"blanks", behind("<AppendedData>\n\t _</AppendedData>"), ""},
       {"unclosed tag", begin + "<AppendedData encoding=\"raw\"",
        "ends too soon (appended data expected)"},
       {"encoding", behind("<AppendedData encoding=\"hex\">_</AppendedData>"),
        "unknown encoding 'hex' of appended data"},
       {"not closed", behind("<AppendedData encoding=\"raw\">_"),
        "ends too soon (</AppendedData> and </VTKFile> expected)"},
       {"file not closed", begin + "<AppendedData>_</AppendedData>",
        "ends too soon (</AppendedData> and </VTKFile> expected)"},
       {"no mark", behind("<AppendedData>x_</AppendedData>"),
        "has no '_' before its appended data"},
       {"nothing", behind("<AppendedData> </AppendedData>"), "has no '_' before its appended data"},
       {"offset at the end",
        tet_grid(
            tet_piece(xml_array("type=\"Int8\" Name=\"a\" format=\"appended\" offset=\"3\"", "")),
            "", "<AppendedData encoding=\"raw\">_abc</AppendedData>"),
        "array 'a': the data end too soon (4 bytes expected, 0 found)"},
       {"offset beyond it",
        tet_grid(
            tet_piece(xml_array("type=\"Int8\" Name=\"a\" format=\"appended\" offset=\"4\"", "")),
            "", "<AppendedData encoding=\"raw\">_abc</AppendedData>"),
        "array 'a': its data begin beyond the appended data (at most 3 expected, 4 found)"}});
}

TEST(XmlRefusals, AttributesOfArrays) {
  const auto with = [](const std::string& attributes, const std::string& values = "1 2 3 4") {
    return tet_grid(tet_piece(xml_array(attributes, values)));
  };
  expect_xml_rows(
      {{"type", with("type=\"Int128\" Name=\"a\" format=\"ascii\""),
        "array 'a': unknown type 'Int128'"},
       {"no type", with("Name=\"a\" format=\"ascii\""), "array 'a': unknown type ''"},
       {"no components", with("type=\"Int8\" Name=\"a\" NumberOfComponents=\"0\" format=\"ascii\""),
        "array 'a': wrong number of components (0)"},
       {"a million",
        with("type=\"Int8\" Name=\"a\" NumberOfComponents=\"1000000\" format=\"ascii\""),
        "array 'a': the data end too soon (4000000 values expected, 4 found)"},
       {"more", with("type=\"Int8\" Name=\"a\" NumberOfComponents=\"1000001\" format=\"ascii\""),
        "array 'a': wrong number of components (1000001)"},
       {"format", with("type=\"Int8\" Name=\"a\" format=\"hex\""),
        "array 'a': unknown format 'hex'"},
       {"step", with("type=\"Int8\" Name=\"a\" TimeStep=\"1\" format=\"ascii\""),
        "array 'a' belongs to a time step, of which the file tells none (TimeValues expected)"},
       {"values", with("type=\"Int8\" Name=\"a\" format=\"ascii\"", "1 2 128 4"),
        "array 'a': wrong value 2 (a number of its type expected, '128' found)"},
       {"too few", with("type=\"Int8\" Name=\"a\" format=\"ascii\"", "1 2 33"),
        "array 'a': the data end too soon (4 values expected, 3 found)"},
       {"too few for the bytes", with("type=\"Int8\" Name=\"a\" format=\"ascii\"", "1 2 3"),
        "array 'a': the data end too soon (4 values expected, 3 found)"},
       {"values behind the last", with("type=\"Int8\" Name=\"a\" format=\"ascii\"", "1 2 3 4 5"),
        ""},
       {"behind the last not finite",
        with("type=\"Float32\" Name=\"a\" format=\"ascii\"", "1 2 3 4 nan"),
        "array 'a': wrong value 4 (a number of its type expected, 'nan' found)"},
       {"largest count",
        tet_grid("<Piece NumberOfPoints=\"1099511627775\" NumberOfCells=\"0\"></Piece>"),
        "a piece has 0 arrays of points (1 expected)"},
       {"beyond it",
        tet_grid("<Piece NumberOfPoints=\"1099511627776\" NumberOfCells=\"0\"></Piece>"),
        "Piece: wrong NumberOfPoints (a count expected, '1099511627776' found)"},
       {"words in counts", tet_grid("<Piece NumberOfPoints=\"4 4\" NumberOfCells=\"0\"></Piece>"),
        "Piece: wrong NumberOfPoints (a count expected, '4 4' found)"},
       {"blanks around counts",
        tet_grid("<Piece NumberOfPoints=\"4\" NumberOfCells=\" x \"></Piece>"),
        "Piece: wrong NumberOfCells (a count expected, 'x' found)"}});
}

TEST(XmlRefusals, ValuesBeyondAnyMemory) {
  vtk::XmlArray array;
  array.name = "a";
  array.type = {vtk::NumberType::Family::real, 8};
  array.encoding = vtk::XmlArray::Encoding::raw;
  const auto complaint = [&](std::size_t values) -> std::string {
    try {
      vtk::check_xml_array(array, values, {}, false, "file");
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(complaint(std::size_t{1} << 60), "file: array 'a': too many values");
  EXPECT_EQ(complaint((std::size_t{1} << 60) - 1),
            "file: array 'a': the data end too soon (4 bytes expected, 0 found)");
  EXPECT_EQ(complaint(0), "none");
}

TEST(XmlRefusals, SectionsToldTwiceAndPointsThatDoNotFit) {
  const auto piece = [](const std::string& sections) {
    return tet_grid("<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">" + sections + "</Piece>");
  };
  const std::string points = "<Points>" + kTetPointsArray + "</Points>";
  const std::string cells = "<Cells>" + kTetCellArrays + "</Cells>";
  expect_xml_rows(
      {{"points", piece(points + points + cells), "a second Points element"},
       {"cells", piece(points + cells + cells), "a second Cells element"},
       {"cell data", piece(points + cells + "<CellData/><CellData/>"), "a second CellData element"},
       {"field data", tet_grid("<FieldData/><FieldData/>" + tet_piece()),
        "a second FieldData element"},
       {"no points", piece(cells), "a piece has 0 arrays of points (1 expected)"},
       {"two arrays", piece("<Points>" + kTetPointsArray + kTetPointsArray + "</Points>" + cells),
        "a piece has 2 arrays of points (1 expected)"},
       {"texts",
        piece("<Points>" +
              xml_array("type=\"String\" NumberOfComponents=\"3\" format=\"ascii\"", "") +
              "</Points>" + cells),
        "the points have 3 components (3 numbers expected)"},
       {"plane",
        piece("<Points>" +
              xml_array("type=\"Int8\" NumberOfComponents=\"2\" format=\"ascii\"", "") +
              "</Points>" + cells),
        "the points have 2 components (3 numbers expected)"},
       {"other arrays",
        tet_grid(tet_piece(xml_array("type=\"Int8\" Name=\"a\" format=\"ascii\"", "1 2 3 4")) +
                 tet_piece()),
        "its pieces do not carry the same arrays in the same order"},
       {"other types",
        tet_grid(tet_piece("", xml_array("type=\"Int8\" Name=\"a\" format=\"ascii\"", "1")) +
                 tet_piece("", xml_array("type=\"UInt8\" Name=\"a\" format=\"ascii\"", "1"))),
        "its pieces do not carry the same arrays in the same order"},
       {"other widths",
        tet_grid(tet_piece("", xml_array("type=\"Int8\" Name=\"a\" format=\"ascii\"", "1")) +
                 tet_piece("", xml_array("type=\"Int16\" Name=\"a\" format=\"ascii\"", "1"))),
        "its pieces do not carry the same arrays in the same order"},
       {"empty piece",
        tet_grid(tet_piece("", xml_array("type=\"Int8\" Name=\"a\" format=\"ascii\"", "1")) +
                 "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"><Points>" +
                 xml_array("type=\"Int8\" NumberOfComponents=\"3\" format=\"ascii\"", "") +
                 "</Points><Cells>" +
                 xml_array("type=\"Int8\" Name=\"connectivity\" format=\"ascii\"", "") +
                 xml_array("type=\"Int8\" Name=\"offsets\" format=\"ascii\"", "") +
                 xml_array("type=\"UInt8\" Name=\"types\" format=\"ascii\"", "") +
                 "</Cells></Piece>"),
        ""}});
}

TEST(XmlRefusals, CellsNeedTheirArrays) {
  const auto cells = [](const std::string& from, const std::string& to) {
    std::string text = tet_grid(tet_piece());
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string integers = "' of the cells does not hold single integers";
  expect_xml_rows(
      {{"no offsets", cells("\"offsets\"", "\"ends\""), "a piece's cells have no array 'offsets'"},
       {"no connectivity", cells("\"connectivity\"", "\"nodes\""),
        "a piece's cells have no array 'connectivity'"},
       {"real types", cells("\"UInt8\"", "\"Float32\""), "array 'types" + integers},
       {"texts", cells("\"Int64\" Name=\"offsets\"", "\"String\" Name=\"offsets\""),
        "array 'offsets" + integers},
       {"pairs", cells("Name=\"offsets\"", "Name=\"offsets\" NumberOfComponents=\"2\""),
        "array 'offsets" + integers},
       {"negative offset", cells(">4<", ">-1<"), "wrong last offset of the cells (-1)"},
       {"largest offset", cells(">4<", ">281474976710655<"),
        "array 'connectivity': the data end too soon (281474976710655 values expected, 4 found)"},
       {"beyond it", cells(">4<", ">281474976710656<"),
        "wrong last offset of the cells (281474976710656)"}});
}

std::string polyhedron_grid(const std::string& faces, const std::string& ends) {
  return tet_grid("<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>" + kTetPointsArray +
                  "</Points><Cells>" +
                  xml_array("type=\"Int64\" Name=\"connectivity\" format=\"ascii\"", "0 1 2 3") +
                  xml_array("type=\"Int64\" Name=\"offsets\" format=\"ascii\"", "4") +
                  xml_array("type=\"UInt8\" Name=\"types\" format=\"ascii\"", "42") +
                  xml_array("type=\"Int64\" Name=\"faces\" format=\"ascii\"", faces) +
                  xml_array("type=\"Int64\" Name=\"faceoffsets\" format=\"ascii\"", ends) +
                  "</Cells></Piece>");
}

TEST(XmlRefusals, FacesOfPolyhedra) {
  const std::string damaged = "the face lists of the polyhedra are damaged at entry ";
  const std::string faces = "4 3 0 2 1 3 0 1 3 3 1 2 3 3 2 0 3";
  expect_xml_rows(
      {{"whole", polyhedron_grid(faces, "17"), ""},
       {"negative count", polyhedron_grid("-4 3 0 2 1", "5"), damaged + "0"},
       {"more faces than numbers", polyhedron_grid("6 3 0 2 1", "5"), damaged + "0"},
       {"faces that are not there", polyhedron_grid("5 3 0 2 1", "5"), damaged + "5"},
       {"more corners than numbers", polyhedron_grid("1 6 0 2 1", "5"), damaged + "1"},
       {"a point that is not there", polyhedron_grid("1 3 0 4 1", "5"), damaged + "3"},
       {"a negative point", polyhedron_grid("1 3 0 -1 1", "5"), damaged + "3"},
       {"ends elsewhere", polyhedron_grid("1 3 0 1 2 3", "6"),
        "the face lists of the polyhedra do not end where they should (6 expected, 5 found)"},
       {"too few numbers", polyhedron_grid("1 3 0 1 2", "6"),
        "array 'faces': the data end too soon (6 values expected, 5 found)"}});
}

TEST(XmlRefusals, FaceListsOfOtherCellsAreEmpty) {
  const ScratchFolder folder;
  std::string text = polyhedron_grid("4 3 0 2 1 3 0 1 3 3 1 2 3 3 2 0 3", "-1 17");
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"NumberOfCells=\"1\"", "NumberOfCells=\"2\""},
        {">0 1 2 3<", ">0 1 2 3 0 1 2 3<"},
        {">4<", ">4 8<"},
        {">42<", ">10 42<"}})
    text.replace(text.find(from), from.size(), to);
  EXPECT_EQ(read_any(folder.write("a.vtu", text)).mesh.cell_count(), 2U);
  // the last list ends before the list of the cell before it
  text.replace(text.find(">-1 17<"), 7, ">17 -1<");
  text.replace(text.find(">10 42<"), 7, ">42 10<");
  EXPECT_EQ(read_any(folder.write("b.vtu", text)).mesh.cell_count(), 2U);
}

TEST(XmlRefusals, FieldDataMustBeFinite) {
  const auto with = [](const std::string& values, const std::string& tuples) {
    return tet_grid("<FieldData>" +
                    xml_array("type=\"Float64\" Name=\"t\" format=\"ascii\" " + tuples, values) +
                    "</FieldData>" + tet_piece());
  };
  expect_xml_rows({{"finite", with("1", "NumberOfTuples=\"1\""), ""},
                   {"not", with("nan", "NumberOfTuples=\"1\""),
                    "array 't': values that are not finite cannot be read here"},
                   {"too few", with("1", "NumberOfTuples=\"2\""),
                    "array 't': the data end too soon (2 values expected, 1 found)"}});
}

TEST(XmlRefusals, RootsOfManyForms) {
  const ScratchFolder folder;
  const std::string grid = tet_grid(tet_piece());
  const std::string rest = grid.substr(grid.find("><Unst"));
  for (const char* root :
       {"<VTKFile\n\ttype='UnstructuredGrid'",
        "<VTKFile header_type=\"UInt32\" type=\"UnstructuredGrid\"",
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"BigEndian\" header_type=\"UInt64\""})
    EXPECT_EQ(read_any(folder.write("a.xml", root + rest)).mesh.cell_count(), 1U) << root;
  for (const char* root :
       {"<VTKFile sorttype=\"UnstructuredGrid\"", "<VTKFile type=UnstructuredGrid"})
    EXPECT_THAT(refusal(folder.write("a.vtu", root + rest)), HasSubstr("is not a vtu file"))
        << root;
}

}  // namespace
}  // namespace hiac::formats

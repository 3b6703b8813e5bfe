#include "formats/vtk/xml/xml_surface.hpp"

#include <array>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "formats/surface/surface_file.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;
using vtk::read_xml_surface;
using vtk::XmlSurface;

constexpr const char* kPoints =
    "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">\n"
    "0 0 0 2 0 0 0 3 0 0 0 4.5 1 1 0.5 7 8 9\n</DataArray></Points>\n";

std::string cells(const char* section, const std::string& connectivity, const std::string& offsets,
                  const std::string& types = "") {
  const auto array = [](const char* name, const char* type, const std::string& values) {
    return fmt::format("<DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">{}</DataArray>\n", type,
                       name, values);
  };
  return fmt::format(
      "<{0}>\n{1}{2}{3}</{0}>\n", section, array("connectivity", "Int64", connectivity),
      array("offsets", "Int64", offsets), types.empty() ? "" : array("types", "UInt8", types));
}

std::string file(const char* type, const std::string& pieces) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<{0}>\n{1}</{0}>\n</VTKFile>\n",
      type, pieces);
}

std::string poly_data(const std::string& attributes, const std::string& content) {
  return fmt::format("<Piece NumberOfPoints=\"6\" {}>\n{}{}</Piece>\n", attributes, kPoints,
                     content);
}

std::string grid(int count, const std::string& connectivity, const std::string& offsets,
                 const std::string& types) {
  return file("UnstructuredGrid",
              fmt::format("<Piece NumberOfPoints=\"6\" NumberOfCells=\"{}\">\n{}{}</Piece>\n",
                          count, kPoints, cells("Cells", connectivity, offsets, types)));
}

TEST(XmlSurface, PolygonsStripsAndLines) {
  const ScratchFolder folder;
  const std::string content = cells("Verts", "5", "1") + cells("Lines", "0 1 2", "3") +
                              cells("Polys", "0 2 1 0 1 4 3", "3 7") +
                              cells("Strips", "0 1 2 3 4", "5");
  const std::string piece = poly_data(
      "NumberOfVerts=\"1\" NumberOfLines=\"1\" NumberOfPolys=\"2\" NumberOfStrips=\"1\"", content);
  const XmlSurface surface = read_xml_surface(folder.write("a.vtp", file("PolyData", piece)));
  EXPECT_THAT(surface.xyz, ElementsAre(0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4.5, 1, 1, 0.5, 7, 8, 9));
  EXPECT_THAT(surface.polygons,
              ElementsAre(ElementsAre(0, 2, 1), ElementsAre(0, 1, 4, 3), ElementsAre(0, 1, 2),
                          ElementsAre(2, 1, 3), ElementsAre(2, 3, 4)));
  EXPECT_THAT(surface.notes, ElementsAre("left out 2 points and lines"));
  // the points of a second piece follow those of the first
  const XmlSurface twice = read_xml_surface(folder.write("b.vtp", file("PolyData", piece + piece)));
  EXPECT_EQ(twice.xyz.size(), 36U);
  ASSERT_EQ(twice.polygons.size(), 10U);
  EXPECT_THAT(twice.polygons[6], ElementsAre(6, 7, 10, 9));
}

TEST(XmlSurface, CellsOfGrids) {
  const ScratchFolder folder;
  const auto polygons = [&](const std::string& connectivity, int type) {
    const auto count =
        static_cast<std::size_t>(std::count(connectivity.begin(), connectivity.end(), ' ') + 1);
    return read_xml_surface(folder.write("a.vtu", grid(1, connectivity, std::to_string(count),
                                                       std::to_string(type))))
        .polygons;
  };
  EXPECT_THAT(polygons("3 1 2", 5), ElementsAre(ElementsAre(3, 1, 2)));
  EXPECT_THAT(polygons("3 1 2 0 4", 7), ElementsAre(ElementsAre(3, 1, 2, 0, 4)));
  EXPECT_THAT(polygons("3 1 2 0", 9), ElementsAre(ElementsAre(3, 1, 2, 0)));
  EXPECT_THAT(polygons("3 1 2 0", 8), ElementsAre(ElementsAre(3, 1, 0, 2)));
  EXPECT_THAT(polygons("0 1 2 3 4 5", 22), ElementsAre(ElementsAre(0, 3, 5), ElementsAre(3, 1, 4),
                                                       ElementsAre(5, 4, 2), ElementsAre(3, 4, 5)));
  // eight and nine nodes: corners, edges' middles, the middle
  EXPECT_THAT(polygons("0 1 2 3 4 5 5 4", 23),
              ElementsAre(ElementsAre(0, 4, 4), ElementsAre(1, 5, 4), ElementsAre(2, 5, 5),
                          ElementsAre(3, 4, 5), ElementsAre(4, 5, 5, 4)));
  EXPECT_THAT(polygons("0 1 2 3 4 5 5 4 0", 28),
              ElementsAre(ElementsAre(0, 4, 0, 4), ElementsAre(4, 1, 5, 0), ElementsAre(0, 5, 2, 5),
                          ElementsAre(4, 0, 5, 3)));
  EXPECT_TRUE(polygons("0 1", 3).empty());
}

TEST(XmlSurface, WhatIsNoSurfaceIsRefused) {
  const ScratchFolder folder;
  const auto complaint = [&](const std::string& text) -> std::string {
    try {
      read_xml_surface(folder.write("a.vtu", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(complaint(grid(1, "0 1 2 3", "4", "10")), HasSubstr("cell 0 is a Tetra"));
  EXPECT_THAT(complaint(grid(1, "0 1 2 3", "4", "5")),
              HasSubstr("a Triangle cannot have 4 points"));
  EXPECT_THAT(complaint(grid(1, "0 1 6", "3", "5")), HasSubstr("no such point (0 to 5"));
  EXPECT_THAT(complaint(grid(1, "0 1 -1", "3", "5")), HasSubstr("no such point"));
  EXPECT_THAT(complaint(grid(2, "0 1 2 0 1 3", "6 3", "5 5")), HasSubstr("wrong offsets"));
  EXPECT_THAT(complaint(grid(1, "0 1 2", "9", "5")), HasSubstr("connectivity"));
  EXPECT_THAT(complaint(grid(9, "0 1 2", "3", "5")), HasSubstr("offsets"));
  EXPECT_THAT(complaint(file("ImageData", "")), HasSubstr("ImageData found"));
  EXPECT_THAT(complaint("OFF\n"), HasSubstr("is not a surface of VTK"));
  EXPECT_THAT(complaint("<VTKFile type=\"a\nb\"></VTKFile>"),
              AllOf(HasSubstr("is not a surface of VTK"), Not(HasSubstr("\n"))));
  std::string ghosts = grid(1, "0 1 2", "3", "5");
  ghosts.insert(ghosts.find("<Points>"),
                "<CellData><DataArray type=\"UInt8\" Name=\"vtkGhostType\" format=\"ascii\">1"
                "</DataArray></CellData>");
  EXPECT_THAT(complaint(ghosts), HasSubstr("ghost cells"));
}

// Without a step that is asked for, the last one counts.
TEST(XmlSurface, OfSeveralStepsTheLastIsRead) {
  const ScratchFolder folder;
  const auto polys = [](const std::string& mark, const std::string& connectivity) {
    return "<DataArray" + mark + " type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" +
           connectivity + "</DataArray>";
  };
  const auto surface = [&](const std::string& times, const std::string& arrays) {
    std::string text = file(
        "PolyData",
        poly_data("NumberOfPolys=\"1\"",
                  "<Polys>" + arrays +
                      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray>"
                      "</Polys>"));
    const std::size_t at = text.find("<PolyData>") + 9;
    return read_xml_surface(
        folder.write("a.vtp", text.insert(at, " TimeValues=\"" + times + "\"")));
  };
  const XmlSurface last =
      surface("1 2.5", polys(" TimeStep=\"0\"", "0 1 2") + polys(" TimeStep=\"1\"", "3 1 2"));
  EXPECT_THAT(last.polygons, ElementsAre(ElementsAre(3, 1, 2)));
  EXPECT_THAT(last.notes, ElementsAre(HasSubstr("the last of 2 steps, time 2.5")));
  EXPECT_TRUE(surface("1", polys(" TimeStep=\"0\"", "0 1 2")).notes.empty());
}

TEST(XmlSurface, CellsThatCannotHaveSoManyPoints) {
  const ScratchFolder folder;
  const auto said = [&](int type, int count) -> std::string {
    std::string connectivity = "0";
    for (int i = 1; i < count; ++i) connectivity += fmt::format(" {}", i % 6);
    const std::string path =
        folder.write("a.vtu", grid(1, connectivity, std::to_string(count), std::to_string(type)));
    try {
      read_xml_surface(path);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path.size() + 2);
    }
    return "none";
  };
  struct Row {
    int type;
    const char* name;
    int count;
    bool more;  ///< any number from there on
  };
  for (const Row& row : {Row{5, "Triangle", 3, false},
                         {9, "Quad", 4, false},
                         {7, "Polygon", 3, true},
                         {8, "Pixel", 4, false},
                         {6, "TriangleStrip", 3, true},
                         {22, "QuadraticTriangle", 6, false},
                         {23, "QuadraticQuad", 8, false},
                         {28, "BiQuadraticQuad", 9, false}}) {
    EXPECT_EQ(said(row.type, row.count), "none") << row.name;
    EXPECT_EQ(said(row.type, row.count - 1),
              fmt::format("cell 0: a {} cannot have {} points", row.name, row.count - 1));
    EXPECT_EQ(said(row.type, row.count + 1),
              row.more
                  ? "none"
                  : fmt::format("cell 0: a {} cannot have {} points", row.name, row.count + 1));
  }
  for (const int type : {0, 1, 2, 3, 4, 21, 35, 68}) EXPECT_EQ(said(type, 2), "none") << type;
}

TEST(XmlSurface, OffsetsAndCountsThatDoNotFit) {
  const ScratchFolder folder;
  const auto said = [&](const std::string& text) -> std::string {
    const std::string path = folder.write("a.vtu", text);
    try {
      read_xml_surface(path);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path.size() + 2);
    }
    return "none";
  };
  const std::string wrong = "wrong offsets of the cells (rising numbers expected)";
  EXPECT_EQ(said(grid(2, "0 1 2 0 1 3", "3 6", "5 5")), "none");
  EXPECT_EQ(said(grid(2, "0 1 2 0 1 3", "6 3", "5 5")), wrong);
  EXPECT_EQ(said(grid(2, "0 1 2 0 1 3", "-3 3", "5 5")), wrong);
  EXPECT_EQ(said(grid(1, "0 1 2", "-3", "5")), wrong);
  EXPECT_EQ(said(grid(1, "0 1 2", "281474976710656", "5")), wrong);
  EXPECT_EQ(
      said(grid(1, "0 1 2", "281474976710655", "5")),
      "array 'connectivity': the data end too soon (281474976710655 values expected, 3 found)");
  EXPECT_EQ(said(grid(2, "0 1 2 0 1 6", "3 6", "5 5")),
            "cell 1: no such point (0 to 5 expected, 6 found)");
  EXPECT_EQ(said(grid(2, "0 1 2 0 1 3", "3 6", "5 10")),
            "cell 1 is a Tetra (a surface of triangles and polygons expected)");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = grid(1, "0 1 2", "3", "5");
    return said(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_EQ(changed("Name=\"offsets\"", "Name=\"ends\""),
            "a piece's cells have no array 'offsets'");
  EXPECT_EQ(changed("\"Int64\" Name=\"offsets\"", "\"Float64\" Name=\"offsets\""),
            "array 'offsets' of the cells does not hold single integers");
  EXPECT_EQ(changed("NumberOfComponents=\"3\"", "NumberOfComponents=\"2\""),
            "the points have 2 components (3 numbers expected)");
  EXPECT_EQ(changed("NumberOfPoints=\"6\"", "NumberOfPoints=\"4294967295\""),
            "has too many points (fewer than 2^32 expected)");
  EXPECT_THAT(changed("NumberOfPoints=\"6\"", "NumberOfPoints=\"4294967294\""),
              HasSubstr("the data end too soon (12884901882 values expected, 18 found)"));
}

// A bent sheet of quadrilaterals, large enough for several compressed blocks.
vtkSmartPointer<vtkPolyData> sheet(int precision) {
  constexpr int kSide = 60;
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(precision);
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) points->InsertNextPoint(0.5 * i, 0.25 * j, 0.125 * i * j);
  vtkNew<vtkCellArray> polygons;
  for (vtkIdType j = 0; j + 1 < kSide; ++j)
    for (vtkIdType i = 0; i + 1 < kSide; ++i) {
      const vtkIdType at = j * kSide + i;
      const std::array<vtkIdType, 4> corners{at, at + 1, at + kSide + 1, at + kSide};
      polygons->InsertNextCell(4, corners.data());
    }
  data->SetPoints(points);
  data->SetPolys(polygons);
  return data;
}

TEST(XmlSurface, EveryEncodingOfVtkGivesTheSameSurface) {
  const ScratchFolder folder;
  for (const int precision : {VTK_FLOAT, VTK_DOUBLE})
    for (const int order : {vtkXMLWriter::LittleEndian, vtkXMLWriter::BigEndian})
      for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4})
        for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended})
          for (const bool encoded : {true, false}) {
            SCOPED_TRACE(
                fmt::format("{} {} {} {} {}", precision, order, compressor, mode, encoded));
            const vtkSmartPointer<vtkPolyData> data = sheet(precision);
            vtkNew<vtkXMLPolyDataWriter> writer;
            writer->SetInputData(data);
            writer->SetFileName(folder.file("a.vtp").c_str());
            writer->SetByteOrder(order);
            writer->SetCompressorType(compressor);
            writer->SetDataMode(mode);
            writer->SetEncodeAppendedData(encoded ? 1 : 0);
            writer->Write();
            const XmlSurface surface = read_xml_surface(folder.file("a.vtp"));
            ASSERT_EQ(surface.xyz.size(), 3U * 3600);
            std::array<double, 3> p{};
            for (vtkIdType i = 0; i < 3600; ++i) {
              data->GetPoint(i, p.data());
              for (std::size_t c = 0; c < 3; ++c)
                ASSERT_EQ(surface.xyz[3 * static_cast<std::size_t>(i) + c], p[c]);
            }
            ASSERT_EQ(surface.polygons.size(), 59U * 59);
            EXPECT_THAT(surface.polygons.back(), ElementsAre(3538, 3539, 3599, 3598));
          }
}

TEST(SurfaceFile, XmlFilesAreSurfaces) {
  const ScratchFolder folder;
  EXPECT_TRUE(is_surface_file("a.VTP"));
  EXPECT_FALSE(is_surface_file("a.vtu"));
  EXPECT_TRUE(may_hold_surface("a.vtu"));
  EXPECT_FALSE(may_hold_surface("a.zoo"));
  const std::string path = folder.write("a.vtu", grid(3, "0 1 4 3 0 1 2 0 1", "4 7 9", "9 5 3"));
  const SurfaceReading reading = read_surface(path);
  EXPECT_EQ(reading.surface.points.size(), 6U);
  EXPECT_EQ(reading.surface.facets.size(), 3U);
  EXPECT_FALSE(reading.inner_facets);
  EXPECT_THAT(reading.notes,
              ElementsAre("left out 1 points and lines", "cut 1 polygons in triangles"));
  EXPECT_THAT([&] { read_surface(folder.write("b.vtu", grid(1, "0 1", "2", "3"))); },
              ThrowsMessage<InputError>(HasSubstr("holds no polygon")));
}

}  // namespace
}  // namespace hiac::formats

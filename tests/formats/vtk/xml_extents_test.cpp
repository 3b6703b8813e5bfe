// Structured files: extents, pieces of them, origins and coordinates.
#include <algorithm>

#include <fmt/format.h>

#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string extent_piece(const std::string& extent, const std::string& cells) {
  return fmt::format(
      "<Piece Extent=\"{}\"><CellData><DataArray type=\"Int32\" Name=\"c\" format=\"ascii\">{}"
      "</DataArray></CellData></Piece>",
      extent, cells);
}

std::string image_file(const std::string& whole, const std::string& pieces,
                       const std::string& place = "Origin=\"0 0 0\" Spacing=\"1 1 1\"") {
  return fmt::format(
      "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"{}\" {}>{}</ImageData></VTKFile>",
      whole, place, pieces);
}

/// The complaint about an image without the file's name.
std::string image_refusal(const std::string& text, const std::string& name = "a.vti") {
  const ScratchFolder folder;
  const std::string path = folder.write(name, text);
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}

TEST(XmlExtents, RiseAlongEachAxis) {
  const auto whole = [](const std::string& extent) {
    return image_refusal(image_file(extent, extent_piece(extent, "7")));
  };
  EXPECT_EQ(whole("0 1 0 1 0 1"), "");
  EXPECT_EQ(whole("-1 0 +5 6 \t7\n8"), "");
  EXPECT_EQ(whole("1 0 0 1 0 1"),
            "ImageData: wrong WholeExtent along x (rising numbers expected, 1 0 found)");
  EXPECT_EQ(whole("0 1 3 2 0 1"),
            "ImageData: wrong WholeExtent along y (rising numbers expected, 3 2 found)");
  EXPECT_EQ(whole("0 1 0 1 1073741824 1073741825"),
            "ImageData: wrong WholeExtent along z (rising numbers expected, 1073741824 1073741825 "
            "found)");
  EXPECT_EQ(whole("-1073741825 -1073741824 0 1 0 1"),
            "ImageData: wrong WholeExtent along x (rising numbers expected, -1073741825 "
            "-1073741824 found)");
  EXPECT_EQ(whole("0 1 1073741823 1073741824 0 1"), "");
  EXPECT_EQ(whole("0 1 -1073741824 -1073741823 0 1"), "");
  EXPECT_EQ(whole("0 1 0 1 0"),
            "ImageData: wrong WholeExtent (6 numbers expected, '0 1 0 1 0' found)");
  EXPECT_EQ(whole("+-1 0 0 1 0 1"),
            "ImageData: wrong WholeExtent (6 numbers expected, '+-1 0 0 1 0 1' found)");
  EXPECT_EQ(whole(std::string(70, 'x')), "ImageData: wrong WholeExtent (6 numbers expected, '" +
                                             std::string(60, 'x') + "' found)");
  const std::string flat = "holds no volume cells (2 or more points along each axis expected)";
  EXPECT_EQ(whole("3 3 0 1 0 1"), flat);
  EXPECT_EQ(whole("0 1 3 3 0 1"), flat);
  EXPECT_EQ(image_refusal(image_file("0 1 0 1 0 1", extent_piece("0 1 0 1 1 0", "7"))),
            "Piece: wrong Extent along z (rising numbers expected, 1 0 found)");
}

TEST(XmlExtents, PointsAreFewerThanTwoToTheThirtySecond) {
  const auto whole = [](const std::string& extent) {
    return image_refusal(image_file(extent, extent_piece("0 1 0 1 0 1", "7")));
  };
  // 65536 * 32768 * 2 points, and a layer less
  EXPECT_EQ(whole("0 65535 0 32767 0 1"), "has too many points (fewer than 2^32 expected)");
  EXPECT_EQ(whole("0 65534 0 32767 0 1"),
            "the pieces do not cover the whole extent (2147352578 cells expected, 1 found)");
}

TEST(XmlExtents, PiecesCoverTheWholeOnce) {
  const auto of = [](const std::string& pieces) {
    return image_refusal(image_file("0 2 0 1 0 1", pieces));
  };
  const std::string left = extent_piece("0 1 0 1 0 1", "7");
  const std::string right = extent_piece("1 2 0 1 0 1", "8");
  EXPECT_EQ(of(left + right), "");
  EXPECT_EQ(of(right + left), "");
  EXPECT_EQ(of(""), "the pieces do not cover the whole extent (2 cells expected, 0 found)");
  EXPECT_EQ(of(left), "the pieces do not cover the whole extent (2 cells expected, 1 found)");
  EXPECT_EQ(of(left + right + right), "pieces 1 and 2 overlap");
  EXPECT_EQ(of(left + extent_piece("0 2 0 1 0 1", "7 8")), "pieces 0 and 1 overlap");
  EXPECT_EQ(of(left + extent_piece("2 3 0 1 0 1", "8")), "piece 1 reaches beyond the whole extent");
  EXPECT_EQ(of(extent_piece("-1 1 0 1 0 1", "7 8") + right),
            "piece 0 reaches beyond the whole extent");
  EXPECT_EQ(of(extent_piece("0 2 0 1 -1 0", "7 8")), "piece 0 reaches beyond the whole extent");
  EXPECT_EQ(of(extent_piece("0 2 1 2 0 1", "7 8")), "piece 0 reaches beyond the whole extent");
  EXPECT_EQ(of(left + "<Piece Extent=\"1 2 0 1 0 1\"><PointData/></Piece>"),
            "a piece holds no data, only its extent");
  // a piece without cells covers nothing and is in nobody's way
  EXPECT_THAT(of(left + right + extent_piece("1 1 0 1 0 1", "")), Not(HasSubstr("overlap")));
}

TEST(XmlExtents, CellsAreWhereTheirPieceIs) {
  const ScratchFolder folder;
  const ZooMesh mesh =
      read_any(folder.write("a.vti", image_file("1 3 2 3 5 6",
                                                extent_piece("2 3 2 3 5 6", "8") +
                                                    extent_piece("1 2 2 3 5 6", "7"),
                                                "Origin=\"10 20 30\" Spacing=\"0.5 2 -1\"")))
          .mesh;
  ASSERT_EQ(mesh.cell_count(), 2U);
  EXPECT_EQ(mesh.node_count(), 12U);
  for (CellId cell = 0; cell < 2; ++cell) {
    double lowest = 1e9;
    for (const NodeId node : mesh.cell_nodes(cell))
      lowest = std::min(lowest, mesh.position(node)[0]);
    EXPECT_EQ(lowest, field_named(mesh, "c").values[cell] == 7 ? 10.5 : 11);
  }
  EXPECT_THAT(mesh.position(0), ElementsAre(10.5, 24, 25));
}

TEST(XmlExtents, TenThousandPiecesAndNoMore) {
  std::string pieces;
  for (int i = 0; i < 10000; ++i) pieces += extent_piece("0 1 0 1 0 1", "7");
  EXPECT_EQ(image_refusal(image_file("0 1 0 1 0 1", pieces)), "pieces 0 and 1 overlap");
  pieces += extent_piece("0 1 0 1 0 1", "7");
  EXPECT_EQ(image_refusal(image_file("0 1 0 1 0 1", pieces)),
            "has too many pieces (at most 10000 expected, 10001 found)");
}

TEST(XmlExtents, OriginsAndSpacingsAreNumbers) {
  const auto placed = [](const std::string& place) {
    return image_refusal(image_file("0 1 0 1 0 1", extent_piece("0 1 0 1 0 1", "7"), place));
  };
  EXPECT_EQ(placed("Origin=\"0 0 0\" Spacing=\"1 -1 1e-9\""), "");
  EXPECT_EQ(placed("Origin=\"0 0 0\" Spacing=\"1 0 1\""),
            "wrong Spacing (finite numbers expected, 0 found)");
  EXPECT_EQ(placed("Origin=\"0 inf 0\" Spacing=\"1 1 1\""),
            "wrong Origin (finite numbers expected, inf found)");
  EXPECT_EQ(placed("Origin=\"0 0 0\" Spacing=\"1 1 nan\""),
            "wrong Spacing (finite numbers expected, nan found)");
  EXPECT_EQ(placed("Origin=\"0 0\" Spacing=\"1 1 1\""),
            "ImageData: wrong Origin (3 numbers expected, '0 0' found)");
  EXPECT_EQ(placed("Origin=\"0 0 0\""), "ImageData: wrong Spacing (3 numbers expected, '' found)");
}

std::string axis_array(const std::string& values) {
  return "<DataArray type=\"Float64\" format=\"ascii\">" + values + "</DataArray>";
}

std::string axes_file(const std::string& coordinates) {
  return "<VTKFile type=\"RectilinearGrid\"><RectilinearGrid WholeExtent=\"0 1 0 2 0 3\"><Piece "
         "Extent=\"0 1 0 2 0 3\"><Coordinates>" +
         coordinates +
         "</Coordinates><CellData><DataArray type=\"Int8\" Name=\"c\" format=\"ascii\">1 2 3 4 5 6"
         "</DataArray></CellData></Piece></RectilinearGrid></VTKFile>";
}

TEST(XmlExtents, CoordinatesOfThreeAxes) {
  const std::string x = axis_array("0 1");
  const std::string y = axis_array("0 1 2");
  const std::string z = axis_array("0 1 2 3");
  EXPECT_EQ(image_refusal(axes_file(x + y + z), "a.vtr"), "");
  EXPECT_EQ(image_refusal(axes_file(x + y), "a.vtr"),
            "a piece has 2 arrays of coordinates (3 expected)");
  EXPECT_EQ(image_refusal(axes_file(x + y + z + z), "a.vtr"),
            "a piece has 4 arrays of coordinates (3 expected)");
  EXPECT_EQ(image_refusal(axes_file(x + x + z), "a.vtr"),
            "array '': the data end too soon (3 values expected, 2 found)");
  EXPECT_EQ(image_refusal(axes_file(x + y + axis_array("0 1 2 inf")), "a.vtr"),
            "array '': wrong value 3 (a number of its type expected, 'inf' found)");
}

TEST(XmlExtents, ValuesThatAreNotFiniteInPieces) {
  const auto piece = [](const char* extent, const char* value) {
    return fmt::format(
        "<Piece Extent=\"{}\"><CellData><DataArray type=\"Float32\" Name=\"c\" format=\"ascii\">{}"
        "</DataArray></CellData></Piece>",
        extent, value);
  };
  EXPECT_EQ(image_refusal(image_file("0 1 0 1 0 1", piece("0 1 0 1 0 1", "nan"))), "");
  EXPECT_EQ(image_refusal(
                image_file("0 2 0 1 0 1", piece("0 1 0 1 0 1", "7") + piece("1 2 0 1 0 1", "nan"))),
            "array 'c': values that are not finite cannot be read from several pieces");
}

}  // namespace
}  // namespace hiac::formats

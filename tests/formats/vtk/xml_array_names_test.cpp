// Arrays of VTK's XML files by their names: several with one name, none, and pieces whose arrays
// differ. VTK itself assigns arrays by their places.
#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string ascii_array(const std::string& attributes, const std::string& values) {
  return "<DataArray format=\"ascii\" " + attributes + ">" + values + "</DataArray>";
}

std::string named_array(const std::string& name, const std::string& values,
                        const std::string& more = "") {
  return ascii_array("type=\"Float64\" Name=\"" + name + "\" " + more, values);
}

/// A tetrahedron; the pieces of a mesh lie behind one another along x.
std::string tetrahedron(const std::string& point_data, const std::string& cell_data = "",
                        int x = 0) {
  return fmt::format(
      "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>{}</Points><Cells>{}{}{}</Cells>"
      "<PointData>{}</PointData><CellData>{}</CellData></Piece>",
      ascii_array("type=\"Float64\" NumberOfComponents=\"3\"",
                  fmt::format("{0} 0 0 {1} 0 0 {0} 1 0 {0} 0 1", x, x + 1)),
      ascii_array("type=\"Int64\" Name=\"connectivity\"", "0 1 2 3"),
      ascii_array("type=\"Int64\" Name=\"offsets\"", "4"),
      ascii_array("type=\"UInt8\" Name=\"types\"", "10"), point_data, cell_data);
}

std::string vtu_of(const std::string& pieces, const std::string& attributes = "",
                   const std::string& behind = "") {
  return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid" + attributes + ">" + pieces +
         "</UnstructuredGrid>" + behind + "</VTKFile>";
}

const std::string kNote = "several arrays have the name 'a': the last is read";

TEST(XmlArrayNames, OfArraysWithOneNameTheLastIsRead) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "a.vtu", vtu_of(tetrahedron(named_array("a", "1 nan 3 4") + named_array("b", "6 6 6 inf") +
                                      "<!-- of old -->" + named_array("a", "0 0 0 0") +
                                      named_array("a", "5 nan 7 8"),
                                  named_array("a", "9"))));
  const Reading reading = read_any(path);
  ASSERT_EQ(reading.mesh.fields.size(), 3U);
  EXPECT_THAT(field_named(reading.mesh, "b").values.view(), ElementsAre(6, 6, 6, INFINITY));
  EXPECT_THAT(reading.mesh.fields[1].values.view(), ElementsAre(5, testing::IsNan(), 7, 8));
  EXPECT_THAT(reading.mesh.fields[2].values.view(), ElementsAre(9));
  EXPECT_EQ(std::count(reading.notes.begin(), reading.notes.end(), kNote), 1);
  const Inventory inventory = format_to_read(path).inspect(path);
  EXPECT_EQ(inventory.fields.size(), 3U);
  EXPECT_THAT(inventory.notes, Contains(kNote));
}

TEST(XmlArrayNames, ArraysWithOneNameMayDiffer) {
  const ScratchFolder folder;
  const std::string wide = named_array("a", "1 2 3", "NumberOfComponents=\"3\"");
  const std::string text = ascii_array("type=\"String\" Name=\"a\"", "65 0");
  for (const auto& [first, second, components] : {std::tuple{wide, named_array("a", "8"), 1U},
                                                  {named_array("a", "8"), wide, 3U},
                                                  {text, wide, 3U}}) {
    const Reading reading =
        read_any(folder.write("a.vtu", vtu_of(tetrahedron("", first + second))));
    ASSERT_EQ(reading.mesh.fields.size(), 1U);
    EXPECT_EQ(reading.mesh.fields[0].components, components);
    EXPECT_EQ(reading.mesh.fields[0].values[0], components == 1 ? 8 : 1);
    EXPECT_THAT(reading.notes, Contains(kNote));
  }
}

TEST(XmlArrayNames, EveryPieceHasItsLastArray) {
  const ScratchFolder folder;
  const auto twice = [](const std::string& values) {
    return named_array("a", "0 0 0 0") + named_array("a", values);
  };
  const Reading reading = read_any(folder.write(
      "a.vtu", vtu_of(tetrahedron(twice("1 2 3 4")) + tetrahedron(twice("5 6 7 8"), "", 5))));
  EXPECT_THAT(field_named(reading.mesh, "a").values.view(), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_EQ(std::count(reading.notes.begin(), reading.notes.end(), kNote), 1);
}

TEST(XmlArrayNames, OfStepsAndAppendedData) {
  const ScratchFolder folder;
  const auto appended = [](const std::string& more) {
    return "<DataArray type=\"UInt8\" Name=\"a\" format=\"appended\" " + more + "/>";
  };
  std::string data = "_";
  for (const char value : {'\1', '\2', '\3'})
    data += std::string("\4\0\0\0", 4) + std::string(4, value);
  const std::string path =
      folder.write("a.vtu", vtu_of(tetrahedron(appended("TimeStep=\"0\" offset=\"0\"") +
                                               appended("TimeStep=\"1\" offset=\"8\"") +
                                               appended("TimeStep=\"1\" offset=\"16\"")),
                                   " TimeValues=\"0 1\"",
                                   "<AppendedData encoding=\"raw\">" + data + "</AppendedData>"));
  ReadOptions first;
  first.step = 0;
  const Reading one = read_any(path, first);
  EXPECT_EQ(field_named(one.mesh, "a").values[3], 1);
  EXPECT_THAT(one.notes, Not(Contains(kNote)));
  const Reading two = read_any(path);
  EXPECT_EQ(field_named(two.mesh, "a").values[3], 3);
  EXPECT_THAT(two.notes, Contains(kNote));
}

TEST(XmlArrayNames, CharactersMayBeEscaped) {
  const ScratchFolder folder;
  const Reading reading = read_any(
      folder.write("a.vtu", vtu_of(tetrahedron(named_array("p&amp;&lt;q&#62;", "1 nan 3 4")))));
  EXPECT_THAT(field_named(reading.mesh, "p&<q>").values.view(),
              ElementsAre(1, testing::IsNan(), 3, 4));
  const Reading twice = read_any(folder.write(
      "a.vtu", vtu_of(tetrahedron(named_array("a", "1 2 3 4") + named_array("&#97;", "5 6 7 8")))));
  EXPECT_THAT(field_named(twice.mesh, "a").values.view(), ElementsAre(5, 6, 7, 8));
  EXPECT_THAT(twice.notes, Contains(kNote));
}

TEST(XmlArrayNames, ArraysNeedNames) {
  const ScratchFolder folder;
  const auto said = [&](const std::string& pieces) -> std::string {
    const std::string path = folder.write("a.vtu", vtu_of(pieces));
    return refusal(path).substr(path.size());
  };
  const std::string a = named_array("a", "1 2 3 4");
  EXPECT_EQ(said(tetrahedron(a + ascii_array("type=\"Float64\"", "1 2 3 4"))),
            ": piece 0: array 1 of its PointData has no name");
  EXPECT_EQ(said(tetrahedron("") + tetrahedron("", named_array("", "1"), 5)),
            ": piece 1: array 0 of its CellData has no name");
}

TEST(XmlArrayNames, PiecesHaveTheirArraysInOneOrder) {
  const ScratchFolder folder;
  const std::string a = named_array("a", "1 2 3 4");
  const std::string b = named_array("b", "5 6 7 8");
  const Reading reading =
      read_any(folder.write("a.vtu", vtu_of(tetrahedron(a + b) + tetrahedron(a + b, "", 5))));
  EXPECT_THAT(field_named(reading.mesh, "a").values.view(), ElementsAre(1, 2, 3, 4, 1, 2, 3, 4));
  const std::string path =
      folder.write("b.vtu", vtu_of(tetrahedron(a + b) + tetrahedron(b + a, "", 5)));
  EXPECT_EQ(refusal(path), path + ": its pieces do not carry the same arrays in the same order");
}

}  // namespace
}  // namespace hiac::formats

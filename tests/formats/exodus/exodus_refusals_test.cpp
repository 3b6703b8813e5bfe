// Exodus files whose variables do not fit one another, written byte by byte: the whole complaint,
// and the nearest file that is read.

#include <tuple>

#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/exodus/classic_file.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::string exodus_refusal(const ClassicFile& file) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.exo", file.bytes());
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}

Reading exodus_reading(const ClassicFile& file) {
  const ScratchFolder folder;
  return read_any(folder.write("a.exo", file.bytes()));
}

/// The unit tetrahedron; what a test adds to it uses the numbers of the dimensions.
struct OneTetrahedron {
  explicit OneTetrahedron(unsigned version = 1) : file(version) {
    nodes = file.dimension("num_nodes", 4);
    three = file.dimension("num_dim", 3);
    one = file.dimension("num_el_blk", 1);
    file.doubles("coordx", {nodes}, {0, 1, 0, 0});
    file.doubles("coordy", {nodes}, {0, 0, 1, 0});
    file.doubles("coordz", {nodes}, {0, 0, 0, 1});
    file.ints("connect1", {one, nodes}, {1, 2, 3, 4}, "TETRA");
  }
  ClassicFile file;
  std::size_t nodes;
  std::size_t three;
  std::size_t one;
};

TEST(ExodusRefusals, FilesOfEveryVersion) {
  for (const unsigned version : {1, 2, 5}) {
    const OneTetrahedron made(version);
    expect_unit_tetrahedron(exodus_reading(made.file).mesh);
  }
  const ScratchFolder folder;
  EXPECT_THAT(read_any(folder.write("a.exo", OneTetrahedron().file.bytes() + "stray")).notes,
              Contains("5 bytes behind the end of the netCDF file's data are not read"));
}

TEST(ExodusRefusals, FilesWithoutAMesh) {
  ClassicFile other;
  other.doubles("temperature", {other.dimension("x", 2)}, {1, 2});
  EXPECT_EQ(exodus_refusal(other), "is a netCDF file without a mesh of the Exodus II model");
  ClassicFile nodes;
  nodes.dimension("num_nodes", 4);
  EXPECT_EQ(exodus_refusal(nodes),
            "holds no volume cells (dropped 4 points that no converted cell uses)");
  ClassicFile dimensions;
  dimensions.dimension("num_dim", 4);
  EXPECT_EQ(exodus_refusal(dimensions), "num_dim: is 4 (1 to 3 expected)");
  dimensions = ClassicFile();
  dimensions.dimension("num_dim", 3);
  EXPECT_EQ(exodus_refusal(dimensions), "holds no cells");
}

TEST(ExodusRefusals, CoordinatesThatDoNotFit) {
  ClassicFile file;
  const std::size_t nodes = file.dimension("num_nodes", 4);
  file.dimension("num_dim", 2);
  file.doubles("coordx", {nodes}, {0, 1, 0, 0});
  EXPECT_EQ(exodus_refusal(file), "coordy: is not there");
  file.doubles("coordy", {file.dimension("five", 5)}, {0, 1, 0, 0, 0});
  EXPECT_EQ(exodus_refusal(file), "coordy: holds 5 coordinates (4 expected)");

  ClassicFile together;
  const std::size_t four = together.dimension("num_nodes", 4);
  together.doubles("coord", {together.dimension("num_dim", 2), four}, {0, 1, 0, 0, 0, 0, 1, 0});
  EXPECT_THAT(exodus_refusal(together), HasSubstr("holds no volume cells"));
  ClassicFile wrong;
  wrong.dimension("num_nodes", 4);
  const std::size_t three = wrong.dimension("three", 3);
  wrong.doubles("coord", {wrong.dimension("num_dim", 2), three}, {0, 1, 0, 0, 0, 0});
  EXPECT_EQ(exodus_refusal(wrong), "coord: does not have the extents that the mesh asks for");
}

TEST(ExodusRefusals, NamesAreRowsOfCharacters) {
  OneTetrahedron made;
  const std::size_t width = made.file.dimension("len_string", 6);
  OneTetrahedron numbers = made;
  numbers.file.ints("eb_names", {numbers.one, width}, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(exodus_refusal(numbers.file), "eb_names: holds no names");
  OneTetrahedron row = made;
  row.file.variable("eb_names", {width}, 2, "solid ");
  EXPECT_EQ(exodus_refusal(row.file), "eb_names: holds no names");
  made.file.variable("eb_names", {made.one, width}, 2, "solid ");
  const ScratchFolder folder;
  const std::string path = folder.write("a.exo", made.file.bytes());
  EXPECT_THAT(format_to_read(path).inspect(path).blocks, ElementsAre("solid"));
}

TEST(ExodusRefusals, BlocksWithoutNamesHaveTheirIds) {
  const auto blocks = [](OneTetrahedron made, const std::string& name,
                         const std::vector<std::int32_t>& ids) {
    if (!name.empty())
      made.file.variable("eb_names", {made.one, made.file.dimension("len_string", name.size())}, 2,
                         name);
    if (!ids.empty()) made.file.ints("eb_prop1", {made.one}, ids);
    const ScratchFolder folder;
    const std::string path = folder.write("a.exo", made.file.bytes());
    return format_to_read(path).inspect(path).blocks;
  };
  EXPECT_THAT(blocks(OneTetrahedron(), "", {}), ElementsAre("1"));
  EXPECT_THAT(blocks(OneTetrahedron(), "", {77}), ElementsAre("77"));
  EXPECT_THAT(blocks(OneTetrahedron(), "   ", {77}), ElementsAre("77"));
  EXPECT_THAT(blocks(OneTetrahedron(), std::string("ab\0cd", 5), {77}), ElementsAre("ab"));
}

/// A polyhedron of four triangles, faces 1 to 4; each of the lists can be another one.
struct OnePolyhedron {
  std::vector<std::int32_t> corners{1, 3, 2, 1, 2, 4, 2, 3, 4, 3, 1, 4};
  std::vector<std::int32_t> corner_counts{3, 3, 3, 3};
  std::vector<std::int32_t> faces{1, 2, 3, 4};
  std::vector<std::int32_t> face_counts{4};

  [[nodiscard]] ClassicFile file(std::size_t blocks = 1) const {
    ClassicFile made;
    const std::size_t nodes = made.dimension("num_nodes", 4);
    made.dimension("num_dim", 3);
    made.dimension("num_el_blk", blocks);
    made.dimension("num_fa_blk", 1);
    made.doubles("coordx", {nodes}, {0, 1, 0, 0});
    made.doubles("coordy", {nodes}, {0, 0, 1, 0});
    made.doubles("coordz", {nodes}, {0, 0, 0, 1});
    made.ints("fbconn1", {made.dimension("a", corners.size())}, corners);
    made.ints("fbepecnt1", {made.dimension("b", corner_counts.size())}, corner_counts);
    made.ints("facconn1", {made.dimension("c", faces.size())}, faces);
    made.ints("ebepecnt1", {made.dimension("d", face_counts.size())}, face_counts);
    return made;
  }
};

TEST(ExodusRefusals, FacesOfPolyhedra) {
  EXPECT_EQ(exodus_refusal(OnePolyhedron().file()), "");
  EXPECT_EQ(exodus_reading(OnePolyhedron().file()).mesh.cell_count(), 1U);
  OnePolyhedron made;
  made.faces[2] = 0;
  EXPECT_EQ(exodus_refusal(made.file()), "facconn1: names face 0 (1 to 4 expected)");
  made.faces[2] = 5;
  EXPECT_EQ(exodus_refusal(made.file()), "facconn1: names face 5 (1 to 4 expected)");
  made = {};
  made.face_counts = {5};
  EXPECT_EQ(exodus_refusal(made.file()), "ebepecnt1: does not fit 'facconn1' (4 numbers)");
  made.face_counts = {-1};
  EXPECT_EQ(exodus_refusal(made.file()), "ebepecnt1: does not fit 'facconn1' (4 numbers)");
  made = {};
  made.corner_counts = {3, 3, 3, 4};
  EXPECT_EQ(exodus_refusal(made.file()), "fbepecnt1: does not fit 'fbconn1' (12 numbers)");
  made = {};
  made.corner_counts = {3, 3, 3, 3, 0};  // no cell uses the last face
  EXPECT_EQ(exodus_refusal(made.file()), "");
  made = {};
  made.faces = {1, 2, 3, 4, 1, 2, 3, 4};
  made.face_counts = {4, 4};
  EXPECT_EQ(exodus_refusal(made.file()), "");
  made.faces = {1, 2, 3, 4, 1, 2, 3, 4, 4};
  made.face_counts = {4, 5};
  EXPECT_EQ(exodus_refusal(made.file()), "facconn1: names face 4 more than twice");
}

TEST(ExodusRefusals, FacesAreSharedByTheCellsOfAllBlocks) {
  ClassicFile made = OnePolyhedron().file(2);
  made.ints("facconn2", {made.dimension("e", 4)}, {4, 3, 2, 1});
  made.ints("ebepecnt2", {made.dimension("f", 1)}, {4});
  EXPECT_EQ(exodus_reading(made).mesh.cell_count(), 2U);
  ClassicFile third = OnePolyhedron().file(3);
  for (const std::string block : {"2", "3"}) {
    third.ints("facconn" + block, {third.dimension("e" + block, 4)}, {4, 3, 2, 1});
    third.ints("ebepecnt" + block, {third.dimension("f" + block, 1)}, {4});
  }
  EXPECT_EQ(exodus_refusal(third), "facconn3: names face 4 more than twice");
}

// Faces of one number of corners may stand in rows.
TEST(ExodusRefusals, FacesInRows) {
  ClassicFile made;
  const std::size_t nodes = made.dimension("num_nodes", 4);
  const std::size_t three = made.dimension("num_dim", 3);
  const std::size_t one = made.dimension("num_el_blk", 1);
  made.dimension("num_fa_blk", 1);
  made.doubles("coordx", {nodes}, {0, 1, 0, 0});
  made.doubles("coordy", {nodes}, {0, 0, 1, 0});
  made.doubles("coordz", {nodes}, {0, 0, 0, 1});
  made.ints("fbconn1", {nodes, three}, {1, 3, 2, 1, 2, 4, 2, 3, 4, 3, 1, 4});
  made.ints("facconn1", {one, nodes}, {1, 2, 3, 4});
  const Reading reading = exodus_reading(made);
  ASSERT_EQ(reading.mesh.cell_count(), 1U);
  EXPECT_NEAR(volume_of(reading.mesh, 0), 1.0 / 6, 1e-15);
  EXPECT_THAT(reading.notes, Contains(HasSubstr("1 polyhedra have the faces")));
}

TEST(ExodusRefusals, PolygonsHaveNoVolume) {
  // a second block, whose corners stand in one row
  ClassicFile two;
  const std::size_t nodes = two.dimension("num_nodes", 4);
  two.dimension("num_dim", 3);
  const std::size_t one = two.dimension("one", 1);
  two.dimension("num_el_blk", 2);
  two.doubles("coordx", {nodes}, {0, 1, 0, 0});
  two.doubles("coordy", {nodes}, {0, 0, 1, 0});
  two.doubles("coordz", {nodes}, {0, 0, 0, 1});
  two.ints("connect1", {one, nodes}, {1, 2, 3, 4}, "TETRA");
  two.ints("connect2", {two.dimension("six", 6)}, {1, 2, 3, 1, 2, 4}, "nsided");
  two.ints("ebepecnt2", {two.dimension("two", 2)}, {3, 3});
  const Reading reading = exodus_reading(two);
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, Contains("dropped cells without volume: 2 nsided"));
}

TEST(ExodusRefusals, StepsThatAreNotWhole) {
  OneTetrahedron made;
  const std::size_t time = made.file.dimension("time_step", 2);
  const std::size_t width = made.file.dimension("len_string", 2);
  made.file.doubles("time_whole", {time}, {0.5, 2});
  made.file.variable("name_nod_var", {made.one, width}, 2, "p ");
  OneTetrahedron whole = made;
  whole.file.doubles("vals_nod_var1", {time, whole.nodes}, {1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_EQ(field_named(exodus_reading(whole.file).mesh, "p").values[3], 8);
  OneTetrahedron part = made;
  part.file.doubles("vals_nod_var1", {part.one, part.nodes}, {1, 2, 3, 4});
  EXPECT_EQ(exodus_refusal(part.file),
            "vals_nod_var1: does not have the extents that the mesh asks for");
  OneTetrahedron narrow = made;
  narrow.file.doubles("vals_nod_var1", {time, narrow.three}, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(exodus_refusal(narrow.file),
            "vals_nod_var1: does not have the extents that the mesh asks for");
  OneTetrahedron flat = made;
  flat.file.doubles("vals_nod_var1", {time}, {1, 2});
  EXPECT_EQ(exodus_refusal(flat.file),
            "vals_nod_var1: does not have the extents that the mesh asks for");
}

std::vector<std::string> field_names(const ZooMesh& mesh) {
  std::vector<std::string> names;
  for (const Field& field : mesh.fields) names.push_back(field.name);
  return names;
}

// A variable is listed by its name even where the file holds no value of it.
TEST(ExodusRefusals, VariablesWithoutANameOrWithoutValues) {
  OneTetrahedron made;
  const std::size_t time = made.file.dimension("time_step", 2);
  const std::size_t two = made.file.dimension("two", 2);
  const std::size_t width = made.file.dimension("len_string", 3);
  made.file.doubles("time_whole", {time}, {0.5, 2});
  made.file.variable("name_nod_var", {two, width}, 2, "abs   ");
  made.file.variable("name_elem_var", {two, width}, 2, "   abs");
  made.file.doubles("vals_nod_var2", {time, made.nodes}, {1, 2, 3, 4, 5, 6, 7, 8});
  made.file.doubles("vals_elem_var1eb1", {time, made.one}, {9, 10});
  const ScratchFolder folder;
  const std::string path = folder.write("a.exo", made.file.bytes());
  for (const std::size_t step : {0, 1}) {
    ReadOptions options;
    options.step = step;
    const Reading reading = read_any(path, options);
    EXPECT_THAT(field_names(reading.mesh), ElementsAre("variable 2", "variable 1"));
    EXPECT_EQ(field_named(reading.mesh, "variable 2").values[3], step == 0 ? 4 : 8);
    EXPECT_EQ(field_named(reading.mesh, "variable 1").values[0], step == 0 ? 9 : 10);
    EXPECT_THAT(reading.notes, testing::Not(Contains(HasSubstr("absent"))));
  }
}

TEST(ExodusRefusals, VariablesOfEveryNumberType) {
  // 1 byte, 3 short, 4 int, 5 float, 6 double, 7 to 9 unsigned, 10 and 11 of eight bytes
  const std::vector<std::tuple<std::uint32_t, std::size_t, std::string>> types{
      {1, 1, "int8"}, {3, 2, "int16"}, {4, 4, "int32"}, {5, 4, "float"},  {6, 8, "double"},
      {7, 1, "int8"}, {8, 2, "int16"}, {9, 4, "int32"}, {10, 8, "int64"}, {11, 8, "int64"}};
  const ScratchFolder folder;
  for (const auto& [type, bytes, name] : types) {
    OneTetrahedron made(5);
    const std::size_t width = made.file.dimension("len_string", 1);
    made.file.doubles("time_whole", {made.one}, {0.5});
    made.file.variable("name_nod_var", {made.one, width}, 2, "p");
    made.file.variable("name_elem_var", {made.one, width}, 2, "c");
    made.file.variable("vals_nod_var1", {made.one, made.nodes}, type, std::string(4 * bytes, '\0'));
    made.file.variable("vals_elem_var1eb1", {made.one, made.one}, type, std::string(bytes, '\0'));
    const std::string path = folder.write("a.exo", made.file.bytes());
    const Inventory inventory = format_to_read(path).inspect(path);
    ASSERT_EQ(inventory.fields.size(), 2U) << type;
    for (const FieldSummary& field : inventory.fields) EXPECT_EQ(field.type, name) << type;
    EXPECT_EQ(inventory.fields[0].tuples, 4U);
    EXPECT_EQ(inventory.fields[1].tuples, 1U);
  }
}

TEST(ExodusRefusals, FilesThatTheLibraryCannotOpen) {
  // the last number of the header says that the last variable begins in the header
  ClassicFile file;
  const std::size_t nodes = file.dimension("num_nodes", 4);
  file.ints("connect1", {nodes}, {1, 2, 3, 4}, "TETRA");
  std::string bytes = file.bytes();
  bytes.replace(bytes.size() - 20, 4, ClassicFile::big_endian(4, 4));
  const ScratchFolder folder;
  const std::string path = folder.write("a.exo", bytes);
  EXPECT_THAT(refusal(path), testing::StartsWith(path + ": is no whole netCDF file (NetCDF: "));
}

}  // namespace
}  // namespace hiac::formats

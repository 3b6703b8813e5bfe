// What real cases of several files hold beside what their formats' descriptions need.
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// ---- OpenFOAM

std::string foam(const std::string& type, const std::string& body) {
  return "/* a banner */\nFoamFile\n{\n    version 2.0;\n    format ascii;\n    class " + type +
         ";\n    note \"nPoints: 4; nCells: 1\";\n    meta { a 1; b { c 2; } }\n}\n" + body;
}

/// The unit tetrahedron as a case.
class FoamCase {
 public:
  FoamCase() {
    write("a.foam", "");
    write("constant/polyMesh/points",
          foam("vectorField", "4\n((0 0 0)\n(1 0 0)\n(0 1 0)\n(0 0 1))\n"));
    write("constant/polyMesh/faces",
          foam("faceList", "( 3(0 2 1) 3(0 1 3) 3(0 3 2) 3(1 2 3) ) // no count\n"));
    write("constant/polyMesh/owner", foam("labelList", "4{0}\n"));
    write("constant/polyMesh/neighbour", foam("labelList", "0()\n"));
  }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(file(name)).parent_path());
    static_cast<void>(folder_.write(name, text));
  }
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

 private:
  ScratchFolder folder_;
};

TEST(OpenFoamHabits, EqualEntriesAreWrittenOnceAndMacrosLeftOut) {
  const FoamCase folder;
  folder.write("0/p", foam("volScalarField",
                           "dimensions [0 2 -2 0 0 0 0];\n"
                           "internalField nonuniform List<scalar> 1{2.5};\n"));
  folder.write("0/U", foam("volVectorField",
                           "#include \"initial\"\nspeed (1 2 3);\n"
                           "internalField uniform $speed;\n"));
  folder.write("0/k", foam("volScalarField", "internalField uniform $ofAnIncludedFile;\n"));
  folder.write("0/notes.txt", "nothing\n");
  const Reading reading = read_any(folder.file("a.foam"));
  EXPECT_EQ(reading.mesh.cell_count(), 1U);
  EXPECT_EQ(scalar_field(reading.mesh, "p").values[0], 2.5);
  const auto named_u = [](const Field& field) { return field.name == "U"; };
  const auto u = std::find_if(reading.mesh.fields.begin(), reading.mesh.fields.end(), named_u);
  ASSERT_NE(u, reading.mesh.fields.end());
  EXPECT_THAT(u->values.view(), ElementsAre(1, 2, 3));
  EXPECT_THAT(reading.notes, Contains(HasSubstr("left out 'k'")));
  EXPECT_THAT(reading.notes, Contains(HasSubstr("left out 'notes.txt'")));
  folder.write("0/p", foam("volScalarField", "internalField nonuniform List<scalar> 99999{1};\n"));
  EXPECT_THAT(refusal(folder.file("a.foam")), HasSubstr("a count that fits"));
}

TEST(OpenFoamHabits, MeshesMoveAndAnyFileOfTheCaseNamesIt) {
  const FoamCase folder;
  folder.write("0.5/polyMesh/points", foam("vectorField", "4((0 0 0)(1 0 0)(0 1 0)(0 0 2))\n"));
  folder.write("0.25/p", foam("volScalarField", "internalField uniform 1;\n"));
  folder.write("1/p", foam("volScalarField", "internalField uniform 3;\n"));
  const auto height = [&](double time) {
    ReadOptions options;
    options.time = time;
    const ZooMesh mesh = read_any(folder.file("constant/polyMesh/faces"), options).mesh;
    double top = 0;
    for (NodeId node = 0; node < mesh.node_count(); ++node)
      top = std::max(top, mesh.position(node)[2]);
    return top;
  };
  EXPECT_EQ(height(0.25), 1);
  EXPECT_EQ(height(1), 2);
  std::filesystem::remove_all(folder.file("constant"));
  std::filesystem::create_directory(folder.file("processors4"));
  EXPECT_THAT(refusal(folder.file("a.foam")),
              HasSubstr("found collated parts, which are not read: processors4"));
}

/// The unit tetrahedron as part 0, and another over its face 1 2 3 as part 1, whose point 0 is the
/// fifth of the whole, with results at the times 0 and 1.
class DecomposedCase {
 public:
  DecomposedCase() {
    write("a.foam", "");
    write_part(0, "(0 0 0)(1 0 0)(0 1 0)(0 0 1)", "3(0 2 1) 3(0 1 3) 3(0 3 2) 3(1 2 3)");
    write_part(1, "(1 1 1)(1 0 0)(0 1 0)(0 0 1)", "3(1 2 0) 3(2 3 0) 3(3 1 0) 3(1 3 2)");
    for (const int part : {0, 1})
      for (const int time : {0, 1}) {
        write_part_file(part, fmt::format("{}/p", time),
                        foam("volScalarField",
                             fmt::format("internalField uniform {};\n", 7 + part + 10 * time)));
        write_part_file(part, fmt::format("{}/T", time),
                        foam("pointScalarField",
                             fmt::format("internalField nonuniform List<scalar> 4({} 1 2 3);\n",
                                         part == 0 ? 0 : 4)));
      }
  }
  void write_part(int part, const std::string& points, const std::string& faces) const {
    const std::string folder = "constant/polyMesh/";
    write_part_file(part, folder + "points", foam("vectorField", "4(" + points + ")\n"));
    write_part_file(part, folder + "faces", foam("faceList", "4(" + faces + ")\n"));
    write_part_file(part, folder + "owner", foam("labelList", "4{0}\n"));
    write_part_file(part, folder + "neighbour", foam("labelList", "0()\n"));
    write_boundary(part, 1, 3, 1 - part);
  }
  void write_boundary(int part, int faces, int start, int neighbour) const {
    write_part_file(
        part, "constant/polyMesh/boundary",
        foam("polyBoundaryMesh",
             fmt::format(
                 "2\n(\n walls\n {{\n type wall;\n physicalType \"a;\";\n inGroups 1(wall);\n"
                 " nFaces 3;\n startFace 0;\n }}\n procBoundary{0}to{1}\n {{\n type processor;\n"
                 " inGroups 1(processor);\n nFaces {2};\n startFace {3};\n"
                 " transform {{ a 1; }}\n myProcNo {0};\n neighbProcNo {1};\n }}\n)\n",
                 part, neighbour, faces, start)));
  }
  void write_addresses(const std::string& first_points) const {
    const std::string folder = "constant/polyMesh/";
    write_part_file(0, folder + "pointProcAddressing", foam("labelList", first_points + "\n"));
    write_part_file(1, folder + "pointProcAddressing", foam("labelList", "4(4 1 2 3)\n"));
    write_part_file(0, folder + "cellProcAddressing", foam("labelList", "1{1}\n"));
    write_part_file(1, folder + "cellProcAddressing", foam("labelList", "1(0)\n"));
  }
  void write_part_file(int part, const std::string& name, const std::string& text) const {
    write(fmt::format("processor{}/{}", part, name), text);
  }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(file(name)).parent_path());
    static_cast<void>(folder_.write(name, text));
  }
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }
  [[nodiscard]] std::string refused() const { return refusal(file("a.foam")); }

 private:
  ScratchFolder folder_;
};

void expect_two_tetrahedra(const ZooMesh& mesh) {
  ASSERT_EQ(mesh.cell_count(), 2U);
  EXPECT_EQ(mesh.node_count(), 5U);
  EXPECT_NEAR(volume_of(mesh), 1.0 / 6 + 1.0 / 3, 1e-15);
  const Field& p = field_named(mesh, "p");
  const Field& t = field_named(mesh, "T");
  for (CellId cell = 0; cell < 2; ++cell) {
    const bool second = volume_of(mesh, cell) > 0.2;
    EXPECT_EQ(p.values[cell], second ? 18 : 17);
    for (const NodeId node : mesh.cell_nodes(cell)) {
      const auto x = mesh.position(node);
      EXPECT_EQ(t.values[node], x[0] + x[1] + x[2] == 3 ? 4 : x[0] + 2 * x[1] + 3 * x[2]);
    }
  }
}

TEST(OpenFoamParts, AreJoinedByPatchesOrByAddresses) {
  const DecomposedCase folder;
  const Reading patches = read_any(folder.file("a.foam"));
  expect_two_tetrahedra(patches.mesh);
  EXPECT_THAT(field_named(patches.mesh, "p").values.view(), ElementsAre(17, 18));
  EXPECT_THAT(patches.notes, Contains(HasSubstr("joined the 2 parts of a decomposed case")));
  EXPECT_THAT(patches.notes, Contains(HasSubstr("joined the parts by their patches")));
  folder.write_addresses("4(0 1 2 3)");
  const Reading addresses = read_any(folder.file("a.foam"));
  expect_two_tetrahedra(addresses.mesh);
  EXPECT_THAT(field_named(addresses.mesh, "p").values.view(), ElementsAre(18, 17));
  EXPECT_THAT(addresses.notes, testing::Not(Contains(HasSubstr("by their patches"))));
  EXPECT_THAT(addresses.notes, Contains(HasSubstr("by pointProcAddressing")));
  // files that do not fit the parts, or each other
  for (const std::string stale :
       {"3(0 1 2)", "4(0 1 2 9)", "4(0 1 3 2)", "4(0 1 2 -1)", "4(5 1 2 3)"}) {
    folder.write_addresses(stale);
    const Reading reading = read_any(folder.file("a.foam"));
    expect_two_tetrahedra(reading.mesh);
    EXPECT_THAT(reading.notes, Contains(HasSubstr("by their patches"))) << stale;
  }
}

TEST(OpenFoamParts, TimesAreThoseOfAllParts) {
  const DecomposedCase folder;
  folder.write_part_file(0, "2/p", foam("volScalarField", "internalField uniform 1;\n"));
  folder.write_part_file(1, "1/q", foam("volScalarField", "internalField uniform 1;\n"));
  folder.write_part_file(0, "0/k", foam("volScalarField", "internalField uniform 1;\n"));
  EXPECT_THAT(format_named("openfoam").inspect(folder.file("a.foam")).times, ElementsAre(0, 1));
  const Reading last = read_any(folder.file("a.foam"));
  expect_two_tetrahedra(last.mesh);
  EXPECT_THAT(last.notes, Contains(HasSubstr("left out 1 times that not all parts have")));
  ReadOptions options;
  options.time = 0;
  const Reading first = read_any(folder.file("a.foam"), options);
  EXPECT_THAT(field_named(first.mesh, "p").values.view(), ElementsAre(7, 8));
  EXPECT_THAT(first.notes, Contains(HasSubstr("left out 'k', which not all parts have")));
  folder.write_part_file(1, "1/p", foam("volVectorField", "internalField uniform (1 2 3);\n"));
  EXPECT_THAT(folder.refused(), HasSubstr("processor1/1/p: is of another kind"));
}

TEST(OpenFoamParts, TheWholeCaseCountsUnlessPartsAreLater) {
  const DecomposedCase folder;
  const FoamCase whole;
  std::filesystem::copy(whole.file("constant"), folder.file("constant"),
                        std::filesystem::copy_options::recursive);
  folder.write("0/p", foam("volScalarField", "internalField uniform 5;\n"));
  const Reading parts = read_any(folder.file("a.foam"));
  expect_two_tetrahedra(parts.mesh);
  EXPECT_THAT(parts.notes, Contains(HasSubstr("later times than the case itself")));
  folder.write("1/p", foam("volScalarField", "internalField uniform 6;\n"));
  const Reading case_itself = read_any(folder.file("a.foam"));
  EXPECT_EQ(case_itself.mesh.cell_count(), 1U);
  EXPECT_EQ(field_named(case_itself.mesh, "p").values[0], 6);
  // a part alone
  EXPECT_EQ(read_any(folder.file("processor1/1/p")).mesh.cell_count(), 1U);
}

TEST(OpenFoamParts, WhatDoesNotMeetIsRefused) {
  const DecomposedCase folder;
  folder.write_boundary(1, 1, 3, 7);
  EXPECT_THAT(folder.refused(),
              HasSubstr("a patch to part 7, which there is not (0 to 1 expected)"));
  folder.write_boundary(1, 2, 2, 0);
  EXPECT_THAT(folder.refused(), HasSubstr("no patch of 1 faces to part 0"));
  folder.write_boundary(1, 2, 3, 0);
  EXPECT_THAT(folder.refused(), HasSubstr("a patch of 2 faces from face 3 on (4 faces found)"));
  folder.write_boundary(1, 1, 2, 0);
  EXPECT_THAT(folder.refused(), HasSubstr("its patch to part 0 does not meet that part's face 3"));
  folder.write_boundary(1, 1, 3, 1);
  EXPECT_THAT(folder.refused(), HasSubstr("processor1/constant/polyMesh/boundary: "
                                          "a patch of part 1 to itself"));
  // only part 1 has a patch to the other
  folder.write_boundary(1, 1, 3, 0);
  folder.write_part_file(0, "constant/polyMesh/boundary",
                         foam("polyBoundaryMesh", "1(a { type wall; nFaces 4; startFace 0; })"));
  EXPECT_THAT(folder.refused(),
              HasSubstr("processor0/constant/polyMesh/boundary: "
                        "no patch of 1 faces to part 1, as part 1 has one to it"));
  // a patch without faces joins nothing and needs no other side
  folder.write_boundary(1, 0, 3, 0);
  EXPECT_EQ(read_any(folder.file("a.foam")).mesh.node_count(), 8U);
  folder.write_boundary(0, 1, 3, 1);
  folder.write_boundary(1, 1, 3, 0);
  folder.write_part(1, "(1 1 1)(1 0 0)(0 1 0)(0 0 1)", "3(1 2 0) 3(2 3 0) 3(3 1 0) 3(1 3 9)");
  EXPECT_THAT(folder.refused(), HasSubstr("there is no point 9 (4 points found)"));
  folder.write_part_file(1, "constant/polyMesh/boundary",
                         foam("polyBoundaryMesh", "1(a { type processor; nFaces 1"));
  EXPECT_THAT(folder.refused(), HasSubstr("ended within a patch"));
  folder.write_part_file(1, "constant/polyMesh/boundary", foam("polyBoundaryMesh", "9999(a"));
  EXPECT_THAT(folder.refused(), HasSubstr("a count that fits the file"));
  std::filesystem::rename(folder.file("processor1"), folder.file("processor2"));
  EXPECT_THAT(folder.refused(), HasSubstr("processor1 has no mesh (that of processor2 found)"));
}

// ---- EnSight

const std::string kGoldHead = "FORMAT\ntype: ensight gold\nGEOMETRY\n";
const std::string kGold =
    "a\nb\nnode id off\nelement id off\npart\n1\nthe part\ncoordinates\n4\n0\n1\n0\n0\n0\n0\n1\n0\n"
    "0\n0\n0\n1\ntetra4\n1\n1 2 3 4\n";

std::string stepped(const std::string& text) {
  return "BEGIN TIME STEP\n" + text + "END TIME STEP\n";
}
std::string gold_values(double first) {
  return fmt::format("p\npart\n1\ncoordinates\n{}\n{}\n{}\n{}\n", first, first + 1, first + 2,
                     first + 3);
}

TEST(EnSightHabits, SeveralStepsInOneFileAndTimeSetsOfTheirOwn) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("g.geo", stepped(kGold)));
  static_cast<void>(folder.write("p.var", stepped(gold_values(1)) + stepped(gold_values(11))));
  const std::string path = folder.write(
      "c.case", kGoldHead +
                    "model: 2 2 g.geo changing_geometry_per_part\nVARIABLE\n"
                    "scalar per node: 1 1 p p.var\nTIME\ntime set: 2\nnumber of steps: 1\n"
                    "time values: 0\ntime set: 1\nnumber of steps: 2\ntime values:\n0.0\n0.5\n"
                    "FILE\nfile set: 2\nnumber of steps: 1\nfile set: 1\nnumber of steps: 2\n");
  const std::string late =
      folder.write("late.case", "FORMAT\ntype: ensight gold\n" + std::string(5000, '\n') +
                                    "GEOMETRY\nmodel: g.geo\n");
  expect_unit_tetrahedron(read_any(late).mesh);
  const ZooMesh last = read_any(path).mesh;
  expect_unit_tetrahedron(last);
  EXPECT_THAT(last.fields.at(0).values.view(), ElementsAre(11, 12, 13, 14));
  ReadOptions options;
  options.time = 0;
  EXPECT_THAT(read_any(path, options).mesh.fields.at(0).values.view(), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(format_to_read(path).inspect(path).times, ElementsAre(0, 0.5));
  static_cast<void>(folder.write("p.var", stepped(gold_values(1))));
  EXPECT_THAT(refusal(path), HasSubstr("holds 1 steps (2 expected at least)"));
}

TEST(EnSightHabits, PartialValuesAndStarsWithoutANumberedSet) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("g.geo", kGold));
  static_cast<void>(folder.write("p.07", "p\npart\n1\ncoordinates partial\n2\n4\n2\n8.5\n7.5\n"));
  const std::string path =
      folder.write("c.case", kGoldHead +
                                 "model: \"g.geo\"\nVARIABLE\nscalar per node: p p.**\nTIME\n"
                                 "time set: 1\nnumber of steps: 1\nfilename numbers: 7\n"
                                 "time values: 2\n");
  const auto values = read_any(path).mesh.fields.at(0).values;
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[1], 7.5);
  EXPECT_EQ(values[3], 8.5);
}

TEST(EnSightHabits, BlocksOnAxes) {
  const ScratchFolder folder;
  const std::string head = "a\nb\nnode id off\nelement id off\npart\n1\nx\n";
  const std::string path = folder.write("c.case", kGoldHead + "model: g.geo\n");
  static_cast<void>(
      folder.write("g.geo", head + "block rectilinear\n3 2 2\n0\n1\n4\n0\n1\n0\n2\n"));
  const ZooMesh rectilinear = read_any(path).mesh;
  EXPECT_EQ(rectilinear.cell_count(), 2U);
  EXPECT_THAT(rectilinear.position(rectilinear.cell_nodes(1)[6]), ElementsAre(4, 1, 2));
  static_cast<void>(folder.write("g.geo", head + "block uniform\n2 2 3\n1\n2\n3\n.5\n.25\n.125\n"));
  const ZooMesh uniform = read_any(path).mesh;
  EXPECT_EQ(uniform.cell_count(), 2U);
  EXPECT_THAT(uniform.position(uniform.cell_nodes(1)[6]), ElementsAre(1.5, 2.25, 3.25));
  static_cast<void>(folder.write("g.geo", head + "block uniform range\n2 2 3\n"));
  EXPECT_THAT(refusal(path), HasSubstr("'block uniform range' is not read"));
}

/// Records of a Fortran binary file, in one byte order.
class Records {
 public:
  explicit Records(std::endian order) : swapped_(order != std::endian::native) {}
  Records& text(std::string words) {
    words.resize(80, ' ');
    return record(words);
  }
  template <typename Number>
  Records& numbers(std::initializer_list<Number> list) {
    std::string bytes;
    for (const Number number : list) bytes += word(std::bit_cast<std::uint32_t>(number));
    return record(bytes);
  }
  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  Records& record(const std::string& bytes) {
    const std::string mark = word(static_cast<std::uint32_t>(bytes.size()));
    text_ += mark + bytes + mark;
    return *this;
  }
  [[nodiscard]] std::string word(std::uint32_t value) const {
    if (swapped_) value = __builtin_bswap32(value);
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
  }
  bool swapped_;
  std::string text_;
};

TEST(EnSightHabits, FortranBinaryOfBothByteOrders) {
  const ScratchFolder folder;
  const std::string path =
      folder.write("c.case", kGoldHead + "model: g.geo\nVARIABLE\nscalar per node: p p.var\n");
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    Records geometry(order);
    geometry.text("Fortran Binary").text("a").text("b").text("node id off").text("element id off");
    geometry.text("part").numbers({1}).text("x").text("coordinates").numbers({4});
    geometry.numbers<float>({0, 1, 0, 0}).numbers<float>({0, 0, 1, 0});
    geometry.numbers<float>({0, 0, 0, 1}).text("tetra4").numbers({1}).numbers({1, 2, 3, 4});
    static_cast<void>(folder.write("g.geo", geometry.str()));
    Records values(order);
    values.text("p").text("part").numbers({1}).text("coordinates").numbers<float>({1, 2, 3, 4});
    static_cast<void>(folder.write("p.var", values.str()));
    const ZooMesh mesh = read_any(path).mesh;
    expect_unit_tetrahedron(mesh);
    EXPECT_THAT(mesh.fields.at(0).values.view(), ElementsAre(1, 2, 3, 4));
    static_cast<void>(folder.write("g.geo", geometry.str().substr(0, 300)));
    EXPECT_THAT(refusal(path), HasSubstr("a record between two marks"));
  }
}

TEST(EnSightHabits, Version6HasNumbersInColumnsAndOneListOfNodes) {
  const ScratchFolder folder;
  std::string text =
      "a\nb\nnode id given\nelement id given\ncoordinates\n" + fmt::format("{:8}\n", 5);
  const std::array<std::array<double, 3>, 5> points{
      {{0, 0, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{:8}{:12.5e}{:12.5e}{:12.5e}\n", 10 * i + 1, points[i][0], points[i][1],
                        points[i][2]);
  text += "part 1\nskin\ntria3\n" + fmt::format("{:8}\n{:8}{:8}{:8}{:8}\n", 1, 1, 11, 21, 31);
  text +=
      "part 2\ncore\ntetra4\n" + fmt::format("{:8}\n{:8}{:8}{:8}{:8}{:8}\n", 1, 2, 11, 21, 31, 41);
  static_cast<void>(folder.write("g.geo", text));
  // negative reals leave no blanks between them
  text = "v\n";
  for (int i = 0; i < 15; ++i)
    text += fmt::format("{:12.5e}{}", -1.0 - i, i % 6 == 5 || i == 14 ? "\n" : "");
  static_cast<void>(folder.write("v.vec", text));
  static_cast<void>(folder.write("c.scl", "c\npart 2\ntetra4\n-7.50000e+00\n"));
  const std::string path = folder.write(
      "c.case",
      "# 6\nFORMAT\n\ntype:   ensight\n\nGEOMETRY\nmodel: g.geo\nVARIABLE\n"
      "constant per case: Cden .8\nvector per node: v v.vec\nscalar per element: c c.scl\n");
  const Reading reading = read_any(path);
  EXPECT_THAT(reading.notes, Contains("left out 'constant per case: Cden .8'"));
  const ZooMesh& mesh = reading.mesh;
  expect_unit_tetrahedron(mesh);
  EXPECT_EQ(mesh.fields.at(0).values[3 * mesh.nodes[3] + 2], -15);
  EXPECT_EQ(mesh.fields.at(1).values[0], -7.5);
  EXPECT_THAT(format_named("ensight").inspect(path).blocks, ElementsAre("skin", "core"));
  static_cast<void>(folder.write("g.geo", "C Binary"));
  EXPECT_THAT(refusal(path), HasSubstr("is a binary file of EnSight 6"));
}

}  // namespace
}  // namespace hiac::formats

// What real cases of several files hold beside what their formats' descriptions need.
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

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
  std::filesystem::create_directory(folder.file("processor0"));
  EXPECT_THAT(refusal(folder.file("a.foam")), HasSubstr("found parts of one: reconstructPar"));
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
  const ZooMesh last = read_any(path).mesh;
  expect_unit_tetrahedron(last);
  EXPECT_THAT(last.fields.at(0).values.view(), ElementsAre(11, 12, 13, 14));
  ReadOptions options;
  options.time = 0;
  EXPECT_THAT(read_any(path, options).mesh.fields.at(0).values.view(), ElementsAre(1, 2, 3, 4));
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

}  // namespace
}  // namespace hiac::formats

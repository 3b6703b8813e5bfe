// One of OpenFOAM's files at a time: headers, lists, patches, fields and units as the files write
// them, and what they are refused for, with the line or, in binary files, the byte.
#include "formats/openfoam/foam_file.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "tests/formats/complaints.hpp"
#include "tests/formats/raw_bytes.hpp"

namespace hiac::formats {
namespace {

using openfoam::FoamFile;
using testing::ElementsAre;
using testing::IsEmpty;

std::string foam_text(const std::string& body, const std::string& header = "") {
  return "FoamFile\n{\n" + header + "}\n" + body;
}
const std::string kFoamBinary = "format binary;\n";

/// What `read` gives of a file with that body.
template <typename Read>
auto from_foam(const std::string& text, const Read& read) {
  const ScratchFolder folder;
  FoamFile file(folder.write("f", text));
  return read(file);
}

/// All behind the path of the refusal; empty: `read` reads the file.
template <typename Read>
std::string foam_refusal(const std::string& text, const Read& read) {
  const ScratchFolder folder;
  const std::string path = folder.write("f", text);
  try {
    FoamFile file(path);
    static_cast<void>(read(file));
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, path.size()), path);
    return std::string(error.what()).substr(path.size());
  }
  return "";
}

constexpr auto kNothing = [](FoamFile& file) { return file.class_name(); };
constexpr auto kLabels = [](FoamFile& file) { return file.labels(3); };
constexpr auto kPoints = [](FoamFile& file) { return file.points(); };
constexpr auto kPatches = [](FoamFile& file) { return file.patches(); };
constexpr auto kUnit = [](FoamFile& file) { return file.unit(); };
constexpr auto kField = [](FoamFile& file) { return file.internal_field(2); };
constexpr auto kFaces = [](FoamFile& file) {
  std::pair<std::vector<std::size_t>, std::vector<std::int64_t>> faces;
  file.faces(faces.first, faces.second);
  return faces;
};

TEST(FoamHeaders, AreEntriesBetweenBraces) {
  EXPECT_EQ(foam_refusal(foam_text(""), kNothing), "");
  EXPECT_EQ(foam_refusal("foamFile {}", kNothing), ":1: 'FoamFile' expected");
  EXPECT_EQ(foam_refusal("FoamFile\nclass a;", kNothing), ":2: '{' expected");
  EXPECT_EQ(foam_refusal("FoamFile\n{\n;\n}", kNothing), ":3: an entry of the header expected");
  EXPECT_EQ(foam_refusal("FoamFile\n{\nclass\n;}", kNothing),
            ":4: an entry of the header expected");
  EXPECT_EQ(foam_refusal("FoamFile {\n\n", kNothing), ":3: an entry of the header expected");
  EXPECT_EQ(foam_refusal("FoamFile { class a b c", kNothing), ":1: ended where ';' is expected");
  EXPECT_EQ(foam_refusal("FoamFile { meta { a { b 1; } c 2; }", kNothing),
            ":1: an entry of the header expected");
  EXPECT_EQ(foam_refusal("FoamFile { meta { a { b 1; } c 2;", kNothing),
            ":1: ended within a dictionary");
  EXPECT_EQ(foam_refusal(foam_text("", "arch \"MSB;label=32;scalar=64\";\n"), kNothing),
            ":3: numbers of the other byte order (LSB expected)");
  EXPECT_EQ(
      from_foam("// c\n/* d\n */ FoamFile { version 2.0; class volScalarField; a b c; }", kNothing),
      "volScalarField");
}

TEST(FoamHeaders, CommentsMayBeEmpty) {
  EXPECT_EQ(from_foam("/**/ FoamFile /***/ { /*/ class b; */ class a; }", kNothing), "a");
  EXPECT_EQ(from_foam("FoamFile { class a; // }\n/* */ note b; }", kNothing), "a");
  EXPECT_EQ(foam_refusal("/*/ FoamFile { class a; }", kNothing), ":1: 'FoamFile' expected");
}

TEST(FoamLists, OfWholeNumbers) {
  const auto labels = [](const std::string& body) { return from_foam(foam_text(body), kLabels); };
  EXPECT_THAT(labels("3(7 -8\n9)"), ElementsAre(7, -8, 9));
  EXPECT_THAT(labels("(7 8)"), ElementsAre(7, 8));
  EXPECT_THAT(labels("()"), IsEmpty());
  EXPECT_THAT(labels("0"), IsEmpty());
  EXPECT_THAT(labels("0()"), IsEmpty());
  EXPECT_THAT(labels("3{5}"), ElementsAre(5, 5, 5));
  EXPECT_THAT(labels("0{5}"), IsEmpty());
  const auto refused = [](const std::string& body) {
    return foam_refusal(foam_text(body), kLabels);
  };
  EXPECT_EQ(refused("4{5}"), ":4: a count that fits the file expected (at most 3; 4 found)");
  EXPECT_EQ(refused("-1(5)"), ":4: a count that fits the file expected (at most 1; -1 found)");
  EXPECT_EQ(refused("3(5 6 )"), ":4: a whole number expected");
  EXPECT_EQ(refused("3(5   )"), ":4: a whole number expected");
  EXPECT_EQ(refused("1(5\n6)"), ":5: ')' expected");
  EXPECT_EQ(refused("x"), ":4: a whole number expected");
  EXPECT_EQ(refused("1(5"), ":4: ended where ')' is expected");
  // brackets and blanks: five characters for two numbers
  EXPECT_EQ(refused("3(5)\n"), ":4: a count that fits the file expected (at most 2; 3 found)");
  EXPECT_EQ(refused("2(5)\n"), ":4: a whole number expected");
}

TEST(FoamLists, OfBinaryNumbers) {
  const std::string small = raw_bytes<std::int32_t>({1, -2, 3});
  const std::string large = raw_bytes<std::int64_t>({1, -2, std::int64_t{1} << 40});
  const std::string arch64 = "arch \"LSB;label=64;scalar=32\";\n" + kFoamBinary;
  EXPECT_THAT(from_foam(foam_text("3(" + small + ")", kFoamBinary), kLabels),
              ElementsAre(1, -2, 3));
  EXPECT_THAT(from_foam(foam_text("3(" + large + ")", arch64), kLabels),
              ElementsAre(1, -2, std::int64_t{1} << 40));
  const std::string xyz = raw_bytes<double>({1, 2, 3, 4, 5, 6});
  EXPECT_THAT(from_foam(foam_text("2(" + xyz + ")", kFoamBinary), kPoints),
              ElementsAre(1, 2, 3, 4, 5, 6));
  const std::string floats = raw_bytes<float>({1, 2, 3});
  EXPECT_THAT(from_foam(foam_text("1(" + floats + ")", arch64), kPoints), ElementsAre(1, 2, 3));
  // the head takes 28 bytes
  const auto refused = [](const std::string& body) {
    return foam_refusal(foam_text(body, kFoamBinary), kLabels);
  };
  EXPECT_EQ(refused("3(" + small.substr(0, 11)), ": byte 30: ended before 12 bytes of a list");
  EXPECT_EQ(refused("3(" + small.substr(0, 10)),
            ": byte 29: a count that fits the file expected (at most 2; 3 found)");
  EXPECT_EQ(refused("3(" + small + "]"), ": byte 42: ')' expected");
  EXPECT_EQ(refused("3(" + small), ": byte 42: ended where ')' is expected");
  EXPECT_EQ(refused("x"), ": byte 28: a whole number expected");
  EXPECT_EQ(foam_refusal(foam_text("1(3(1 2 3))", kFoamBinary + "class faceList;\n"), kFaces),
            ": byte 43: a faceCompactList expected ('faceList' found)");
}

TEST(FoamLists, OfFaces) {
  for (const std::string body : {"2(3(0 1 2) 4(0 1 2 3))", "(3(0 1 2)4(0 1 2 3))"}) {
    const auto [starts, nodes] = from_foam(foam_text(body), kFaces);
    EXPECT_THAT(starts, ElementsAre(0, 3, 7));
    EXPECT_THAT(nodes, ElementsAre(0, 1, 2, 0, 1, 2, 3));
  }
  const std::string compact = "class faceCompactList;\n";
  const auto [starts, nodes] = from_foam(foam_text("3(0 3 7)\n7(0 1 2 0 1 2 3)", compact), kFaces);
  EXPECT_THAT(starts, ElementsAre(0, 3, 7));
  EXPECT_THAT(nodes, ElementsAre(0, 1, 2, 0, 1, 2, 3));
  const std::string rise = ":6: offsets of faces that rise within their list expected";
  EXPECT_EQ(foam_refusal(foam_text("3(0 3 8)\n7(0 1 2 0 1 2 3)", compact), kFaces), rise);
  EXPECT_EQ(foam_refusal(foam_text("3(0 3 2)\n7(0 1 2 0 1 2 3)", compact), kFaces), rise);
  EXPECT_EQ(foam_refusal(foam_text("3(0 3 3)\n7(0 1 2 0 1 2 3)", compact), kFaces), "");
  EXPECT_EQ(foam_refusal(foam_text("1(9(0 1 2))"), kFaces),
            ":4: a count that fits the file expected (at most 4; 9 found)");
  EXPECT_EQ(foam_refusal(foam_text("1(3 0 1 2)"), kFaces), ":4: '(' expected");
}

TEST(FoamPatches, TellTheirTypesAndFaces) {
  const auto patches = from_foam(
      foam_text("2\n(\nwall // c\n{\n type wall;\n inGroups 1(wall);\n note \"a } b; c\";\n nFaces "
                "3;\n startFace 10;\n}\nto1 { type processor; nFaces 2; startFace 13; transform { "
                "a 1; } neighbProcNo 1; }\n)"),
      kPatches);
  ASSERT_EQ(patches.size(), 2U);
  EXPECT_EQ(patches[0].type, "wall");
  EXPECT_EQ(patches[0].faces, 3);
  EXPECT_EQ(patches[0].start_face, 10);
  EXPECT_EQ(patches[0].neighbour, -1);
  EXPECT_EQ(patches[1].type, "processor");
  EXPECT_EQ(patches[1].faces, 2);
  EXPECT_EQ(patches[1].start_face, 13);
  EXPECT_EQ(patches[1].neighbour, 1);
  const auto refused = [](const std::string& body) {
    return foam_refusal(foam_text(body), kPatches);
  };
  EXPECT_EQ(refused("1(a {\n;})"), ":5: an entry of a patch expected");
  EXPECT_EQ(refused("1(a {\n(b);})"), ":5: an entry of a patch expected");
  EXPECT_EQ(refused("1(a {\n"), ":5: an entry of a patch expected");
  EXPECT_EQ(refused("1(a { type wall"), ":4: ended within a patch");
  EXPECT_EQ(refused("1(a { nFaces x; })"), ":4: a whole number expected");
  EXPECT_EQ(refused("1(a { nFaces 1; }\n]"), ":5: ')' expected");
  EXPECT_EQ(refused("1(a nFaces 1;)"), ":4: '{' expected");
  EXPECT_EQ(refused("3(a {})"), ":4: a count that fits the file expected (at most 1; 3 found)");
}

TEST(FoamFields, AreUniformOrListsOfTheirTypes) {
  const auto field = [](const std::string& body) { return from_foam(foam_text(body), kField); };
  const auto list = [&](const std::string& type, const std::string& values) {
    return field("internalField nonuniform List<" + type + "> " + values + ";");
  };
  EXPECT_THAT(list("scalar", "2(3 4.5)")->values, ElementsAre(3, 4.5));
  EXPECT_THAT(list("scalar", "2{7}")->values, ElementsAre(7, 7));
  EXPECT_THAT(list("scalar", "(1 2)")->values, ElementsAre(1, 2));
  EXPECT_EQ(list("sphericalTensor", "2(3 4)")->components, 1U);
  EXPECT_THAT(list("vector", "2((1 2 3)(4 5 6))")->values, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(list("vector", "2{(1 2 3)}")->values, ElementsAre(1, 2, 3, 1, 2, 3));
  EXPECT_EQ(list("symmTensor", "2{(1 2 3 4 5 6)}")->components, 6U);
  EXPECT_EQ(list("tensor", "2{(1 2 3 4 5 6 7 8 9)}")->components, 9U);
  EXPECT_THAT(field("internalField uniform -2;")->values, ElementsAre(-2, -2));
  EXPECT_THAT(field("internalField uniform (1 2);")->values, ElementsAre(1, 2, 1, 2));
  EXPECT_THAT(field("a 1; v (1 -2 .5);\n internalField uniform $v;")->values,
              ElementsAre(1, -2, 0.5, 1, -2, 0.5));
  EXPECT_THAT(field("b { internalField uniform 1; }\n#include \"x; internalField y\"\n"
                    "v uniform 4;internalField uniform $v;")
                  ->values,
              ElementsAre(4, 4));
  for (const std::string unknown : {"uniform $v", "uniform $v; w 1", "$v", "#codeStream {}",
                                    "uniform (1 $b 2)", "uniform table"})
    EXPECT_EQ(field("internalField " + unknown + ";"), std::nullopt) << unknown;
}

TEST(FoamFields, RefusedOnesNameTheLine) {
  const auto refused = [](const std::string& body) {
    return foam_refusal(foam_text(body), kField);
  };
  EXPECT_EQ(refused("dimensions [0 0 0];\n"), ":5: has no internalField");
  EXPECT_EQ(refused("internalField\n constant 1;"), ":5: 'uniform' or 'nonuniform' expected");
  EXPECT_EQ(refused("internalField nonuniform scalars 1(1);"),
            ":4: 'List<type>' expected ('scalars' found)");
  EXPECT_EQ(refused("internalField nonuniform List<label> 1(1);"),
            ":4: 'label' is no type that is read");
  EXPECT_EQ(refused("internalField nonuniform List<scalar> 3(1 2 3);"),
            ":4: 2 values expected (3 found)");
  EXPECT_EQ(refused("internalField nonuniform List<scalar> (1);"),
            ":4: 2 values expected (1 found)");
  EXPECT_EQ(refused("internalField nonuniform List<scalar> 3{1};"),
            ":4: a count that fits the file expected (at most 2; 3 found)");
  EXPECT_EQ(refused("internalField nonuniform List<vector> 2((1 2 3)(4 5));"),
            ":4: a number expected");
  EXPECT_EQ(refused("internalField uniform (1 2 3 4 5 6 7 8 9);"), "");
  EXPECT_EQ(refused("internalField uniform (1 2 3 4 5 6 7 8 9 10);"),
            ":4: 1 to 9 components expected");
}

TEST(FoamUnits, AreExponentsOfSevenBaseUnits) {
  const auto unit = [](const std::string& body) { return from_foam(foam_text(body), kUnit); };
  EXPECT_EQ(unit("dimensions [1 2 3 4 5 6 7];"), "kg m^2 s^3 K^4 mol^5 A^6 cd^7");
  EXPECT_EQ(unit("dimensions [0 1 -1 0 0];"), "m s^-1");
  EXPECT_EQ(unit("dimensions [0 0.5 0];"), "m^0.5");
  EXPECT_EQ(unit("dimensions [0 0 0 0 0 0 1];"), "cd");
  EXPECT_EQ(unit("dimensions [];"), "");
  EXPECT_EQ(unit("dimensions 1;"), "");
  EXPECT_EQ(unit("dimensions [1 2"), "");
  EXPECT_EQ(unit("internalField uniform 1;"), "");
}

TEST(FoamFiles, AreToldByTheirBeginning) {
  const ScratchFolder folder;
  EXPECT_TRUE(FoamFile::is_one(folder.write("a", "// c\nFoamFile {")));
  EXPECT_FALSE(FoamFile::is_one(folder.write("b", "notes")));
  EXPECT_FALSE(FoamFile::is_one(folder.write("c", std::string("\0FoamFile", 9))));
  EXPECT_TRUE(FoamFile::is_one(folder.write("d", std::string("FoamFile\0", 9))));
  EXPECT_TRUE(FoamFile::exists(folder.file("a")));
  EXPECT_FALSE(FoamFile::exists(folder.file("e")));
  EXPECT_FALSE(FoamFile::exists(folder.path().string()));
  static_cast<void>(folder.write("f.gz", "x"));
  EXPECT_TRUE(FoamFile::exists(folder.file("f")));
}

TEST(FoamCases, CellsAreFewerThanFaces) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.file("constant/polyMesh"));
  const auto write = [&](const std::string& name, const std::string& body) {
    static_cast<void>(folder.write("constant/polyMesh/" + name, foam_text(body)));
  };
  const std::string path = folder.write("a.foam", "");
  write("points", "4((0 0 0)(1 0 0)(0 1 0)(0 0 1))");
  write("faces", "4(3(0 2 1) 3(0 1 3) 3(0 3 2) 3(1 2 3))");
  write("owner", "4{0}");
  write("neighbour", "0()");
  EXPECT_EQ(refusal(path), "");
  const std::string owner = folder.file("constant/polyMesh/owner");
  write("owner", "4(0 0 0 4)");
  EXPECT_EQ(refusal(path), owner + ": names cell 4 (fewer than 4 expected)");
  write("owner", "3{0}");
  EXPECT_EQ(refusal(path), owner + ": does not fit the faces (4 entries expected, 3 found)");
  write("owner", "4{0}");
  write("neighbour", "1(9)");
  const std::string neighbour = folder.file("constant/polyMesh/neighbour");
  EXPECT_EQ(refusal(path), neighbour + ": names cell 9 (fewer than 4 expected)");
  write("owner", "4(0 0 7 0)");
  EXPECT_EQ(refusal(path), owner + ": names cell 7 (fewer than 4 expected)");
  write("owner", "4{0}");
  // a face without a neighbour among those that have one
  write("neighbour", "2(-1 -1)");
  EXPECT_EQ(refusal(path), "");
}

}  // namespace
}  // namespace hiac::formats

// hiac-convert as scripts use it: options, streams, messages, exit codes.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::tools {
namespace {

using testing::HasSubstr;

constexpr const char* kQuadratic =
    "# vtk DataFile Version 3.0\ntwo cells\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 14 double\n"
    "0 0 0 2 0 0 0 2 0 0 0 2 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 0 1 1 9 0 0 10 0 0 9 1 0 9 0 1\n"
    "CELLS 3 20\n10 0 1 2 3 4 5 6 7 8 9\n4 10 11 12 13\n3 0 1 2\nCELL_TYPES 3\n24\n10\n5\n"
    "POINT_DATA 14\nSCALARS t double\nLOOKUP_TABLE default\n0 1 2 3 4 5 6 7 8 9 10 11 12 13\n"
    "VECTORS v double\n3 0 4 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
    "0 0 0 0 0 0\n";

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

class Convert : public testing::Test {
 protected:
  void SetUp() override { std::ofstream(file("in.vtk")) << kQuadratic; }
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

  [[nodiscard]] static std::string text_of(const std::string& path) { return test::bytes_of(path); }

  /// Runs a shell command in which CONVERT is the tool and names are relative to the folder.
  [[nodiscard]] Outcome run(const std::string& command) const {
    const std::string whole = "cd '" + folder_.path().string() +
                              "' && CONVERT='" HIAC_CONVERT "' && { " + command +
                              " ; } > out.txt 2> err.txt < /dev/null";
    const int status = std::system(whole.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(file("out.txt")),
            text_of(file("err.txt"))};
  }

  test::ScratchFolder folder_;
};

TEST_F(Convert, FileToFile) {
  const Outcome outcome = run("$CONVERT in.vtk -o out.zoo --json facts.json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("dropped cells without volume: 1 Triangle"));
  const ZooFile zoo = read_zoo_file(file("out.zoo"));
  EXPECT_EQ(zoo.mesh.cell_count(), 2U);
  EXPECT_EQ(zoo.mesh.kinds[0], CellKind::tetrahedron10);
  ASSERT_TRUE(zoo.mesh.adjacency.has_value());
  EXPECT_EQ(zoo.mesh.adjacency->neighbors.size(), 8U);
  const auto facts = nlohmann::json::parse(text_of(file("facts.json")));
  EXPECT_EQ(facts["cells"], 2);
  EXPECT_EQ(facts["kinds"]["tetrahedron10"], 1);
  EXPECT_EQ(facts["exit_code"], 0);
}

TEST_F(Convert, PipesCarryTheSameMesh) {
  EXPECT_EQ(run("$CONVERT -q in.vtk -o a.zoo").code, 0);
  EXPECT_EQ(run("$CONVERT -q in.vtk | cat > b.zoo").code, 0);
  EXPECT_EQ(text_of(file("a.zoo")), text_of(file("b.zoo")));
  // a zoo stream in, a foreign stream in, and a tool that passes on
  EXPECT_EQ(run("$CONVERT -q in.vtk | $CONVERT -q - -o c.zoo").code, 0);
  EXPECT_EQ(content_hash(read_zoo_file(file("c.zoo")).mesh),
            content_hash(read_zoo_file(file("a.zoo")).mesh));
  EXPECT_EQ(run("cat in.vtk | $CONVERT -q --format vtk - -o d.zoo").code, 0);
  EXPECT_EQ(content_hash(read_zoo_file(file("d.zoo")).mesh),
            content_hash(read_zoo_file(file("a.zoo")).mesh));
  // the first stage's failure is not a mesh for the second
  const Outcome outcome = run("$CONVERT no.vtk | $CONVERT - -o e.zoo");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_FALSE(std::filesystem::exists(file("e.zoo")));
}

TEST_F(Convert, VtuAndBack) {
  EXPECT_EQ(run("$CONVERT -q in.vtk -o a.zoo && $CONVERT -q a.zoo -o b.vtu && "
                "$CONVERT -q b.vtu -o c.zoo")
                .code,
            0);
  EXPECT_EQ(content_hash(read_zoo_file(file("c.zoo")).mesh),
            content_hash(read_zoo_file(file("a.zoo")).mesh));
}

TEST_F(Convert, FieldsAreChosenRenamedAndDerived) {
  const Outcome outcome =
      run("$CONVERT -q in.vtk --field t=temperature --field v:z --derive 'speed=magnitude(v)' -o "
          "a.zoo");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const ZooMesh mesh = read_zoo_file(file("a.zoo")).mesh;
  ASSERT_EQ(mesh.fields.size(), 3U);
  EXPECT_EQ(mesh.fields[0].name, "temperature");
  EXPECT_EQ(mesh.fields[1].name, "v:z");
  EXPECT_EQ(mesh.fields[2].values[0], 5);
  const Outcome unknown = run("$CONVERT in.vtk --field pressure -o b.zoo");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("expected one of t, v"));
}

TEST_F(Convert, CornersOnlyNeglectsInteriorNodes) {
  const Outcome outcome = run("$CONVERT in.vtk --corners-only --no-adjacency -o a.zoo");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("the data at 6 nodes are neglected"));
  const ZooMesh mesh = read_zoo_file(file("a.zoo")).mesh;
  EXPECT_EQ(mesh.node_count(), 8U);
  EXPECT_EQ(mesh.kinds[0], CellKind::tetrahedron4);
  EXPECT_FALSE(mesh.adjacency.has_value());
}

TEST_F(Convert, Listings) {
  const Outcome formats = run("$CONVERT --list-formats");
  EXPECT_EQ(formats.code, 0);
  for (const char* name : {"zoo", "vtk", "vtu", "pvtu", "vts", "vti", "vtr"})
    EXPECT_THAT(formats.out, HasSubstr(name));
  const Outcome list = run("$CONVERT --list in.vtk");
  EXPECT_EQ(list.code, 0);
  EXPECT_THAT(list.out, HasSubstr("1 QuadraticTetra -> tetrahedron10"));
  EXPECT_THAT(list.out, HasSubstr("1 Triangle -> dropped"));
  EXPECT_THAT(list.out, HasSubstr("field   t (node, double x 1) [0, 13]"));
  const Outcome json = run("$CONVERT --list in.vtk --json -");
  EXPECT_EQ(nlohmann::json::parse(json.out)["inventory"]["points"], 14);
  EXPECT_THAT(run("$CONVERT -q in.vtk | $CONVERT --list").out, HasSubstr("1 tetrahedron10"));
}

TEST_F(Convert, WrongUsageIsExit2) {
  EXPECT_EQ(run("$CONVERT --no-such-option").code, 2);
  EXPECT_EQ(run("$CONVERT in.vtk -o a.xyz").code, 2);
  EXPECT_EQ(run("$CONVERT in.vtk --format nonsense -o a.zoo").code, 2);
  EXPECT_EQ(run("$CONVERT in.vtk --block b -o a.zoo").code, 2);
  EXPECT_EQ(run("$CONVERT in.vtk --step 3 -o a.zoo").code, 2);
  EXPECT_EQ(run("$CONVERT in.vtk --time 1 -o a.zoo").code, 2);
  EXPECT_EQ(run("$CONVERT in.vtk --json - | cat").code, 0);  // the pipe's code is cat's
  EXPECT_THAT(run("$CONVERT in.vtk --json -").err, HasSubstr("stdout carries the mesh"));
}

// The readers know nothing of options: their messages speak of what was asked for, and the tool
// names its options.
TEST_F(Convert, MessagesNameTheOptionsThatTheyAreAbout) {
  const std::vector<std::pair<std::string, std::string>> rows{
      {"in.vtk -o a.xyz", "-o a.xyz: no format with the extension '.xyz' can be written"},
      {"in.vtk --format nonsense -o a.zoo", "--format nonsense: there is no such format"},
      {"in.vtk --block b -o a.zoo", "--block b: in.vtk has no named blocks"},
      {"in.vtk --step 3 -o a.zoo", "--step 3: in.vtk holds one step"},
      {"in.vtk --time 1 -o a.zoo", "--time 1: in.vtk tells no time"},
      {"in.vtk --field q -o a.zoo", "--field q: there is no such field"},
      {"in.vtk --derive q -o a.zoo", "--derive q: not understood"},
      {"in.zoo --time 1 -o a.zoo", "--time: in.zoo is a zoo container"},
      {"--format zoo --block b -o a.zoo < in.zoo", "--block: stdin is a zoo container"}};
  ASSERT_EQ(run("$CONVERT -q in.vtk -o in.zoo").code, 0);
  for (const auto& [arguments, message] : rows) {
    const Outcome outcome = run("$CONVERT " + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr("hiac-convert: " + message)) << arguments;
  }
  std::ofstream(file("rich.msh"))
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n12\n1 0 0 0\n2 1 0 0\n3 2 1 0\n4 1 2 0\n"
         "5 0 2 0\n6 0 0 1\n7 1 0 1\n8 2 1 1\n9 1 2 1\n10 0 2 1\n11 0 1 0\n12 0 1 1\n$EndNodes\n"
         "$Elements\n1\n1 79 2 1 1 1 2 3 4 5 6 7 8 9 10 11 12 1 2 3 4 5 6 7 8 9 10 11 12 1 2 3 4 5 "
         "6 7 "
         "8 9 10\n$EndElements\n";
  const Outcome rich = run("$CONVERT rich.msh -o a.zoo");
  EXPECT_EQ(rich.code, 3);
  EXPECT_THAT(rich.err, HasSubstr("(--skip-unsupported leaves them out"));
  EXPECT_EQ(rich.err.find("ReadOptions"), std::string::npos) << rich.err;
}

TEST_F(Convert, UnreadableInputIsExit3WithOneLine) {
  std::ofstream(file("bad.vtk")) << std::string(kQuadratic).substr(0, 200);
  std::ofstream(file("text.txt")) << "not a mesh";
  for (const char* input : {"bad.vtk", "text.txt", "missing.vtk", "."}) {
    const Outcome outcome = run(std::string("$CONVERT ") + input + " -o a.zoo");
    EXPECT_EQ(outcome.code, 3) << input;
    EXPECT_THAT(outcome.err, testing::StartsWith(std::string("hiac-convert: ") + input));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(file("a.zoo")));
  EXPECT_EQ(run("$CONVERT in.vtk -o no/folder/a.zoo").code, 3);
  const Outcome stream = run("head -c 300 in.vtk | $CONVERT --format vtk -o a.zoo");
  EXPECT_EQ(stream.code, 3);
  EXPECT_THAT(stream.err, HasSubstr("hiac-convert: stdin: "));
}

TEST_F(Convert, HelpAndVersion) {
  const Outcome help = run("$CONVERT --help");
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, HasSubstr("Examples:"));
  EXPECT_EQ(help.err, "");
  EXPECT_THAT(run("$CONVERT --version").out, HasSubstr("VTK 9."));
}

}  // namespace
}  // namespace hiac::tools

// What the tools say when something is wrong: the right file, the right reason, what helps.
#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kView =
    "[image]\nwidth = 8\nheight = 6\n[camera]\nprojection = \"orthographic\"\n"
    "eye = [0.5, 0.5, -3.0]\nlook_at = [0.5, 0.5, 0.0]\nup = [0.0, 1.0, 0.0]\nheight = 2.0\n"
    "[volume.extinction]\nfield = \"f\"\npoints = [[0.0, 1.0], [1.0, 1.0]]\n"
    "[volume.color]\nfield = \"f\"\npoints = [[0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0]]\n";

class Messages : public ToolFolder {
 protected:
  void SetUp() override {
    ToolFolder::SetUp();
    ZooMesh mesh = structured(4, Cut::tetrahedra);
    add_node_field(mesh, "f", [](const Position& p) { return p[0]; });
    write_zoo_file(file("m.zoo"), {mesh, {}});
    write("v.toml", kView);
  }
  [[nodiscard]] int run(const std::string& command) const {
    return ToolFolder::run("CHECK='" HIAC_CHECK "'; INFO='" HIAC_INFO "'; " + command);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
  }
  [[nodiscard]] ZooMesh mesh() const { return read_zoo_file(file("m.zoo")).mesh; }
};

TEST_F(Messages, AFileThatCannotGrowIsTheReason) {
  for (const char* extension : {".zoo", ".vtu", ".vtkhdf", ".msh", ".stl", ".ply", ".vtp"}) {
    const std::string name = std::string("out") + extension;
    EXPECT_EQ(run("ulimit -f 2; $CONVERT m.zoo -o " + name), 3);
    EXPECT_THAT(complaint(), AllOf(HasSubstr(name + ": cannot be written (File too large)"),
                                   Not(HasSubstr("0x")), Not(HasSubstr("read"))));
    EXPECT_FALSE(fs::exists(file(name)));
  }
  for (const char* extension : {".tiff", ".png", ".npy", ".exr"}) {
    const std::string name = std::string("out") + extension;
    EXPECT_EQ(
        run("ulimit -f 2; $RENDER m.zoo --view v.toml --size 200x150 -o " + name + " --depth " +
            (extension == std::string(".npy")   ? "64"
             : extension == std::string(".exr") ? "32"
                                                : "16")),
        3);
    EXPECT_THAT(complaint(), HasSubstr(name + ": cannot be written (File too large)"));
    EXPECT_FALSE(fs::exists(file(name)));
  }
}

TEST_F(Messages, ControlCharactersOfFilesAreNotPrinted) {
  ZooMesh named = mesh();
  named.fields[0].name = "f\x1b[31m\a\xc2\x9b!";
  named.metadata.emplace_back("source", "a\x1b]0;b");
  write_zoo_file(file("n.zoo"), {named, {}});
  EXPECT_EQ(run("$INFO n.zoo && $CONVERT --list n.zoo && $CONVERT n.zoo -v -o x.zoo"), 0);
  for (const std::string& text : {bytes_of(file("out.txt")), complaint()})
    EXPECT_THAT(text, AllOf(Not(HasSubstr("\x1b")), Not(HasSubstr("\a")), Not(HasSubstr("\x9b"))));
  EXPECT_THAT(bytes_of(file("out.txt")), HasSubstr("[31m"));
  EXPECT_EQ(run("$RENDER n.zoo --view v.toml -o x.png"), 2);
  EXPECT_THAT(complaint(), Not(HasSubstr("\x1b")));
  EXPECT_EQ(run("$CONVERT \"$(printf 'no\\033[2Jfile')\" -o x.zoo"), 3);
  EXPECT_THAT(complaint(), Not(HasSubstr("\x1b")));
}

TEST_F(Messages, OverridesAreBlamedForWhatTheyBreak) {
  for (const char* option :
       {"camera.fov=-1 --set camera.projection=perspective", "nothing.at=all", "image.width=x",
        "camera.look_at=[0.5,0.5,-3.0]", "camera.up=[0,0,1]",
        "volume.color.points=[[1,0,0,0],[0,0,0,0]]", "volume.color.preset=no-such-preset"}) {
    const std::string set = std::string(" --set ") + option;
    EXPECT_EQ(run("$RENDER m.zoo --view v.toml -o x.png" + set), 2) << option << complaint();
    EXPECT_THAT(complaint(), HasSubstr("--set ")) << option;
    EXPECT_EQ(run("$SORT m.zoo --view v.toml -o x.order" + set), 2) << option << complaint();
  }
}

TEST_F(Messages, ErrorsInAMeshNameItsFile) {
  ZooMesh broken = mesh();
  std::vector<double> values(broken.fields[0].values.begin(), broken.fields[0].values.end());
  values[3] = std::numeric_limits<double>::quiet_NaN();
  broken.fields[0].values = std::move(values);
  write_zoo_file(file("nan.zoo"), {broken, {}});
  EXPECT_EQ(run("$RENDER nan.zoo --view v.toml -o x.png"), 3);
  EXPECT_THAT(complaint(), HasSubstr("hiac-render: nan.zoo: "));
  ZooMesh turned = structured(1, Cut::bricks);
  std::vector<NodeId> nodes(turned.nodes.begin(), turned.nodes.end());
  std::swap(nodes[0], nodes[1]);
  turned.nodes = std::move(nodes);
  add_node_field(turned, "f", [](const Position& p) { return p[0]; });
  write_zoo_file(file("turned.zoo"), {turned, {}});
  EXPECT_EQ(run("$RENDER turned.zoo --view v.toml -o x.png"), 3);
  EXPECT_THAT(complaint(), AllOf(HasSubstr("hiac-render: turned.zoo: "),
                                 HasSubstr("--skip-invalid leaves such cells out")));
}

TEST_F(Messages, AForeignFileIsReadByTheConverter) {
  ASSERT_EQ(run("$CONVERT m.zoo -o m.vtu && gzip -k m.vtu && gzip -k m.zoo"), 0);
  ASSERT_EQ(run("$RENDER m.zoo --view v.toml -o m.png"), 0) << complaint();
  ASSERT_EQ(run("$SORT m.zoo --view v.toml -o m.order"), 0) << complaint();
  const std::string told = "m.vtu is not a zoo mesh: read by hiac-convert";
  EXPECT_EQ(run("$RENDER m.vtu --view v.toml -o x.png"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr(told));
  EXPECT_EQ(run("$SORT m.vtu --view v.toml -o x.order"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr(told));
  EXPECT_EQ(bytes_of(file("x.order")), bytes_of(file("m.order")));
  EXPECT_EQ(run("$RENDER m.vtu --order m.order --view v.toml -o x.png"), 0) << complaint();
  EXPECT_EQ(run("$CHECK m.vtu -o x.zoo"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr(told));
  EXPECT_EQ(run("$INFO m.vtu"), 0) << complaint();
  EXPECT_THAT(bytes_of(file("out.txt")), HasSubstr("384 tetrahedron4"));
  // of a file of the converter's nothing is lost
  EXPECT_EQ(run("$CHECK m.vtu -o m.vtu"), 2);
  EXPECT_EQ(run("$RENDER m.vtu --view v.toml -q -o x.png"), 0);
  EXPECT_EQ(complaint(), "");
}

// A picture shows what the zoo has no kind for as well as it can, says so, and says nothing of it
// where nothing was approximated.
TEST_F(Messages, APictureOfAForeignFileApproximatesCellsWithoutAKind) {
  std::string points;
  for (const int z : {0, 1})
    for (const char* at : {"2 0", "1 2", "-1 2", "-2 0", "-1 -2", "1 -2"})
      points += fmt::format("{} {} ", at, z);
  static_cast<void>(folder_.write(
      "hexagon.vtu",
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">"
      "<UnstructuredGrid><Piece NumberOfPoints=\"12\" NumberOfCells=\"1\"><Points>"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
          points +
          "</DataArray></Points><Cells>"
          "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">"
          "0 1 2 3 4 5 6 7 8 9 10 11</DataArray>"
          "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">12</DataArray>"
          "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">16</DataArray>"
          "</Cells></Piece></UnstructuredGrid></VTKFile>\n"));
  EXPECT_EQ(run("$RENDER hexagon.vtu -o x.png"), 0) << complaint();
  EXPECT_THAT(complaint(), AllOf(HasSubstr("read by hiac-convert --approximate hexagon.vtu"),
                                 HasSubstr("hiac-convert: divided 1 polyhedra into")));
  for (const char* exact : {"--strict", "--convert --skip-unsupported"}) {
    EXPECT_EQ(run(std::string("$RENDER hexagon.vtu -o y.png ") + exact), 3) << exact;
    EXPECT_THAT(complaint(), HasSubstr("HexagonalPrism")) << exact;
  }
  EXPECT_EQ(run("$CONVERT hexagon.vtu --approximate -o h.zoo"), 0) << complaint();
  EXPECT_EQ(run("$RENDER h.zoo -o y.png"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("h.zoo: divided 1 polyhedra into"));
  ASSERT_EQ(run("$CONVERT m.zoo -o m.vtu"), 0);
  EXPECT_EQ(run("$RENDER m.vtu --view v.toml -o x.png"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("read by hiac-convert m.vtu"));
}

TEST_F(Messages, AForeignStreamIsSentToTheConverter) {
  ASSERT_EQ(run("$CONVERT m.zoo -o m.vtu && gzip -k m.vtu"), 0);
  for (const std::string command :
       {"$RENDER --view v.toml -o x.png", "$RENDER - --view v.toml -o x.png",
        "$SORT --view v.toml -o x.order", "$CHECK -o x.zoo", "$INFO"}) {
    EXPECT_EQ(run("cat m.vtu | " + command), 3) << command;
    EXPECT_THAT(complaint(),
                AllOf(HasSubstr("stdin: is not a zoo mesh (hiac-convert --format NAME"),
                      testing::EndsWith("names)\n")))
        << command;
    EXPECT_EQ(std::ranges::count(complaint(), '\n'), 1) << complaint();
  }
  EXPECT_EQ(run("$CHECK -o x.zoo < m.vtu.gz"), 3);
  EXPECT_THAT(complaint(), HasSubstr("stdin: is not a zoo mesh, packed by gzip (hiac-convert"));
  EXPECT_EQ(run("$CONVERT --format vtu < m.vtu | $CHECK -o x.zoo"), 0) << complaint();
  EXPECT_EQ(run("$CONVERT m.vtu.gz -o x.zoo"), 3);
  EXPECT_THAT(complaint(), HasSubstr("m.vtu.gz: is a vtu file packed by gzip"));
}

TEST_F(Messages, TheConvertersOptionsAndFailuresPassThrough) {
  ASSERT_EQ(run("$CONVERT m.zoo -o m.vtu && gzip -k m.vtu && gzip -k m.zoo"), 0);
  EXPECT_EQ(run("$INFO m.vtu --convert '--field \"f=speed\"'"), 0) << complaint();
  EXPECT_THAT(bytes_of(file("out.txt")), HasSubstr("speed"));
  EXPECT_EQ(run("$INFO m.vtu --convert=--field=f=speed"), 0) << complaint();
  EXPECT_EQ(run("$INFO m.vtu --convert '--step 99'"), 2);
  EXPECT_THAT(complaint(), HasSubstr("hiac-info: --step 99: m.vtu holds one step"));
  EXPECT_EQ(run("$INFO m.vtu --convert \"--field 'f\""), 2);
  EXPECT_THAT(complaint(), HasSubstr("--convert: a quote is not closed"));
  EXPECT_EQ(run("$INFO m.zoo --convert '--step 0'"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--convert: m.zoo is not a foreign file"));
  for (const std::string packed : {"m.zoo.gz", "m.vtu.gz"}) {
    EXPECT_EQ(run("$RENDER " + packed + " --view v.toml -o y.png"), 3) << packed;
    EXPECT_THAT(complaint(), HasSubstr("packed by gzip"));
    EXPECT_FALSE(fs::exists(file("y.png")));
  }
  EXPECT_EQ(run("$RENDER v.toml --view v.toml -o x.png"), 3);
  EXPECT_THAT(complaint(), HasSubstr("v.toml: is an image specification"));
  EXPECT_EQ(run(": > empty.zoo; $RENDER empty.zoo --view v.toml -o x.png"), 3);
  EXPECT_THAT(complaint(), HasSubstr("hiac-render: empty.zoo: stream ended before"));
}

TEST_F(Messages, WithoutAViewThePictureIsOfTheStarterView) {
  EXPECT_EQ(run("$RENDER m.zoo --size 64x48 --save-view s.toml -o a.png"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("shows 'f'"));
  EXPECT_EQ(run("$RENDER m.zoo --view s.toml -o b.png"), 0) << complaint();
  EXPECT_EQ(bytes_of(file("a.png")), bytes_of(file("b.png")));
  EXPECT_EQ(run("$INFO m.zoo --starter-view --field f --preset inferno --isovalues 2 --dark"), 0);
  EXPECT_THAT(bytes_of(file("out.txt")), HasSubstr("preset = \"inferno\""));
  EXPECT_EQ(run("$RENDER m.zoo --size 64x48 --field g -o c.png"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--field 'g': there is no such"));
  EXPECT_EQ(run("$RENDER m.zoo --size 64x48 --set volume.glow=dim -o c.png"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--set volume.glow=dim"));
  EXPECT_EQ(run("$RENDER m.zoo --view v.toml --field f -o c.png"), 2);
  EXPECT_EQ(run("$RENDER m.zoo --view v.toml --save-view t.toml -o c.png"), 2);
  EXPECT_EQ(run("$RENDER m.zoo --size 0x48 -o c.png"), 2);
  EXPECT_EQ(run("$INFO m.zoo --preset inferno"), 2);
  EXPECT_FALSE(fs::exists(file("c.png")));
}

TEST_F(Messages, TheUmbrellaRunsEveryCommand) {
  const std::string hiac = "'" HIAC_UMBRELLA "' ";
  EXPECT_EQ(run(hiac + "convert m.zoo -o m.vtu"), 0) << complaint();
  EXPECT_EQ(run(hiac + "picture m.vtu --size 32x24"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("hiac: the picture is m.png"));
  EXPECT_TRUE(fs::exists(file("m.png")));
  EXPECT_EQ(run(hiac + "picture m.vtu --size 32x24 -o n.png"), 0) << complaint();
  EXPECT_EQ(bytes_of(file("m.png")), bytes_of(file("n.png")));
  EXPECT_EQ(run(hiac + "info nothing.zoo"), 3);
  EXPECT_EQ(run(hiac + "convrt m.zoo"), 2);
  EXPECT_THAT(complaint(), HasSubstr("no such command: convrt (did you mean convert?)"));
  EXPECT_EQ(run(hiac), 2);
  EXPECT_EQ(run(hiac + "picture"), 2);
  EXPECT_EQ(run(hiac + "help"), 0);
  EXPECT_THAT(bytes_of(file("out.txt")), HasSubstr("hiac picture run.inp"));
  EXPECT_EQ(run(hiac + "help convert"), 0);
  EXPECT_THAT(bytes_of(file("out.txt")), HasSubstr("--list-formats"));
  EXPECT_EQ(run(hiac + "--version"), 0);
}

TEST_F(Messages, NamesThatAreNoTextAreReported) {
  EXPECT_EQ(run("$CHECK \"$(printf 'no\\377such')\" --json facts.json -o x.zoo"), 3);
  EXPECT_THAT(bytes_of(file("facts.json")),
              AllOf(HasSubstr("cannot be opened"), HasSubstr("\"exit_code\": 3")));
}

TEST_F(Messages, AnOptionThatIsAlmostOneIsGuessed) {
  for (const auto& [given, meant] : {std::pair<const char*, const char*>{"--siz 8x6", "--size"},
                                     {"--sizze=8x6", "--size"},
                                     {"--veiw v.toml", "--view"},
                                     {"--skip-invald", "--skip-invalid"}}) {
    EXPECT_EQ(run(std::string("$RENDER m.zoo --view v.toml -o x.png ") + given), 2);
    EXPECT_THAT(complaint(), HasSubstr("did you mean " + std::string(meant) + "?")) << given;
  }
  EXPECT_EQ(run("$RENDER m.zoo --view v.toml -o x.png --qqqqqqqq"), 2);
  EXPECT_THAT(complaint(), Not(HasSubstr("did you mean")));
}

TEST_F(Messages, StrictLeavesNoPictureThatMayMislead) {
  // one cell within another: no order of the two is right
  ZooMesh nested = side_by_side(
      structured(1, Cut::bricks), moved(structured(1, Cut::bricks), [](const Position& p) {
        return Position{0.25 + p[0] / 2, 0.25 + p[1] / 2, 0.25 + p[2] / 2};
      }));
  add_node_field(nested, "f", [](const Position& p) { return p[0]; });
  write_zoo_file(file("nested.zoo"), {nested, {}});
  EXPECT_EQ(run("$RENDER nested.zoo --view v.toml -o a.png"), 0) << complaint();
  ASSERT_THAT(complaint(), HasSubstr("met out of order"));
  EXPECT_EQ(run("$RENDER nested.zoo --view v.toml -o b.png --strict"), 1);
  EXPECT_THAT(complaint(), HasSubstr("b.png: not written"));
  EXPECT_FALSE(fs::exists(file("b.png")));
  const std::string aside = " --set camera.eye=[9,9,-3] --set camera.look_at=[9,9,0]";
  EXPECT_EQ(run("$RENDER m.zoo --view v.toml -o c.png" + aside), 0) << complaint();
  EXPECT_EQ(run("$RENDER m.zoo --view v.toml -o d.png --strict" + aside), 1);
  EXPECT_THAT(complaint(), HasSubstr("no cell is seen"));
  EXPECT_FALSE(fs::exists(file("d.png")));
  EXPECT_EQ(run("$RENDER m.zoo --view v.toml -o e.png --strict"), 0) << complaint();
}

TEST_F(Messages, AnOrderServesEveryFieldOfOneGeometry) {
  ZooMesh later = mesh();
  later.fields.clear();
  add_node_field(later, "f", [](const Position& p) { return 1 - p[1]; });
  write_zoo_file(file("later.zoo"), {later, {}});
  ASSERT_EQ(run("$SORT m.zoo --view v.toml -o m.order"), 0) << complaint();
  EXPECT_EQ(run("$RENDER later.zoo --view v.toml --order m.order -o a.png"), 0) << complaint();
  EXPECT_EQ(run("$RENDER later.zoo --view v.toml -o b.png"), 0) << complaint();
  EXPECT_EQ(run("$RENDER m.zoo --view v.toml -o c.png"), 0) << complaint();
  EXPECT_NE(bytes_of(file("a.png")), bytes_of(file("c.png")));
}

TEST_F(Messages, TimesAreToldAsTheyAreMeant) {
  std::string sets;
  for (const char* time : {"0", "0.30000000000000004", "1e-3", "2"}) {
    ZooMesh step = mesh();
    step.fields.clear();
    const double value = std::stod(time);
    add_node_field(step, "f", [value](const Position&) { return value; });
    write_zoo_file(file("step.zoo"), {step, {}});
    const std::string name = std::string("s") + time + ".vtu";
    ASSERT_EQ(run("$CONVERT step.zoo -o " + name), 0);
    sets += "<DataSet timestep=\"" + std::string(time) + "\" file=\"" + name + "\"/>";
  }
  write("a.pvd", "<VTKFile type=\"Collection\"><Collection>" + sets + "</Collection></VTKFile>");
  EXPECT_EQ(run("$CONVERT --list a.pvd"), 0) << complaint();
  EXPECT_THAT(bytes_of(file("out.txt")),
              HasSubstr("step    0, time 0\nstep    1, time 0.001\nstep    2, time 0.3\nstep    3, "
                        "time 2\n"));
  const auto taken = [&](const std::string& choice) {
    EXPECT_EQ(run("$CONVERT a.pvd -o t.zoo --time " + choice), 0) << complaint();
    return read_zoo_file(file("t.zoo")).mesh.fields[0].values[0];
  };
  EXPECT_EQ(taken("0.3"), 0.30000000000000004);
  EXPECT_EQ(taken("nearest:0.9"), 0.30000000000000004);
  EXPECT_EQ(taken("nearest:1e9"), 2);
  EXPECT_EQ(taken("nearest:-5"), 0);
  EXPECT_EQ(run("$CONVERT a.pvd -o t.zoo --time 0.9"), 2);
  EXPECT_THAT(complaint(), HasSubstr("has no such time (its neighbours are 0.3 and 2; --time "
                                     "nearest:TIME takes the nearest"));
  EXPECT_EQ(run("$CONVERT a.pvd -o t.zoo --time 3"), 2);
  EXPECT_THAT(complaint(), HasSubstr("(its neighbours are 2, the last; "));
  EXPECT_EQ(run("$CONVERT a.pvd -o t.zoo --time nearest:x"), 2);
}

}  // namespace
}  // namespace hiac::test

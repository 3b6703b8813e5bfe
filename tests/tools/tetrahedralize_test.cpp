#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Tetrahedralize : public testing::Test {
 protected:
  void SetUp() override { write("cube.off", kCube); }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  static std::string text_of(const std::string& file) { return test::bytes_of(file); }
  // $T stands for the tool; stderr goes to err.txt
  [[nodiscard]] int run(const std::string& command) const {
    const int status = std::system(("cd " + folder_.path().string() +
                                    " && T=" HIAC_TETRAHEDRALIZE " CONVERT=" HIAC_CONVERT " && (" +
                                    command + ") 2> err.txt")
                                       .c_str());
    return WEXITSTATUS(status);
  }
  [[nodiscard]] std::string errors() const { return text_of(path("err.txt")); }
  [[nodiscard]] ZooMesh mesh(const std::string& name) const {
    return read_zoo_file(path(name)).mesh;
  }

  static constexpr const char* kCube =
      "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
      "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  test::ScratchFolder folder_;
};

double volume_of(const ZooMesh& mesh) {
  long double sum = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto n = mesh.cell_nodes(cell);
    std::array<std::array<long double, 3>, 3> e;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        e[k][c] = static_cast<long double>(mesh.position(n[k + 1])[c]) - mesh.position(n[0])[c];
    sum += std::abs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                    e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                    e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]));
  }
  return static_cast<double>(sum / 6);
}

// By the divergence theorem: quadrilateral faces as four triangles around their middle, which for
// planar faces is their volume, and signed.
double volume_within_faces(const ZooMesh& mesh) {
  long double sum = 0;
  using Wide = std::array<long double, 3>;
  const auto det = [](const Wide& a, const Wide& b, const Wide& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell_nodes(cell);
    const auto origin = mesh.position(nodes[0]);
    long double cell_sum = 0;
    for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces) {
      const std::size_t count = face.corner_count;
      std::array<Wide, 4> p;
      Wide middle{};
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t c = 0; c < 3; ++c) {
          p[k][c] = static_cast<long double>(mesh.position(nodes[face.corners[k]])[c]) - origin[c];
          middle[c] += p[k][c] / static_cast<long double>(count);
        }
      for (std::size_t k = 0; k < count; ++k) cell_sum += det(middle, p[k], p[(k + 1) % count]);
    }
    sum += std::abs(cell_sum);
  }
  return static_cast<double>(sum / 6);
}

TEST_F(Tetrahedralize, FillsAClosedSurface) {
  ASSERT_EQ(run("$T cube.off --quality 1.5 --max-volume 0.01 --json facts.json -o cube.zoo"), 0);
  EXPECT_NEAR(volume_of(mesh("cube.zoo")), 1, 1e-12);
  const auto facts = nlohmann::json::parse(text_of(path("facts.json")));
  EXPECT_EQ(facts["cells"], mesh("cube.zoo").cell_count());
  EXPECT_TRUE(facts["surface_defects"]["open_edges"].empty());
}

TEST_F(Tetrahedralize, PassesTheMeshOnInAPipe) {
  ASSERT_EQ(run("$T -q cube.off --max-volume 0.05 > piped.zoo; $T -q cube.off --max-volume 0.05 -o "
                "file.zoo; cmp piped.zoo file.zoo"),
            0);
}

TEST_F(Tetrahedralize, NamesWhatASurfaceLacks) {
  const std::string cube = kCube;
  write("open.off", "OFF\n8 5 0\n" + cube.substr(10, cube.size() - 10 - 10));
  EXPECT_EQ(run("$T open.off -o no.zoo"), 1);
  EXPECT_THAT(errors(), HasSubstr("open edges: "));
  EXPECT_THAT(errors(), HasSubstr("open.off: the surface is not closed"));
  write("crossing.off",
        "OFF\n8 8 0\n0 0 0\n3 0 0\n0 3 0\n0 0 3\n0.5 0.5 0.5\n4 0 0\n0 4 0\n0 0 4\n"
        "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n");
  EXPECT_EQ(run("$T crossing.off --max-ids 2 --json facts.json -o no.zoo"), 1);
  EXPECT_THAT(errors(), HasSubstr("pairs of triangles that intersect: "));
  EXPECT_FALSE(std::filesystem::exists(path("no.zoo")));
  const auto facts = nlohmann::json::parse(text_of(path("facts.json")));
  EXPECT_FALSE(facts["surface_defects"]["intersecting_triangles"].empty());
}

/// A cube of that corner and edge, of twelve triangles oriented outwards, or inwards.
std::string cube_stl(double low, double edge, bool inwards) {
  std::string text;
  const std::array<std::array<int, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& q : faces)
    for (const auto& t : {std::array{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (std::size_t k = 0; k < 3; ++k) {
        const int c = t[inwards ? 2 - k : k];
        text += fmt::format("vertex {} {} {}\n", low + edge * (c % 2), low + edge * (c / 2 % 2),
                            low + edge * (c / 4));
      }
      text += "endloop\nendfacet\n";
    }
  return text;
}

TEST_F(Tetrahedralize, OrientationAndPointsSayWhatStaysEmpty) {
  const auto region_volumes = [&](const char* name) {
    const ZooMesh whole = mesh(name);
    EXPECT_EQ(whole.fields.at(0).name, "region");
    return std::pair(volume_of(whole), std::ranges::max(whole.fields.at(0).values));
  };
  for (const bool inwards : {true, false}) {
    write("nested.stl",
          "solid a\n" + cube_stl(0, 3, false) + cube_stl(1, 1, inwards) + "endsolid a\n");
    ASSERT_EQ(run("$T nested.stl --json facts.json -o nested.zoo"), 0) << errors();
    const auto [volume, regions] = region_volumes("nested.zoo");
    EXPECT_NEAR(volume, inwards ? 26 : 27, 1e-12);
    EXPECT_EQ(regions, inwards ? 1 : 2);
    EXPECT_THAT(errors(), HasSubstr(inwards ? "encloses 2 parts: 1 are filled, 1 stay empty"
                                            : "encloses 2 parts: 2 are filled, 0 stay empty"));
    EXPECT_EQ(errors().find("in shells within shells") == std::string::npos, inwards);
    const auto parts = nlohmann::json::parse(text_of(path("facts.json")))["parts"];
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0]["winding"], 1);
    EXPECT_EQ(parts[1]["winding"], inwards ? 0 : 2);
    EXPECT_EQ(parts[1].contains("region"), !inwards);
    ASSERT_EQ(run("$T nested.stl --hole 1.5,1.5,1.5 -o hollow.zoo"), 0) << errors();
    EXPECT_NEAR(volume_of(mesh("hollow.zoo")), 26, 1e-12);
  }
  ASSERT_EQ(run("$T nested.stl --hole 2.5,2.5,2.5 -o inner.zoo"), 0) << errors();
  EXPECT_NEAR(volume_of(mesh("inner.zoo")), 1, 1e-12);
  const std::pair<const char*, const char*> wrong[] = {
      {"--hole 1,2", "expected X,Y,Z"},
      {"--hole 1,2,3x", "expected X,Y,Z"},
      {"--hole 1,2,inf", "expected X,Y,Z"},
      {"--hole=", "X,Y,Z"},
      {"--hole 4,1,1", "--hole 4,1,1: the point is outside"},
      {"--hole 1,1.5,1.5", "--hole 1,1.5,1.5: the point is on the surface"}};
  for (const auto& [arguments, message] : wrong) {
    EXPECT_EQ(run(std::string("$T nested.stl -o no.zoo ") + arguments), 2) << arguments;
    EXPECT_THAT(errors(), HasSubstr(message));
  }
  EXPECT_EQ(run("$T nested.stl --hole 1.5,1.5,1.5 --hole 0.5,0.5,0.5 -o no.zoo"), 1);
  EXPECT_THAT(errors(), HasSubstr("nested.stl: all parts that the surface encloses are holes"));
}

TEST_F(Tetrahedralize, ShellsThatDoNotSayWhatIsInsideAreToldOf) {
  write("inwards.stl", "solid a\n" + cube_stl(0, 1, true) + cube_stl(2, 1, false) + "endsolid a\n");
  ASSERT_EQ(run("$T inwards.stl -o inwards.zoo"), 0) << errors();
  EXPECT_THAT(errors(), HasSubstr("1 parts are in shells that are oriented inwards"));
  EXPECT_NEAR(volume_of(mesh("inwards.zoo")), 2, 1e-12);
  // one triangle of the cavity is turned over
  std::string shells = "solid a\n" + cube_stl(0, 3, false) + cube_stl(1, 1, true) + "endsolid a\n";
  const std::size_t first = shells.rfind("outer loop\n") + 11;
  const std::size_t second = shells.find('\n', first) + 1;
  const std::size_t third = shells.find('\n', second) + 1;
  std::rotate(shells.begin() + static_cast<std::ptrdiff_t>(first),
              shells.begin() + static_cast<std::ptrdiff_t>(second),
              shells.begin() + static_cast<std::ptrdiff_t>(third));
  write("turned.stl", shells);
  ASSERT_EQ(run("$T turned.stl -o turned.zoo"), 0) << errors();
  EXPECT_THAT(errors(), HasSubstr("3 edges have triangles that are oriented against one another"));
  EXPECT_NEAR(volume_of(mesh("turned.zoo")), 27, 1e-12);
  // nothing is said where orientation decides nothing
  ASSERT_EQ(run("$T cube.off -o cube.zoo"), 0);
  EXPECT_THAT(errors(), Not(HasSubstr("orient")));
}

// The boundary of a mesh encloses what its cells fill.
TEST_F(Tetrahedralize, FillsTheBoundaryOfAMesh) {
  write("shifted.stl",
        "solid a\n" + cube_stl(0.1, 3, false) + cube_stl(1.1, 1, true) + "endsolid\n");
  ASSERT_EQ(run("$T shifted.stl --max-volume 0.3 -o m.zoo"), 0) << errors();
  const double volume = volume_of(mesh("m.zoo"));
  EXPECT_NEAR(volume, 26, 1e-12);
  for (const char* extension : {"stl", "ply", "vtp"})
    for (const char* levels : {"", "--levels 1 "}) {
      SCOPED_TRACE(extension);
      ASSERT_EQ(run(fmt::format("$CONVERT m.zoo {}-o b.{}", levels, extension)), 0) << errors();
      ASSERT_EQ(run(fmt::format("$T b.{} -o back.zoo", extension)), 0) << errors();
      const double tolerance = extension == std::string("stl") ? 1e-6 : 1e-12;
      EXPECT_NEAR(volume_of(mesh("back.zoo")), volume, volume * tolerance);
    }
  // of quadratic cells: straight, so that subdivision changes nothing
  write("q.inp",
        "*NODE\n1, 0, 0, 0\n2, 2, 0, 0\n3, 0, 2, 0\n4, 0, 0, 2\n5, 1, 0, 0\n6, 1, 1, 0\n"
        "7, 0, 1, 0\n8, 0, 0, 1\n9, 1, 0, 1\n10, 0, 1, 1\n*ELEMENT, TYPE=C3D10\n"
        "1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10\n");
  ASSERT_EQ(run("$CONVERT q.inp --json facts.json -o q.ply && $T q.ply -o q.zoo"), 0) << errors();
  EXPECT_NEAR(volume_of(mesh("q.zoo")), 8.0 / 6, 1e-14);
  const auto facts = nlohmann::json::parse(text_of(path("facts.json")));
  EXPECT_EQ(facts["boundary"]["levels"], 2);
  EXPECT_EQ(facts["boundary"]["triangles"], 64);
  EXPECT_EQ(run("$CONVERT m.zoo --levels 1 -o no.vtu"), 2);
  EXPECT_EQ(run("$CONVERT m.zoo --levels 1 > no.zoo"), 2);
  EXPECT_EQ(run("$CONVERT m.zoo --levels 7 -o no.ply"), 2);
  EXPECT_EQ(run("$CONVERT b.ply --format ply -o no.zoo"), 2);
  EXPECT_EQ(run("$CONVERT b.ply -o no.zoo"), 3);
  // a mesh is no surface
  ASSERT_EQ(run("$CONVERT m.zoo -o m.vtu"), 0);
  EXPECT_EQ(run("$T m.vtu -o no.zoo"), 3);
  EXPECT_THAT(errors(), HasSubstr("m.vtu: cell 0 is a Tetra (a surface of"));
  EXPECT_EQ(run("$T b.vtp --cells -o no.zoo"), 2);
}

TEST_F(Tetrahedralize, DoubledPointsAreWeldedWhereAsked) {
  // every triangle has corners of its own, as CAD programs write them, some of them a little off
  std::string points, triangles;
  const auto add = [&](std::array<double, 3> p) {
    points += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  };
  const std::array<std::array<double, 3>, 4> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::array<std::array<int, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  int number = 0;
  for (const auto& face : faces) {
    for (const int c : face) {
      auto p = corners[static_cast<std::size_t>(c)];
      p[0] += 1e-7 * (number % 3);
      add(p);
      ++number;
    }
    triangles += fmt::format("3 {} {} {}\n", number - 3, number - 2, number - 1);
  }
  write("seam.off", "OFF\n12 4 0\n" + points + triangles);
  EXPECT_EQ(run("$T seam.off -o no.zoo"), 1);
  EXPECT_THAT(errors(), AllOf(HasSubstr("12 open edges, "), HasSubstr("--weld TOL joins points")));
  ASSERT_EQ(run("$T seam.off --weld 1e-6 --json facts.json -o seam.zoo"), 0) << errors();
  EXPECT_THAT(errors(), HasSubstr("8 points became others"));
  EXPECT_NEAR(volume_of(mesh("seam.zoo")), 1.0 / 6, 1e-6);
  EXPECT_EQ(nlohmann::json::parse(text_of(path("facts.json")))["weld"]["points"], 8);
  EXPECT_EQ(run("$T seam.off --weld 1e-9 -o no.zoo"), 1);
}

TEST_F(Tetrahedralize, PointsInAPlaneButForRoundingAreWarnedOf) {
  // in a plane but for rounding, and one point above it
  std::string points = "2.5 2.5 4\n";
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      points += fmt::format("{} {} {}\n", i, j, (i * 7 + j * 3) % 5 * 1e-16);
  write("plane.xyz", points);
  ASSERT_EQ(run("$T plane.xyz --delaunay -o plane.zoo"), 0) << errors();
  const ZooMesh all = mesh("plane.zoo");
  std::size_t flat = 0;
  for (CellId cell = 0; cell < all.cell_count(); ++cell) {
    ZooMesh one;
    one.xyz = all.xyz;
    one.kinds = std::vector<CellKind>{CellKind::tetrahedron4};
    one.elems = std::vector<std::uint64_t>{0, 4};
    const auto nodes = all.cell_nodes(cell);
    one.nodes = std::vector<NodeId>(nodes.begin(), nodes.end());
    flat += volume_of(one) < 1e-6 ? 1 : 0;
  }
  EXPECT_GT(flat, 0U);
  EXPECT_LT(flat, all.cell_count());
  EXPECT_THAT(errors(), HasSubstr(fmt::format("{} of {} tetrahedra are nearly flat", flat,
                                              all.cell_count())));
  write("solid.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n");
  ASSERT_EQ(run("$T solid.xyz --delaunay -o solid.zoo"), 0) << errors();
  EXPECT_THAT(errors(), Not(HasSubstr("nearly flat")));
}

TEST_F(Tetrahedralize, NamesTheLibrariesThatMakeTetrahedra) {
  ASSERT_EQ(run("$T --version > version.txt"), 0);
  EXPECT_THAT(text_of(path("version.txt")),
              testing::ContainsRegex("CGAL [0-9]+\\.[0-9]+.*, GMP [0-9]+\\.[0-9]+.*, TetGen "
                                     "[0-9]+\\.[0-9]+"));
}

TEST_F(Tetrahedralize, JoinsPoints) {
  write("points.csv", "x,y,z,t\n0,0,0,1\n1,0,0,2\n0,1,0,3\n0,0,1,4\n1,1,1,5\n0,0,0,6\n");
  ASSERT_EQ(run("$T points.csv --delaunay -o points.zoo"), 0);
  EXPECT_THAT(errors(), HasSubstr("1 points lie at the place of another point"));
  const ZooMesh joined = mesh("points.zoo");
  EXPECT_NEAR(volume_of(joined), 0.5, 1e-15);
  ASSERT_EQ(joined.fields.size(), 1U);
  EXPECT_THAT(joined.fields[0].values.view(), testing::ElementsAre(1, 2, 3, 4, 5, 6));
  write("flat.csv", "0,0,0\n1,0,0\n0,1,0\n1,1,0\n");
  EXPECT_EQ(run("$T flat.csv --delaunay -o no.zoo"), 1);
}

TEST_F(Tetrahedralize, SaysWhatItCannotDo) {
  const std::pair<const char*, int> wrong[] = {
      {"cube.off --cells", 2},     {"cube.off --delaunay", 2},  {"cube.zoo", 2},
      {"cube.zoo --cells", 3},     {"points.csv", 2},           {"cube.off --linearize", 2},
      {"nothing.stl", 3},          {"cube.off --quality 0", 2}, {"cube.off --levels 2", 2},
      {"cube.off --levels 9", 2},  {"- --cells --levels 1", 2}, {"- --cells --max-volume 1", 2},
      {"- --cells < cube.off", 3}, {"--cells --delaunay", 2}};
  for (const auto& [arguments, code] : wrong) {
    EXPECT_EQ(run(std::string("$T -o no.zoo ") + arguments), code) << arguments << errors();
    EXPECT_FALSE(std::filesystem::exists(path("no.zoo")));
  }
}

// Real meshes of linear cells with planar faces: their tetrahedra fill the same volume.
TEST_F(Tetrahedralize, SaysWhichOptionsDoNotFit) {
  write("points.csv", "0,0,0\n1,0,0\n0,1,0\n0,0,1\n");
  const std::string surfaces =
      "--quality, --max-volume, --preserve-surface, --weld, --hole: only for surfaces";
  const std::pair<const char*, std::string> wrong[] = {
      {"points.csv", "a file of points is tetrahedralized with --delaunay"},
      {"cube.off --delaunay",
       "--delaunay: points expected (a mesh, .csv, .txt, .xyz or .node; the file of a surface "
       "found)"},
      {"cube.off --cells", "--cells: a zoo mesh expected"},
      {"points.csv --cells", "--cells: a zoo mesh expected"},
      {"points.csv --delaunay --quality 2", surfaces},
      {"points.csv --delaunay --max-volume 2", surfaces},
      {"points.csv --delaunay --preserve-surface", surfaces},
      {"points.csv --delaunay --weld 0.1", surfaces},
      {"points.csv --delaunay --hole 0,0,0", surfaces},
      {"- --cells --max-volume 1", surfaces},
      {"cube.off --linearize", "--linearize, --levels: only with --cells"},
      {"cube.off --levels 2", "--linearize, --levels: only with --cells"},
      {"points.csv --delaunay --linearize", "--linearize, --levels: only with --cells"},
      {"- --cells --levels 1", "--levels: only with --linearize"},
      {"cube.off --hole 1,2", "--hole: expected X,Y,Z (found 1,2)"},
      {"cube.off --hole 1,2,3,4", "--hole: expected X,Y,Z (found 1,2,3,4)"},
      {"cube.off --hole 1,2,nan", "--hole: expected X,Y,Z (found 1,2,nan)"},
      {"cube.off --hole 1,2,x", "--hole: expected X,Y,Z (found 1,2,x)"},
      {"cube.off --hole 1;2;3", "--hole: expected X,Y,Z (found 1;2;3)"},
  };
  for (const auto& [arguments, message] : wrong) {
    std::string quoted = arguments;
    if (const std::size_t at = quoted.find("--hole "); at != std::string::npos)
      quoted = quoted.substr(0, at + 7) + "'" + quoted.substr(at + 7) + "'";
    EXPECT_EQ(run("$T -o no.zoo " + quoted), 2) << arguments << errors();
    EXPECT_EQ(errors(), "hiac-tetrahedralize: " + message + "\n") << arguments;
  }
}

TEST_F(Tetrahedralize, SaysHowMuchBecameOfWhat) {
  write("points.csv", "0,0,0\n1,0,0\n0,1,0\n0,0,1\n");
  ASSERT_EQ(run("$T points.csv --delaunay -o points.zoo"), 0) << errors();
  EXPECT_EQ(errors(), "hiac-tetrahedralize: 1 tetrahedra, 4 nodes\n");
  ASSERT_EQ(run("$T points.zoo --cells -o same.zoo"), 0) << errors();
  EXPECT_EQ(
      errors(),
      "hiac-tetrahedralize: 1 cells became 1 tetrahedra; 0 nodes are new, 0 no longer needed\n"
      "hiac-tetrahedralize: 1 tetrahedra, 4 nodes\n");
  ASSERT_EQ(run("$T points.zoo --cells --linearize --levels 1 -o parts.zoo"), 0) << errors();
  EXPECT_EQ(
      errors(),
      "hiac-tetrahedralize: 1 cells became 8 tetrahedra; 6 nodes are new, 0 no longer needed\n"
      "hiac-tetrahedralize: 8 tetrahedra, 10 nodes\n");
  // a corner of the cube once more, close to itself
  write("doubled.off",
        "OFF\n9 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n0 0 0.001\n"
        "4 8 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  ASSERT_EQ(run("$T doubled.off --weld 0.01 -o welded.zoo"), 0) << errors();
  EXPECT_THAT(errors(), HasSubstr("hiac-tetrahedralize: 1 points became others, at most 0.001 "
                                  "away; 0 facets are gone by that\n"));
}

TEST_F(Tetrahedralize, TetrahedraThatAreFlatOrInvertedAreCounted) {
  const auto write_cells = [&](const std::vector<NodeId>& nodes) {
    ZooMesh mesh;
    mesh.xyz = std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0};
    std::vector<std::uint64_t> elems;
    for (std::size_t k = 0; k <= nodes.size(); k += 4) elems.push_back(k);
    mesh.kinds = std::vector<CellKind>(nodes.size() / 4, CellKind::tetrahedron4);
    mesh.elems = std::move(elems);
    mesh.nodes = std::vector<NodeId>(nodes);
    write_zoo_file(path("cells.zoo"), {mesh, {}});
  };
  write_cells({0, 1, 2, 3, 0, 1, 2, 4, 0, 2, 1, 4});
  ASSERT_EQ(run("$T cells.zoo --cells -o x.zoo"), 0) << errors();
  EXPECT_THAT(errors(), HasSubstr("hiac-tetrahedralize: warning: 2 tetrahedra are flat\n"));
  EXPECT_THAT(errors(), Not(HasSubstr("inverted")));
  write_cells({0, 1, 2, 3, 1, 4, 2, 3, 1, 0, 2, 3});
  ASSERT_EQ(run("$T cells.zoo --cells -o x.zoo"), 0) << errors();
  EXPECT_THAT(errors(),
              HasSubstr("hiac-tetrahedralize: warning: 1 tetrahedra are inverted relative "
                        "to the other 2: their cells are not convex, or are turned inside "
                        "out (hiac-check names them)\n"));
  EXPECT_THAT(errors(), Not(HasSubstr("are flat")));
}

TEST_F(Tetrahedralize, CutsRealMeshesWithoutGap) {
  const char* named = std::getenv("HIAC_DATA_DIR");
  const std::string data = named != nullptr ? named : HIAC_DEFAULT_DATA_DIR;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no data";
  std::size_t met = 0;
  for (const char* name :
       {"vtk_legacy/linear/hexa.vtk", "vtk_legacy/classic/spx.vtk",
        "vtk_legacy/versions/mesh_vtk51.vtk", "vtk_xml/analytic/Wedge.vtu",
        "vtk_xml/analytic/Tetrahedron.vtu", "vtk_xml/analytic/QuadraticPyramid.vtu",
        "vtk_xml/analytic/QuadraticTetra.vtu"}) {
    const std::string source = data + "/" + name;
    if (!std::filesystem::exists(source)) continue;
    SCOPED_TRACE(name);
    ASSERT_EQ(run("$CONVERT -q '" + source +
                  "' -o m.zoo && $T -q m.zoo --cells -o t.zoo && $T -q "
                  "m.zoo --cells --linearize --levels 1 -o l.zoo"),
              0)
        << errors();
    const double volume = volume_within_faces(mesh("m.zoo"));
    EXPECT_NEAR(volume_of(mesh("t.zoo")) / volume, 1, 1e-12);
    EXPECT_NEAR(volume_of(mesh("l.zoo")) / volume, 1, 1e-12);
    ++met;
  }
  if (met == 0) GTEST_SKIP() << "no data";
}

// Real meshes in all formats that hiac-check lets pass: it lets their tetrahedra pass, too, which
// fill the same volume where faces are planar. By default those of small files; HIAC_ALL_DATA=1
// takes all of them.
TEST_F(Tetrahedralize, CutsAllValidMeshesInValidTetrahedra) {
  const char* const named = std::getenv("HIAC_DATA_DIR");
  const std::filesystem::path data = named != nullptr ? named : HIAC_DEFAULT_DATA_DIR;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no " << data;
  const bool all = std::getenv("HIAC_ALL_DATA") != nullptr;
  std::size_t met = 0, number = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    if (!entry.is_regular_file()) continue;
    if (!all && (entry.file_size() > 60'000 || number++ % (4 / test::tried(4)) != 0)) continue;
    if (run("$CONVERT -q '" + entry.path().string() + "' -o m.zoo") != 0) continue;
    if (run("'" HIAC_CHECK "' -q m.zoo --overlap --json m.json -o /dev/null") != 0) continue;
    const ZooMesh cells = mesh("m.zoo");
    if (std::ranges::any_of(cells.kinds,
                            [](CellKind k) { return order_of(k) != CellOrder::linear; }))
      continue;
    SCOPED_TRACE(entry.path());
    ASSERT_EQ(run("$T -q m.zoo --cells -o t.zoo"), 0) << errors();
    EXPECT_EQ(run("'" HIAC_CHECK "' -q t.zoo -o /dev/null"), 0) << errors();
    ++met;
    if (text_of(path("m.json")).find("nonplanar_face") != std::string::npos) continue;
    const double volume = volume_within_faces(cells);
    EXPECT_NEAR(volume_of(mesh("t.zoo")) / volume, 1, 1e-12);
  }
  if (met == 0) GTEST_SKIP() << "no data";
}

}  // namespace
}  // namespace hiac

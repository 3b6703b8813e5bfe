// What hiac-convert does to a mesh between reading and writing it.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;

class EditsTest : public ToolFolder {
 protected:
  // Eight cubes; p = x, u = (0, 0, z), c = the cell's number.
  void SetUp() override {
    ToolFolder::SetUp();
    ZooMesh mesh = structured(2, Cut::bricks);
    std::vector<double> p, u, c;
    for (NodeId node = 0; node < mesh.node_count(); ++node) {
      const auto at = mesh.position(node);
      p.push_back(at[0]);
      u.insert(u.end(), {0, 0, at[2]});
    }
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) c.push_back(cell);
    mesh.fields.push_back({"p", "Pa", FieldLocation::node, 1, std::move(p)});
    mesh.fields.push_back({"u", "m", FieldLocation::node, 3, std::move(u)});
    mesh.fields.push_back({"c", "", FieldLocation::cell, 1, std::move(c)});
    write_zoo_file(file("in.zoo"), {mesh, {}});
  }

  [[nodiscard]] ZooMesh mesh_of(const std::string& name) const {
    return read_zoo_file(file(name)).mesh;
  }
};

TEST_F(EditsTest, FieldsAreDerivedFromFieldsAndFromDerivedFields) {
  ASSERT_EQ(run("$CONVERT -q in.zoo --derive 'a = 2*p' --derive 'b = a + magnitude(u)' "
                "--field c --field a=first -o out.zoo"),
            0)
      << complaint();
  const ZooMesh mesh = mesh_of("out.zoo");
  ASSERT_EQ(mesh.fields.size(), 4U);
  EXPECT_EQ(mesh.fields[0].name, "c");
  EXPECT_EQ(mesh.fields[1].name, "first");
  EXPECT_EQ(mesh.fields[2].name, "a");
  EXPECT_EQ(mesh.fields[3].name, "b");
  for (NodeId node = 0; node < mesh.node_count(); ++node) {
    const auto at = mesh.position(node);
    EXPECT_EQ(mesh.fields[1].values[node], 2 * at[0]);
    EXPECT_EQ(mesh.fields[3].values[node], 2 * at[0] + at[2]);
  }
}

TEST_F(EditsTest, ValuesThatAreNotFiniteAreTold) {
  ASSERT_EQ(run("$CONVERT in.zoo --derive 'q = 1/p' -o out.zoo"), 0);
  EXPECT_THAT(complaint(), HasSubstr("--derive q = 1/p: 9 of 27 values are not finite"));
}

TEST_F(EditsTest, ADeformedMeshNamesTheCellsTurnedInsideOut) {
  ASSERT_EQ(run("$CONVERT in.zoo --warp u:-0.5 --json facts.json -o half.zoo"), 0) << complaint();
  EXPECT_THAT(complaint(), testing::Not(HasSubstr("inside out")));
  const ZooMesh before = mesh_of("in.zoo"), half = mesh_of("half.zoo");
  for (std::size_t i = 0; i < before.xyz.size(); ++i)
    EXPECT_EQ(half.xyz[i], (i % 3 == 2 ? 0.5 : 1) * before.xyz[i]);
  const auto facts = nlohmann::json::parse(bytes_of(file("facts.json")));
  EXPECT_EQ(facts["warp"]["scale"], -0.5);
  EXPECT_EQ(facts["warp"]["inverted_cells"], 0);
  // the upper cubes are pushed through the lower ones' floor
  ASSERT_EQ(run("$CONVERT in.zoo --derive 'w=vector(0, 0, x > 0.75 ? 0 - 3*z : 0)' --warp w "
                "-o torn.zoo"),
            0)
      << complaint();
  EXPECT_THAT(complaint(), HasSubstr("--warp w: 4 cells of the deformed mesh are flat or inside "
                                     "out, wholly or in part (the first is cell "));
}

TEST_F(EditsTest, AThresholdKeepsWholeCells) {
  ASSERT_EQ(run("$CONVERT -q in.zoo --threshold c=2,5 -o some.zoo"), 0) << complaint();
  const ZooMesh some = mesh_of("some.zoo");
  ASSERT_EQ(some.cell_count(), 4U);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(some.fields[2].values[k], 2.0 + static_cast<double>(k));
  ASSERT_TRUE(some.adjacency.has_value());
  EXPECT_EQ(some.adjacency->neighbors.size(), 24U);
  ASSERT_EQ(run("$CONVERT -q in.zoo --threshold u:z=0.5, -o upper.zoo"), 0) << complaint();
  EXPECT_EQ(mesh_of("upper.zoo").cell_count(), 4U);
  ASSERT_EQ(run("$CONVERT -q in.zoo --derive 'q=p' --threshold q=,0.5 -o left.zoo"), 0);
  EXPECT_EQ(mesh_of("left.zoo").cell_count(), 4U);
  EXPECT_EQ(run("$CONVERT in.zoo --threshold p=0.1,0.2 -o none.zoo"), 3);
  EXPECT_THAT(complaint(), HasSubstr("no cell has all of its values within these bounds"));
}

TEST_F(EditsTest, WrongUsageNamesTheOption) {
  const std::vector<std::pair<std::string, std::string>> rows{
      {"--derive 'q=w'", "--derive q=w: field 'w'"},
      {"--warp w", "--warp w: there is no such field"},
      {"--warp u:fast", "--warp u:fast: FIELD or FIELD:SCALE expected"},
      {"--warp p", "--warp p: field 'p' moves no nodes"},
      {"--threshold p", "--threshold p: FIELD=LOW,HIGH expected"},
      {"--threshold p=1", "--threshold p=1: FIELD=LOW,HIGH expected"},
      {"--threshold p=a,1", "--threshold p=a,1: 'a' is no number"},
      {"--threshold p=2,1", "--threshold p=2,1: LOW is above HIGH"},
      {"--threshold u=0,1", "--threshold u=0,1: field 'u'"}};
  for (const auto& [arguments, message] : rows) {
    EXPECT_EQ(run("$CONVERT in.zoo " + arguments + " -o out.zoo"), 2) << arguments;
    EXPECT_THAT(complaint(), HasSubstr(message)) << arguments;
  }
}

}  // namespace
}  // namespace hiac::test

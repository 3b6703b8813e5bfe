// Ranges that are left to the fields' values, found by the parts of a mesh.
#include "hiac/cluster/whole_ranges.hpp"

#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/parted/split_mesh.hpp"
#include "hiac/session/session.hpp"
#include "tests/cluster/parts_of.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

ParsedScene specification(const std::string& color, const std::string& extinction,
                          const std::string& range) {
  return parse_scene(
      "[image]\nwidth = 9\nheight = 9\n[camera]\neye = [3.0, 0.0, 0.0]\n"
      "look_at = [0.0, 0.0, 0.0]\nup = [0.0, 0.0, 1.0]\nfov = 30.0\n"
      "[volume.color]\nfield = \"" +
          color + "\"\npoints = [[0.0, 0.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0]]\n" + range +
          "[volume.extinction]\nfield = \"" + extinction +
          "\"\npoints = [[0.0, 0.0], [1.0, 1.0]]\n" + range,
      "test");
}

void expect_whole(const ZooMesh& mesh, std::uint32_t parts, const ParsedScene& parsed) {
  const ParsedScene whole = with_field_ranges(parsed, mesh);
  std::mt19937_64 random(parts);
  std::vector<std::uint32_t> part_of_cell(mesh.cell_count());
  for (std::uint32_t& part : part_of_cell) part = static_cast<std::uint32_t>(random() % parts);
  const std::vector<MeshPart> split = split_mesh(mesh, part_of_cell, parts);
  for (const std::uint32_t ranks : test::tried(std::vector{3U, 1U}))
    test::run_ranks(ranks, [&](Communicator& all) {
      std::vector<NumberedPart> own;
      for (std::uint32_t part = all.rank(); part < parts; part += ranks)
        own.push_back({part, split[part].mesh, split[part].global_nodes.view()});
      const ParsedScene found = with_whole_ranges(all, own, parsed);
      EXPECT_EQ(found.scene.volume.color, whole.scene.volume.color);
      EXPECT_EQ(found.scene.volume.extinction, whole.scene.volume.extinction);
      EXPECT_EQ(found.notes, whole.notes);
    });
}

TEST(WholeRanges, AreThoseOfTheWholeMesh) {
  ZooMesh mesh = test::random_delaunay(150, 2);
  test::add_random_field(mesh, "n", FieldLocation::node, 1);
  test::add_random_field(mesh, "c", FieldLocation::cell, 2);
  test::add_random_field(mesh, "k", FieldLocation::corner, 3);
  // values that are no numbers do not count, nor negative ones on a logarithmic scale
  for (Field& field : mesh.fields) {
    std::vector<double> values(field.values.begin(), field.values.end());
    for (std::size_t i = 0; i < values.size(); i += 7)
      values[i] = i % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : -values[i];
    field.values = std::move(values);
  }
  for (const char* range : {"range = \"auto\"\n", "range = \"percentile:1,99\"\n",
                            "range = \"percentile:0,37.5\"\n", "range = \"percentile:50,100\"\n"})
    for (const std::string scale : {"", "scale = \"log\"\n"})
      for (const std::uint32_t parts : test::tried(std::vector{5U, 1U, 2U})) {
        SCOPED_TRACE(range + scale);
        expect_whole(mesh, parts, specification("n", "c", range + scale));
        expect_whole(mesh, parts, specification("k", "n", range + scale));
      }
}

}  // namespace
}  // namespace hiac

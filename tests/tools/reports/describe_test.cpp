// What hiac-info says of meshes, orders and images, line by line, and as facts.
#include "tools/info/describe.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/mesh_hash.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::tools {
namespace {

using Facts = nlohmann::ordered_json;

/// Two cells of different kinds, with fields of every location and metadata.
ZooMesh described_mesh() {
  ZooMesh mesh = test::make_mesh({{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, -6}, {2, 3, 6}},
                                 {{CellKind::pyramid5, {0, 1, 4, 2, 3}},
                                  {CellKind::tetrahedron4, {0, 1, 2, 4}},
                                  {CellKind::tetrahedron4, {1, 2, 3, 4}}});
  const double nan = std::nan("");
  mesh.fields.push_back({"t", "K", FieldLocation::node, 1, std::vector<double>{-3, 4, nan, 0, 1}});
  mesh.fields.push_back(
      {"v", "", FieldLocation::cell, 3, std::vector<double>{-3, 0, 4, 0, -0.5, 0, 1, -4, 8}});
  mesh.fields.push_back({"none", "", FieldLocation::cell, 1, std::vector<double>{nan, nan, nan}});
  mesh.metadata.emplace_back("source", "a test");
  return mesh;
}

TEST(Describe, AMeshLineByLine) {
  const ZooMesh mesh = described_mesh();
  const Description description =
      describe_mesh({mesh, {{"OTHER", std::vector<std::uint8_t>(5)}}}, "m.zoo");
  EXPECT_EQ(description.text,
            "m.zoo: zoo mesh\n"
            "  cells        3 (2 tetrahedron4, 1 pyramid5)\n"
            "  nodes        5\n"
            "  bounds       x 0 to 2\n"
            "               y 0 to 3\n"
            "               z -6 to 6\n"
            "  diagonal     12.53\n"
            "  fields       t (node, scalar): -3 to 4, 1 not finite K\n"
            "               v (cell, 3 components): magnitude 0.5 to 9\n"
            "               none (cell, scalar): no finite value, 3 not finite\n"
            "  hash         " +
                content_hash(mesh) + "\n  geometry     " + geometry_hash(mesh) +
                "\n  adjacency    not stored\n"
                "  metadata     source: a test\n"
                "  chunk        OTHER (5 bytes, not known here)\n");
  Facts facts = description.facts;
  EXPECT_EQ(facts["mesh_hash"], content_hash(mesh));
  EXPECT_EQ(facts["geometry_hash"], geometry_hash(mesh));
  EXPECT_NEAR(facts["diagonal"].get<double>(), std::sqrt(4 + 9 + 144), 1e-14);
  for (const char* key : {"mesh_hash", "geometry_hash", "diagonal"}) facts.erase(key);
  EXPECT_EQ(facts, Facts::parse(R"({"holds": "mesh", "cells": 3, "nodes": 5,
    "kinds": {"tetrahedron4": 2, "pyramid5": 1}, "bounds": [[0.0, 2.0], [0.0, 3.0], [-6.0, 6.0]],
    "fields": [
      {"name": "t", "unit": "K", "location": "node", "components": 1, "minimum": -3.0,
       "maximum": 4.0, "not_finite": 1},
      {"name": "v", "unit": "", "location": "cell", "components": 3, "minimum": 0.5,
       "maximum": 9.0, "not_finite": 0},
      {"name": "none", "unit": "", "location": "cell", "components": 1, "minimum": null,
       "maximum": null, "not_finite": 3}],
    "face_adjacency": false, "metadata": {"source": "a test"}})"));
}

TEST(Describe, AMeshWithLittleInIt) {
  ZooMesh mesh = test::structured(1, test::Cut::bricks);
  mesh.adjacency = build_face_adjacency(mesh);
  const Description stored = describe_mesh({mesh, {}}, "m");
  EXPECT_NE(stored.text.find("  fields       none\n  hash "), std::string::npos) << stored.text;
  EXPECT_NE(stored.text.find("  adjacency    stored\n"), std::string::npos);
  EXPECT_EQ(stored.facts["face_adjacency"], true);
  EXPECT_EQ(stored.facts["fields"], Facts::array());
  EXPECT_FALSE(stored.facts.contains("order"));
  const Description empty = describe_mesh({ZooMesh{}, {}}, "e");
  EXPECT_EQ(empty.text.find("bounds"), std::string::npos);
  EXPECT_FALSE(empty.facts.contains("bounds"));
}

OrderRecord an_order(std::vector<CellGroup> groups) {
  OrderRecord record{std::string(32, 'a'), std::string(32, 'b'), {}};
  record.order.cells = std::vector<CellId>{2, 0, 1, 5, 4, 3};
  record.order.groups = std::move(groups);
  record.order.algorithm = "exact";
  return record;
}

const std::string kHashes =
    "  for geometry " + std::string(32, 'a') + "\n  for view     " + std::string(32, 'b') + "\n";

TEST(Describe, OneOrderAndSeveral) {
  const ExtraChunk with_groups = encode_order(an_order({{0, 3}, {4, 2}})),
                   without = encode_order(an_order({}));
  const std::string groups =
      "  order        6 cells by exact; 2 groups of 5 cells together, 3 in the largest\n" + kHashes;
  const std::string none = "  order        6 cells by exact; no groups\n" + kHashes;
  const Description one = describe_orders({with_groups}, "o");
  EXPECT_EQ(one.text, "o: visibility order\n" + groups);
  const std::string hashes =
      R"("mesh_hash": "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", "view_hash": "bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb"})";
  const Facts of_groups = Facts::parse(R"({"algorithm": "exact", "cells": 6, "groups": 2,
    "cells_in_groups": 5, "largest_group": 3, )" +
                                       hashes);
  const Facts of_none = Facts::parse(R"({"algorithm": "exact", "cells": 6, "groups": 0,
    "cells_in_groups": 0, "largest_group": 1, )" +
                                     hashes);
  EXPECT_EQ(one.facts, (Facts{{"holds", "order"}, {"order", of_groups}}));
  const Description two = describe_orders({with_groups, without}, "o");
  EXPECT_EQ(two.text, "o: visibility orders of 2 views\n" + groups + none);
  EXPECT_EQ(two.facts, (Facts{{"holds", "order"}, {"orders", Facts::array({of_groups, of_none})}}));
  const ZooMesh mesh = test::structured(1, test::Cut::tetrahedra);
  const Description behind = describe_mesh({mesh, {without}}, "m");
  EXPECT_TRUE(behind.text.ends_with("  adjacency    not stored\n" + none)) << behind.text;
  EXPECT_EQ(behind.facts["order"], of_none);
}

TEST(Describe, AnImageChannelByChannel) {
  Image image(3, 2, {"R", "depth"});
  for (std::size_t x = 0; x < 3; ++x) image.at(x, 1, 0) = 0.25 * static_cast<double>(x);
  image.at(0, 0, 0) = -1;
  image.at(2, 0, 1) = std::numeric_limits<double>::infinity();
  image.at(1, 0, 1) = 7;
  const Description description =
      describe_image({image, {{"Software", "x"}, {"text", "one\ntwo"}}}, "a.exr");
  EXPECT_EQ(description.text,
            "a.exr: image\n"
            "  size         3 x 2 pixels\n"
            "  channels     R: -1 to 0.5\n"
            "               depth: 0 to 7, 1 not finite\n"
            "  attribute    Software: x\n"
            "  text:\none\ntwo\n");
  EXPECT_EQ(description.facts, Facts::parse(R"({"holds": "image", "width": 3, "height": 2,
    "channels": [{"name": "R", "minimum": -1.0, "maximum": 0.5, "not_finite": 0},
                 {"name": "depth", "minimum": 0.0, "maximum": 7.0, "not_finite": 1}],
    "attributes": {"Software": "x", "text": "one\ntwo"}})"));
}

}  // namespace
}  // namespace hiac::tools

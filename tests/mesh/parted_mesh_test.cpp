// A parted mesh on disk: written, read, joined, and what a reader refuses.
#include <filesystem>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "hiac/base/error.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/parted/join_parts.hpp"
#include "hiac/mesh/parted/part_file.hpp"
#include "hiac/mesh/parted/split_mesh.hpp"
#include "hiac/mesh/parted/write_parts.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/mesh/sample_meshes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

using Json = nlohmann::ordered_json;
using testing::AllOf;
using testing::HasSubstr;

std::vector<std::uint32_t> random_parts(std::size_t cells, std::uint32_t parts) {
  std::mt19937 random(3);
  std::vector<std::uint32_t> result(cells);
  for (std::uint32_t& part : result) part = static_cast<std::uint32_t>(random() % parts);
  return result;
}

/// Two cells that share a face, each a part, with a field at the nodes.
ZooMesh two_cells() {
  ZooMesh mesh = samples::make_mesh(
      {{CellKind::tetrahedron4, {0, 1, 2, 3}}, {CellKind::tetrahedron4, {0, 2, 1, 4}}}, 5,
      {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1});
  mesh.fields.push_back({"t", "K", FieldLocation::node, 1, std::vector<double>{0, 1, 2, 3, 4}});
  return mesh;
}

class PartedMesh : public testing::Test {
 protected:
  PartedIndex write(const ZooMesh& mesh, std::span<const std::uint32_t> part_of_cell,
                    std::size_t parts) {
    return write_parted_mesh(path_, mesh, part_of_cell, parts, [](const std::string&) {});
  }
  void write_two_cells() { write(two_cells(), std::vector<std::uint32_t>{0, 1}, 2); }

  /// Writes the part anew as `edit` leaves it, and what the index says of it, so that only what
  /// parts have in common is wrong.
  template <typename Edit>
  void edit_part(std::size_t k, const Edit& edit) {
    PartedIndex index = read_parted_index(path_);
    MeshPart part = read_mesh_part(index, k);
    edit(part);
    write_zoo_file(index.path_of(k), zoo_file_of(part));
    index.parts[k] = part_info(part, index.parts[k].file);
    (void)folder_.write("m.zparts", text_of(index));
  }
  template <typename Edit>
  void edit_index(const Edit& edit) {
    Json json = Json::parse(test::bytes_of(path_));
    edit(json);
    (void)folder_.write("m.zparts", json.dump());
  }

  /// What reading and joining all of it says.
  [[nodiscard]] std::string complaint(PartFiles files = PartFiles::beside) const {
    try {
      const PartedIndex index = read_parted_index(path_, files);
      join_parts(index, read_all_parts(index));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  test::ScratchFolder folder_;
  std::string path_ = folder_.file("m.zparts");
};

TEST_F(PartedMesh, JoinsToTheSameMesh) {
  for (const ZooMesh& mesh : {samples::tetrahedron_grid(3), samples::one_of_each_kind()}) {
    const PartedIndex written = write(mesh, random_parts(mesh.cell_count(), 3), 3);
    EXPECT_EQ(written.hash, content_hash(mesh));
    const PartedIndex index = read_parted_index(path_);
    EXPECT_EQ(index.cells, mesh.cell_count());
    EXPECT_EQ(index.nodes, mesh.node_count());
    const std::vector<MeshPart> parts = read_all_parts(index);
    const ZooMesh whole = join_parts(index, parts);
    validate(whole, "whole");
    EXPECT_EQ(content_hash(whole), content_hash(mesh));
    EXPECT_EQ(whole.metadata, mesh.metadata);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(index.parts[k].file, "m." + std::to_string(k) + ".zoo");
      EXPECT_EQ(index.parts[k].cells, parts[k].mesh.cell_count());
    }
  }
}

TEST_F(PartedMesh, ReplacesTheFilesOfAMeshOfThatName) {
  write_two_cells();
  ZooMesh other = two_cells();
  other.fields.clear();
  write(other, std::vector<std::uint32_t>{1, 0}, 2);
  EXPECT_EQ(complaint(), "");
  EXPECT_EQ(read_parted_index(path_).hash, content_hash(other));
  EXPECT_THAT(folder_.names(), testing::ElementsAre("m.0.zoo", "m.1.zoo", "m.zparts"));
}

TEST_F(PartedMesh, WhatCannotBeReplacedLeavesTheOldFiles) {
  write_two_cells();
  const std::string old = test::bytes_of(folder_.file("m.0.zoo"));
  std::filesystem::remove(folder_.file("m.1.zoo"));
  std::filesystem::create_directory(folder_.file("m.1.zoo"));
  ZooMesh other = two_cells();
  other.fields.clear();
  EXPECT_THROW(write(other, std::vector<std::uint32_t>{0, 1}, 2), InputError);
  EXPECT_EQ(test::bytes_of(folder_.file("m.0.zoo")), old);
  EXPECT_THAT(folder_.names(), testing::ElementsAre("m.0.zoo", "m.1.zoo", "m.zparts"));
}

TEST_F(PartedMesh, RefusesEmptyPartsToWrite) {
  EXPECT_THROW(write(two_cells(), std::vector<std::uint32_t>{0, 0}, 2), std::invalid_argument);
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(PartedMesh, PartsOfAnotherMeshAreRefusedByName) {
  write_two_cells();
  std::filesystem::rename(folder_.file("m.0.zoo"), folder_.file("x"));
  std::filesystem::rename(folder_.file("m.1.zoo"), folder_.file("m.0.zoo"));
  EXPECT_THAT(complaint(), AllOf(HasSubstr("m.0.zoo: is not the part that"), HasSubstr("hash")));
  std::filesystem::remove(folder_.file("m.0.zoo"));
  EXPECT_THAT(complaint(), HasSubstr("m.0.zoo: "));
  write_zoo_file(folder_.file("m.0.zoo"), {samples::brick_grid(2), {}});
  EXPECT_THAT(complaint(), HasSubstr("another number of cells (1 expected, 8 found)"));
}

TEST_F(PartedMesh, AnOrdinaryMeshIsNoPart) {
  write_two_cells();
  const ZooFile part = read_zoo_file(folder_.file("m.1.zoo"));
  write_zoo_file(folder_.file("m.1.zoo"), {part.mesh, {}});
  EXPECT_THAT(complaint(), HasSubstr("m.1.zoo: is no part of a parted mesh"));
  std::vector<ExtraChunk> extras = part.extras;
  extras[1].payload = {extras[1].payload.view().first(4), nullptr};
  write_zoo_file(folder_.file("m.1.zoo"), {part.mesh, extras});
  EXPECT_THAT(complaint(), HasSubstr("chunk GCELLS: wrong size"));
  extras[1] = extras[0];
  write_zoo_file(folder_.file("m.1.zoo"), {part.mesh, extras});
  EXPECT_THAT(complaint(), HasSubstr("chunk GNODES is there twice"));
}

TEST_F(PartedMesh, GlobalNumbersThatOverlap) {
  write_two_cells();
  edit_part(1, [](MeshPart& part) { part.global_cells = std::vector<std::uint64_t>{0}; });
  EXPECT_THAT(complaint(), HasSubstr("m.1.zoo: cell 0 of the whole mesh is in m.0.zoo, too"));
}

TEST_F(PartedMesh, GlobalNumbersOutOfRangeOrOrder) {
  write_two_cells();
  edit_part(1, [](MeshPart& part) { part.global_cells = std::vector<std::uint64_t>{2}; });
  EXPECT_THAT(complaint(), HasSubstr("cell 0: the global number is out of range (below 2 "));
  write_two_cells();
  edit_part(1, [](MeshPart& part) { part.global_nodes = std::vector<std::uint64_t>{0, 2, 1, 4}; });
  EXPECT_THAT(complaint(), HasSubstr("node 2: the global numbers do not rise"));
  // the hash of the numbers alone tells this from the right one
  write_two_cells();
  const PartedIndex index = read_parted_index(path_);
  MeshPart part = read_mesh_part(index, 1);
  part.global_nodes = std::vector<std::uint64_t>{0, 1, 2, 3};
  write_zoo_file(index.path_of(1), zoo_file_of(part));
  EXPECT_THAT(complaint(), HasSubstr("another hash of the global numbers"));
}

TEST_F(PartedMesh, NodesThatDifferBetweenParts) {
  write_two_cells();
  edit_part(1, [](MeshPart& part) {
    std::vector<double> xyz(part.mesh.xyz.begin(), part.mesh.xyz.end());
    xyz[5] = 0x1p-1074;
    part.mesh.xyz = std::move(xyz);
  });
  EXPECT_THAT(complaint(),
              HasSubstr("m.1.zoo: node 1 of the whole mesh has other coordinates than in m.0.zoo"));
  write_two_cells();
  edit_part(1, [](MeshPart& part) {
    part.mesh.fields[0].values = std::vector<double>{0, 1, 2.5, 4};
  });
  EXPECT_THAT(complaint(),
              HasSubstr("node 2 of the whole mesh has another value of the field 't'"));
}

TEST_F(PartedMesh, PartsOfDifferentFieldsOrWithoutANode) {
  write_two_cells();
  edit_part(1, [](MeshPart& part) { part.mesh.fields[0].unit = "F"; });
  EXPECT_THAT(complaint(), HasSubstr("does not carry the same fields as m.0.zoo"));
  write_two_cells();
  edit_index([](Json& json) { json["nodes"] = 6; });
  EXPECT_THAT(complaint(), HasSubstr("node 5 of the whole mesh is in no part"));
  write_two_cells();
  edit_index([](Json& json) { json["hash"] = std::string(32, '0'); });
  EXPECT_THAT(complaint(), HasSubstr("its parts make another mesh"));
}

TEST_F(PartedMesh, AnIndexThatAnnouncesWhatIsNotThere) {
  const auto refused = [&](const auto& edit, const char* why) {
    write_two_cells();
    edit_index(edit);
    EXPECT_THAT(complaint(), AllOf(HasSubstr("m.zparts: "), HasSubstr(why)));
  };
  const std::uint64_t huge = std::uint64_t{1} << 63;
  refused([&](Json& j) { j["cells"] = huge; }, "cells are not those of the whole mesh");
  refused([&](Json& j) { j["nodes"] = huge; }, "fewer nodes than the whole mesh");
  refused([&](Json& j) { j["parts"][0]["cells"] = huge; }, "more cells than the whole mesh");
  refused([&](Json& j) { j["parts"][1]["nodes"] = huge; }, "part 1: more nodes than the whole");
  refused([](Json& j) { j["parts"][1]["cells"] = 0; }, "part 1: is empty");
  refused([](Json& j) { j["parts"][1]["cells"] = -1; }, "\"cells\": a whole number expected");
  refused([](Json& j) { j["parts"][1]["low"][0] = 1e300; }, "an impossible box (x from");
  refused([](Json& j) { j["parts"][1]["low"] = {1, 2}; }, "\"low\": three numbers expected");
  refused([](Json& j) { j["parts"][1]["hash"] = "abc"; }, "32 hexadecimal digits expected");
  refused([](Json& j) { j["parts"][1]["file"] = j["parts"][0]["file"]; }, "that of another part");
  refused([](Json& j) { j["parts"][1]["file"] = "./m.0.zoo"; }, "that of another part");
  refused([](Json& j) { j["parts"][1].erase("file"); }, "part 1: \"file\" is missing");
  refused([](Json& j) { j["parts"][1] = 7; }, "part 1: a JSON object expected");
  refused([](Json& j) { j["parts"] = Json::array(); }, "impossible number of parts");
  refused([](Json& j) { j["version"] = 2; }, "unknown version of the parted mesh (1 expected, 2");
  refused([](Json& j) { j["format"] = "other"; }, "is not the index of a parted mesh");
  refused([](Json& j) { j = Json::array(); }, "a JSON object expected");
  write_two_cells();
  edit_index([&](Json& j) {  // consistent in itself, and not with the file
    j["cells"] = huge + 1;
    j["parts"][0]["cells"] = huge;
  });
  EXPECT_THAT(complaint(), HasSubstr("m.0.zoo: is not the part that"));
  write_two_cells();
  edit_index([](Json& j) { j["parts"][0]["high"][2] = 5; });
  EXPECT_THAT(complaint(), HasSubstr("another box"));
  const std::string text = test::bytes_of(path_);
  (void)folder_.write("m.zparts", text.substr(0, text.size() / 2));
  EXPECT_THAT(complaint(), HasSubstr("JSON expected, which is broken at byte"));
  (void)folder_.write("m.zparts", std::string(100000, '['));
  EXPECT_THAT(complaint(), HasSubstr("JSON expected"));
}

TEST_F(PartedMesh, PartsOutsideTheFolder) {
  write_two_cells();
  const test::ScratchFolder other;
  std::filesystem::rename(folder_.file("m.1.zoo"), other.file("m.1.zoo"));
  const std::string beside = "a/../../" + other.path().filename().string() + "/m.1.zoo";
  for (const std::string& file : {other.file("m.1.zoo"), beside}) {
    edit_index([&](Json& j) { j["parts"][1]["file"] = file; });
    EXPECT_THAT(complaint(), HasSubstr("part 1: names " + file + ", which lies outside"));
  }
  edit_index([&](Json& j) { j["parts"][1]["file"] = other.file("m.1.zoo"); });
  EXPECT_EQ(complaint(PartFiles::anywhere), "");
  edit_index([](Json& j) { j["parts"][1]["file"] = "a\nb"; });
  EXPECT_THAT(complaint(PartFiles::anywhere), HasSubstr("\"file\" has control characters"));
}

TEST_F(PartedMesh, IsRecognizedByItsFirstBytes) {
  write_two_cells();
  EXPECT_TRUE(is_parted_index(test::bytes_of(path_)));
  EXPECT_FALSE(is_parted_index("{\"format\": \"hiac facts\"}"));
  EXPECT_FALSE(is_parted_index("\"hiac parted mesh\""));
}

}  // namespace
}  // namespace hiac

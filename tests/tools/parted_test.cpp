// hiac-convert writes parted meshes and joins them again.
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/mesh/parted/join_parts.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::tools {
namespace {

using testing::HasSubstr;

class Parted : public test::ToolFolder {
 protected:
  void SetUp() override {
    mesh_ = test::side_by_side(test::structured(3, test::Cut::bricks),
                               test::structured(2, test::Cut::pyramids));
    test::add_node_field(mesh_, "t", test::smooth_field);
    std::vector<double> owner(mesh_.cell_count());
    for (std::size_t i = 0; i < owner.size(); ++i) owner[i] = i % 2 == 0 ? 7 : 3;
    mesh_.fields.push_back({"owner", "", FieldLocation::cell, 1, std::move(owner)});
    write_zoo_file(file("a.zoo"), {mesh_, {}});
  }
  ZooMesh mesh_;
};

TEST_F(Parted, RoundTripGivesTheSameMesh) {
  ASSERT_EQ(run("$CONVERT a.zoo --parts 5 -o b.zparts"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("5 parts; the largest weighs 1.0"));
  const PartedIndex index = read_parted_index(file("b.zparts"));
  EXPECT_EQ(index.parts.size(), 5U);
  for (const MeshPart& part : read_all_parts(index)) EXPECT_TRUE(part.mesh.adjacency.has_value());
  ASSERT_EQ(run("$CONVERT b.zparts -o c.zoo"), 0) << complaint();
  EXPECT_EQ(content_hash(read_zoo_file(file("c.zoo")).mesh), content_hash(mesh_));
  // the same mesh gives the same files
  ASSERT_EQ(run("mkdir d && $CONVERT -q a.zoo --parts 5 -o d/b.zparts"), 0) << complaint();
  for (const char* name : {"b.zparts", "b.0.zoo", "b.4.zoo"})
    EXPECT_EQ(bytes_of(file(name)), bytes_of(file(std::string("d/") + name)));
}

TEST_F(Parted, PartsOfAFieldOfTheCells) {
  ASSERT_EQ(run("$CONVERT a.zoo --parts-by owner -o b.zparts"), 0) << complaint();
  const auto parts = read_all_parts(read_parted_index(file("b.zparts")));
  ASSERT_EQ(parts.size(), 2U);
  for (const std::uint64_t cell : parts[0].global_cells) EXPECT_EQ(cell % 2, 1U);  // 3 comes first
  EXPECT_EQ(run("$CONVERT a.zoo --parts-by t -o c.zparts"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--parts-by t: is no scalar field of the cells"));
  EXPECT_EQ(run("$CONVERT a.zoo --derive 'x=owner/4' --parts-by x -o c.zparts"), 2);
  EXPECT_THAT(complaint(), HasSubstr("whole numbers of parts expected"));
  EXPECT_EQ(run("$CONVERT a.zoo --parts-by no -o c.zparts"), 2);
  EXPECT_FALSE(std::filesystem::exists(file("c.zparts")));
}

TEST_F(Parted, WrongUsageIsExit2) {
  EXPECT_EQ(run("$CONVERT a.zoo -o b.zparts"), 2);
  EXPECT_THAT(complaint(), HasSubstr("nothing says which parts"));
  EXPECT_EQ(run("$CONVERT a.zoo --parts 2 -o b.zoo"), 2);
  EXPECT_EQ(run("$CONVERT a.zoo --parts 0 -o b.zparts"), 2);
  EXPECT_EQ(run("$CONVERT a.zoo --parts 1000 -o b.zparts"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--parts: 1000 parts of 75 cells"));
  EXPECT_EQ(run("cp a.zoo b.1.zoo && $CONVERT b.1.zoo --parts 2 -o b.zparts"), 2);
  EXPECT_THAT(complaint(), HasSubstr("b.1.zoo: is an input of this run"));
}

TEST_F(Parted, DividedAgainInPlace) {
  ASSERT_EQ(run("$CONVERT -q a.zoo --parts 3 -o b.zparts"), 0) << complaint();
  ASSERT_EQ(run("$CONVERT -q b.zparts --parts 4 -o b.zparts"), 0) << complaint();
  EXPECT_EQ(read_parted_index(file("b.zparts")).parts.size(), 4U);
  ASSERT_EQ(run("$CONVERT -q b.zparts -o c.zoo"), 0) << complaint();
  EXPECT_EQ(content_hash(read_zoo_file(file("c.zoo")).mesh), content_hash(mesh_));
}

// The disk is full at one part after the other, and at the index.
TEST_F(Parted, AFullDiskLosesNothing) {
  ASSERT_EQ(run("$CONVERT -q a.zoo --parts-by owner -o b.zparts"), 0) << complaint();
  ASSERT_EQ(run("mkdir new && $CONVERT -q b.zparts --parts 4 -o new/b.zparts"), 0) << complaint();
  const std::vector<std::string> old{"b.zparts", "b.0.zoo", "b.1.zoo"};
  std::vector<std::string> bytes;
  for (const std::string& name : old) bytes.push_back(bytes_of(file(name)));
  const std::vector<std::string> names = folder_.names();
  for (const char* name : {"b.0.zoo", "b.1.zoo", "b.2.zoo", "b.3.zoo", "b.zparts"}) {
    const std::size_t fits = std::filesystem::file_size(file(std::string("new/") + name)) - 1;
    EXPECT_EQ(
        run(fmt::format("prlimit --fsize={} $CONVERT -q b.zparts --parts 4 -o b.zparts", fits)), 3)
        << complaint();
    for (std::size_t k = 0; k < old.size(); ++k) EXPECT_EQ(bytes_of(file(old[k])), bytes[k]);
    EXPECT_EQ(folder_.names(), names);
  }
}

TEST_F(Parted, HostileIndex) {
  ASSERT_EQ(run("$CONVERT -q a.zoo --parts 2 -o b.zparts"), 0) << complaint();
  EXPECT_EQ(run("mkdir d && sed 's#b.1.zoo#../b.1.zoo#; s#b.0.zoo#../b.0.zoo#' b.zparts > "
                "d/b.zparts && $CONVERT d/b.zparts -o c.zoo"),
            3);
  EXPECT_THAT(complaint(), HasSubstr("--allow-external"));
  EXPECT_EQ(run("$CONVERT d/b.zparts --allow-external -o c.zoo"), 0) << complaint();
  EXPECT_EQ(run("$CONVERT --list b.zparts"), 0);
  EXPECT_THAT(bytes_of(file("out.txt")), HasSubstr("part 1: b.1.zoo, "));
  std::filesystem::remove(file("b.1.zoo"));
  EXPECT_EQ(run("$CONVERT b.zparts -o c.zoo"), 3);
  EXPECT_THAT(complaint(), HasSubstr("b.1.zoo"));
}

}  // namespace
}  // namespace hiac::tools

// Parts whose hashes are right and whose content is not: what thousands of random changes make of
// them is refused, or is a valid mesh.
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/parted/join_parts.hpp"
#include "hiac/mesh/parted/part_file.hpp"
#include "hiac/mesh/parted/write_parts.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/mesh/sample_meshes.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

class PartedMutation : public testing::Test {
 protected:
  void SetUp() override {
    const ZooMesh mesh = samples::one_of_each_kind();
    std::vector<std::uint32_t> part(mesh.cell_count());
    for (std::size_t cell = 0; cell < part.size(); ++cell)
      part[cell] = static_cast<std::uint32_t>(cell % 3);
    index_ = write_parted_mesh(folder_.file("m.zparts"), mesh, part, 3, [](const std::string&) {});
    sound_ = read_all_parts(index_);
  }

  std::size_t below(std::size_t bound) { return random_() % bound; }

  // Numbers that lie near others, in the same range, or nowhere.
  template <typename T>
  T other(T number) {
    switch (below(5)) {
      case 0:
        return static_cast<T>(number + 1);
      case 1:
        return static_cast<T>(number - 1);
      case 2:
        return 0;
      case 3:
        return static_cast<T>(random_() % 64);
      default:
        return static_cast<T>(random_());
    }
  }

  template <typename T>
  void change(SharedArray<T>& array) {
    std::vector<T> values(array.begin(), array.end());
    if (values.empty()) return;
    switch (below(4)) {
      case 0:
        values.resize(below(values.size() + 3));
        break;
      case 1:
        std::swap(values[below(values.size())], values[below(values.size())]);
        break;
      default:
        T& value = values[below(values.size())];
        value = other(value);
    }
    array = std::move(values);
  }

  void change(MeshPart& part) {
    switch (below(6)) {
      case 0:
        return change(part.global_nodes);
      case 1:
        return change(part.global_cells);
      case 2:
        return change(part.mesh.nodes);
      case 3:
        return change(part.mesh.elems);
      case 4:
        return change(part.mesh.xyz);
      default:
        if (!part.mesh.fields.empty()) part.mesh.fields.pop_back();
    }
  }

  // Part k as it has become; the index says of it what it is.
  void write(std::size_t k, const MeshPart& part) {
    write_zoo_file(index_.path_of(k), zoo_file_of(part));
    index_.parts[k] = part_info(part, index_.parts[k].file);
  }

  test::ScratchFolder folder_;
  PartedIndex index_;
  std::vector<MeshPart> sound_;
  std::mt19937_64 random_{24};
};

TEST_F(PartedMutation, IsRefusedOrAValidMesh) {
  std::size_t refused = 0;
  const std::size_t rounds = test::tried(3000);
  for (std::size_t round = 0; round < rounds; ++round) {
    const PartedIndex before = index_;
    const std::size_t k = below(sound_.size());
    MeshPart part = sound_[k];
    for (std::size_t changes = 1 + below(2); changes > 0; --changes) change(part);
    try {
      write(k, part);
      const ZooMesh whole = join_parts(index_, read_all_parts(index_));
      validate(whole, "whole");
    } catch (const InputError&) {
      ++refused;
    }
    index_ = before;
    write(k, sound_[k]);
  }
  EXPECT_GT(refused, rounds / 2);  // some changes change nothing
}

}  // namespace
}  // namespace hiac

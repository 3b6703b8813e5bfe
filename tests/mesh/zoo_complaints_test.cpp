// What is said of containers whose bytes are damaged, with the chunk in question, and of meshes
// whose parts do not fit.
#include <cstdint>
#include <memory>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/mman.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/mesh/sample_meshes.hpp"
#include "tests/mesh/zoo_bytes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

using samples::ByteChunk;

class ZooComplaints : public testing::Test {
 protected:
  ZooComplaints() {
    ZooFile file{samples::brick_grid(1), {}};
    file.mesh.metadata = {{"key", "value"}};
    file.mesh.fields.push_back({"f", "K", FieldLocation::cell, 1, std::vector<double>{7}});
    file.mesh.adjacency = FaceAdjacency{std::vector<CellId>(6, kNoCell), 3};
    file.extras.push_back({"MORE", std::vector<std::uint8_t>{1, 2, 3}});
    write_zoo_file(folder_.file("sound.zoo"), file);
    sound_ = test::bytes_of(folder_.file("sound.zoo"));
  }

  /// The message behind the file's name; empty for none.
  std::string told_of_bytes(const std::string& bytes) {
    const std::string path = folder_.write("a.zoo", bytes);
    try {
      static_cast<void>(read_zoo_file(path));
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with(path + ": ")) << message;
      return message.substr(path.size() + 2);
    }
    return "";
  }
  /// The same after a change of the payload of the first chunk of a type.
  template <typename Change>
  std::string told_after(const std::string& type, const Change& change) {
    auto chunks = samples::split_zoo(sound_);
    change(std::ranges::find(chunks, type, &ByteChunk::type)->payload);
    return told_of_bytes(samples::join_zoo(chunks));
  }
  /// Where the header of a chunk begins.
  [[nodiscard]] std::size_t header_of(const std::string& type) const {
    std::size_t at = 64;
    while (sound_.compare(at, type.size() + 1, type + '\0') != 0)
      at += 64 + (samples::get<std::uint64_t>(sound_, at + 8) + 63) / 64 * 64;
    return at;
  }
  [[nodiscard]] std::size_t number_of(const std::string& type) const {
    const auto chunks = samples::split_zoo(sound_);
    return static_cast<std::size_t>(std::ranges::find(chunks, type, &ByteChunk::type) -
                                    chunks.begin());
  }

  test::ScratchFolder folder_;
  std::string sound_;
};

TEST_F(ZooComplaints, ZerosFollowTheVersion) {
  EXPECT_EQ(told_of_bytes(sound_), "");
  for (const std::size_t at : {std::size_t{12}, std::size_t{63}}) {
    std::string bytes = sound_;
    bytes[at] = 1;
    EXPECT_EQ(told_of_bytes(bytes), "the header is damaged (zeros expected after the version)");
  }
  std::string later = sound_;
  later[8] = 2;
  EXPECT_EQ(told_of_bytes(later), "unknown version of the zoo container (1 expected, 2 found)");
}

TEST_F(ZooComplaints, HeadersOfChunksHaveAChecksum) {
  const std::size_t at = header_of("XYZ");
  std::string bytes = sound_;
  bytes[at + 8] = static_cast<char>(bytes[at + 8] + 1);
  const std::uint64_t said = samples::get<std::uint64_t>(bytes, at + 24);
  EXPECT_EQ(told_of_bytes(bytes),
            fmt::format("chunk {}: the header is damaged (checksum {:016x} expected, {:016x} "
                        "found)",
                        number_of("XYZ"), said, XXH3_64bits(bytes.data() + at, 24)));
}

TEST_F(ZooComplaints, HeadersOfChunksHaveAPrintableTypeAndZeros) {
  const std::size_t at = header_of("MORE");
  const std::string malformed =
      fmt::format("chunk {}: the header is malformed (a printable type, then zeros expected)",
                  number_of("MORE"));
  const auto with_type = [&](const std::string& type) {
    std::string bytes = sound_;
    bytes.replace(at, 8, type + std::string(8 - type.size(), '\0'));
    samples::sign_header(bytes, at);
    return told_of_bytes(bytes);
  };
  for (const std::string& type :
       {std::string(), std::string("A B"), std::string("A\x7f"), std::string("\x1f"),
        std::string("A\0B", 3), std::string("\0B", 2), std::string("\xc3\xa4")})
    EXPECT_EQ(with_type(type), malformed) << type;
  for (const char* type : {"~", "!", "EIGHTBIT", "e"}) EXPECT_EQ(with_type(type), "") << type;
  for (const std::size_t offset : {std::size_t{32}, std::size_t{63}}) {
    std::string bytes = sound_;
    bytes[at + offset] = 1;
    EXPECT_EQ(told_of_bytes(bytes), malformed);
  }
}

TEST_F(ZooComplaints, PayloadsHaveAChecksumAndZerosBehind) {
  const std::size_t at = header_of("MORE");
  std::string bytes = sound_;
  bytes[at + 64] = 9;
  EXPECT_EQ(told_of_bytes(bytes),
            fmt::format("chunk {} (MORE): the payload is damaged (checksum {:016x} expected, "
                        "{:016x} found)",
                        number_of("MORE"), XXH3_64bits("\1\2\3", 3), XXH3_64bits("\x9\2\3", 3)));
  for (const std::size_t behind : {std::size_t{3}, std::size_t{63}}) {
    bytes = sound_;
    bytes[at + 64 + behind] = 1;
    EXPECT_EQ(told_of_bytes(bytes), "chunk MORE: the padding is damaged (zeros expected)");
  }
}

TEST_F(ZooComplaints, PayloadsEndWhereTheySay) {
  EXPECT_EQ(told_after("META", [](std::string& p) { p += "abc"; }),
            "chunk META: bytes are left over (20 expected, 23 found)");
  EXPECT_EQ(told_after("END", [](std::string& p) { p += 'x'; }),
            "chunk END: bytes are left over (8 expected, 9 found)");
  EXPECT_EQ(told_after("END", [](std::string& p) { p.pop_back(); }),
            "chunk END: the payload ends within its number of chunks (8 bytes expected, 7 found)");
  EXPECT_EQ(told_after("META", [](std::string& p) { p.pop_back(); }),
            "chunk META: the payload ends within its value (5 bytes expected, 4 found)");
  EXPECT_EQ(told_after("META", [](std::string& p) { p.resize(13); }),
            "chunk META: the payload ends within its key (3 bytes expected, 1 found)");
  EXPECT_EQ(told_after("META", [](std::string& p) { p.resize(11); }),
            "chunk META: the payload ends within its size of a value (4 bytes expected, 3 found)");
  EXPECT_EQ(told_after("META", [](std::string& p) { p.resize(4); }),
            "chunk META: the payload ends within its size of a key (4 bytes expected, 0 found)");
  EXPECT_EQ(told_after("META", [](std::string& p) { p.resize(3); }),
            "chunk META: the payload ends within its number of entries (4 bytes expected, 3 "
            "found)");
  EXPECT_EQ(told_after("FIELD", [](std::string& p) { p.resize(15); }),
            "chunk FIELD: the payload ends within its header (16 bytes expected, 15 found)");
  EXPECT_EQ(told_after("FIELD", [](std::string& p) { p.resize(17); }),
            "chunk FIELD: the payload ends within its unit (1 bytes expected, 0 found)");
  EXPECT_EQ(told_after("FIELD", [](std::string& p) { p.resize(63); }),
            "chunk FIELD: the payload ends within its padding (46 bytes expected, 45 found)");
  EXPECT_EQ(told_after("FIELD", [](std::string& p) { p.pop_back(); }),
            "chunk FIELD: the size is no whole number of values (a multiple of 8 bytes expected, "
            "7 found)");
  EXPECT_EQ(told_after("FIELD", [](std::string& p) { p[18] = 1; }),
            "chunk FIELD: bytes that must be zero are not");
  EXPECT_EQ(told_after("FIELD", [](std::string& p) { p[0] = 3; }),
            "field \"f\": unknown location (below 3 expected, 3 found)");
}

TEST_F(ZooComplaints, MetadataMayBeEmptyTexts) {
  ZooFile file{samples::brick_grid(1), {}};
  file.mesh.metadata = {{"", "value"}, {"key", ""}, {"", ""}};
  write_zoo_file(folder_.file("b.zoo"), file);
  EXPECT_EQ(read_zoo_file(folder_.file("b.zoo")).mesh.metadata, file.mesh.metadata);
}

std::string told_of_mesh(const ZooMesh& mesh) {
  try {
    validate(mesh, "m");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ZooLayoutComplaints, OffsetsBeginAt0) {
  ZooMesh mesh = samples::brick_grid(1);
  mesh.elems = std::vector<std::uint64_t>{1, 9};
  EXPECT_EQ(told_of_mesh(mesh), "m: cell 0: wrong node offset (0 expected, 1 found)");
  mesh.elems = std::vector<std::uint64_t>{0, 9};
  EXPECT_EQ(told_of_mesh(mesh),
            "m: cell 0: wrong number of nodes (8 expected of a brick8, offsets "
            "0 to 9 found)");
  mesh.elems = std::vector<std::uint64_t>{0};
  EXPECT_EQ(told_of_mesh(mesh),
            "m: the cells' node offsets do not fit the cells (one more than 1 "
            "cells expected, 1 found)");
  mesh = samples::brick_grid(1);
  mesh.nodes = std::vector<NodeId>(9, 0);
  EXPECT_EQ(told_of_mesh(mesh),
            "m: the list of nodes does not fit the cells (8 entries expected, 9 found)");
  mesh = samples::brick_grid(1);
  mesh.xyz = std::vector<double>(25, 0);
  EXPECT_EQ(told_of_mesh(mesh),
            "m: coordinates are not triples (a multiple of 3 expected, 25 numbers found)");
}

// Pages that nobody touches: the number of cells alone is looked at.
TEST(ZooLayoutComplaints, CellsHaveNumbersOf32Bits) {
  const std::size_t size = std::size_t{1} << 32;
  void* pages =
      ::mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  ASSERT_NE(pages, MAP_FAILED);
  const auto told_of = [&](std::size_t cells) {
    ZooMesh mesh;
    const auto* kinds = static_cast<const CellKind*>(pages);
    mesh.kinds = SharedArray<CellKind>(std::span(kinds, cells), nullptr);
    mesh.elems = std::vector<std::uint64_t>{0};
    return told_of_mesh(mesh);
  };
  EXPECT_EQ(told_of(0xffffffff),
            "m: too many cells (at most 4294967294 expected, 4294967295 found)");
  EXPECT_EQ(told_of(0xfffffffe),
            "m: the cells' node offsets do not fit the cells (one more than "
            "4294967294 cells expected, 1 found)");
  ::munmap(pages, size);
}

TEST(ZooLayoutComplaints, FieldsHaveKnownLocationsAndEveryValue) {
  ZooMesh mesh = samples::brick_grid(1);
  const auto with_field = [&](FieldLocation location, std::uint32_t components,
                              std::size_t values) {
    mesh.fields = {{"f", "", location, components, std::vector<double>(values)}};
    return told_of_mesh(mesh);
  };
  EXPECT_EQ(with_field(FieldLocation::corner, 2, 16), "");
  EXPECT_EQ(with_field(FieldLocation::corner, 2, 17),
            "m: field \"f\": wrong number of values (8 x 2 expected, 17 found)");
  EXPECT_EQ(with_field(FieldLocation::cell, 3, 6),
            "m: field \"f\": wrong number of values (1 x 3 expected, 6 found)");
  EXPECT_EQ(with_field(FieldLocation::node, 0, 8),
            "m: field \"f\": no components (1 or more expected, 0 found)");
  EXPECT_EQ(with_field(static_cast<FieldLocation>(3), 1, 8),
            "m: field \"f\": unknown location (below 3 expected, 3 found)");
}

TEST(ZooLayoutComplaints, NeighboursAreCells) {
  ZooMesh mesh = samples::brick_grid(1);
  mesh.adjacency = FaceAdjacency{std::vector<CellId>{kNoCell, 0, 0, 0, 0, 0}, 0};
  EXPECT_EQ(told_of_mesh(mesh), "");
  mesh.adjacency = FaceAdjacency{std::vector<CellId>{kNoCell, 0, 0, 0, 0, 1}, 0};
  EXPECT_EQ(told_of_mesh(mesh), "m: face 5: neighbour out of range (below 1 expected, 1 found)");
}

}  // namespace
}  // namespace hiac

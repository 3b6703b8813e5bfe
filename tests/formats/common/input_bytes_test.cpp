// Bytes before any format: numbers of either byte order, gzip files, and what is no file.
#include <fmt/format.h>
#include <sys/stat.h>

#include "formats/common/io/byte_stream.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/io/named_file.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

template <typename Read>
std::string input_complaint(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(InputBytes, NumbersOfEitherOrder) {
  const std::string bytes("\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0a\x0b", 11);
  ByteStream little(bytes, "f");
  little.set_order(std::endian::little);
  EXPECT_EQ(little.read<std::uint16_t>("a"), 0x0201);
  EXPECT_EQ(little.offset(), 2U);
  EXPECT_EQ(little.left(), 9U);
  EXPECT_EQ(little.size(), 11U);
  EXPECT_EQ(little.read<std::uint32_t>("a"), 0x06050403U);
  ByteStream big(bytes, "f");
  big.set_order(std::endian::big);
  EXPECT_EQ(big.read<std::uint8_t>("a"), 1);
  EXPECT_EQ(big.read<std::uint64_t>("a"), 0x0203040506070809ULL);
  big.move_to(9);
  EXPECT_EQ(big.read<std::uint16_t>("a"), 0x0a0b);
  EXPECT_EQ(big.left(), 0U);
}

TEST(InputBytes, EndsAreToldWithTheirPlace) {
  const std::string bytes(10, 'x');
  ByteStream stream(bytes, "f");
  stream.skip(3, "a head");
  EXPECT_EQ(input_complaint([&] { stream.read<std::uint64_t>("a time"); }),
            "f: at byte 3: the file ends too early (a time expected)");
  EXPECT_EQ(stream.read<std::uint32_t>("a count"), 0x78787878U);
  EXPECT_EQ(input_complaint([&] { stream.skip(4, "a title"); }),
            "f: at byte 7: the file ends too early (a title expected)");
  stream.skip(3, "a title");
  EXPECT_EQ(input_complaint([&] { stream.read<char>("a mark"); }),
            "f: at byte 10: the file ends too early (a mark expected)");
  EXPECT_EQ(input_complaint([&] { stream.fail("a wrong mark"); }), "f: at byte 10: a wrong mark");
}

std::string little_word(std::uint32_t value, std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i);
  return text;
}

/// What gzip makes of a text that it does not compress (RFC 1951, 1952).
std::string stored_by_gzip(const std::string& text) {
  std::uint32_t crc = ~0U;
  for (const char c : text) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320U : 0);
  }
  const auto size = static_cast<std::uint32_t>(text.size());
  return std::string("\x1f\x8b\x08\0\0\0\0\0\0\xff\x01", 11) + little_word(size, 2) +
         little_word(~size, 2) + text + little_word(~crc, 4) + little_word(size, 4);
}

TEST(InputBytes, GzipFilesOfOneOrSeveralMembers) {
  const ScratchFolder folder;
  const auto text = [&](const std::string& bytes) {
    return std::string(InputText(folder.write("a.gz", bytes)).text());
  };
  EXPECT_TRUE(is_gzip(stored_by_gzip("a")));
  EXPECT_FALSE(is_gzip("\x1f\x8b\x09"));
  EXPECT_EQ(text(stored_by_gzip("words")), "words");
  EXPECT_EQ(text(stored_by_gzip("wor") + stored_by_gzip("") + stored_by_gzip("ds")), "words");
  EXPECT_EQ(text(stored_by_gzip("\xef\xbb\xbfwords")), "words");
  EXPECT_EQ(text("\xef\xbb\xbfplain"), "plain");
  EXPECT_EQ(text("\xef\xbbplain"), "\xef\xbbplain");
  EXPECT_EQ(text(""), "");
  // more than is unpacked at first
  std::string members;
  std::string whole;
  for (int i = 0; i < 40; ++i) {
    const std::string part(60'000, static_cast<char>('a' + i % 26));
    members += stored_by_gzip(part);
    whole += part;
  }
  EXPECT_EQ(text(members), whole);
}

TEST(InputBytes, DamagedGzipFiles) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.gz");
  const auto said = [&](const std::string& bytes) {
    static_cast<void>(folder.write("a.gz", bytes));
    const std::string complaint = input_complaint([&] { const InputText text(path); });
    return complaint == "none" ? complaint : complaint.substr(path.size() + 2);
  };
  const std::string whole = stored_by_gzip("words");
  EXPECT_EQ(said(whole), "none");
  std::string wrong_block = whole;
  wrong_block[10] = '\x07';
  EXPECT_EQ(said(wrong_block), "the gzip data are damaged (after 0 unpacked bytes)");
  std::string wrong_sum = whole;
  wrong_sum[20] = static_cast<char>(wrong_sum[20] ^ 1);
  EXPECT_EQ(said(wrong_sum), "the gzip data are damaged (after 5 unpacked bytes)");
  EXPECT_EQ(said(whole + wrong_sum), "the gzip data are damaged (after 10 unpacked bytes)");
  EXPECT_EQ(said(whole + "stray"), "the gzip data are damaged (after 5 unpacked bytes)");
  for (const std::size_t length : {10, 17, 27})
    EXPECT_EQ(said(whole.substr(0, length)),
              fmt::format("the gzip data end too early (after {} bytes)", length));
}

TEST(InputBytes, HeadsOfGzipFiles) {
  const std::string whole = stored_by_gzip("words");
  EXPECT_EQ(unpacked_head(whole, 100), "words");
  EXPECT_EQ(unpacked_head(whole, 5), "words");
  EXPECT_EQ(unpacked_head(whole, 3), "wor");
  EXPECT_EQ(unpacked_head(whole.substr(0, 17), 100), "wo");
  EXPECT_EQ(unpacked_head(whole.substr(0, 10), 100), "");
}

TEST(InputBytes, PipesAndFoldersAreNoFiles) {
  const ScratchFolder folder;
  const std::string pipe = folder.file("pipe.vtk");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal(pipe), pipe + ": is not a regular file (a pipe or a device; a file expected)");
  EXPECT_EQ(refusal("/dev/null"),
            "/dev/null: is not a regular file (a pipe or a device; a file expected)");
  EXPECT_EQ(input_complaint([&] { file_head(folder.path().string()); }),
            folder.path().string() + ": is a directory (a file expected)");
  const std::string none = folder.file("none");
  EXPECT_EQ(input_complaint([&] { file_head(none); }),
            none + ": cannot be opened (No such file or directory)");
  EXPECT_EQ(file_head(folder.write("a", std::string(kHeadBytes - 1, 'x'))).size(), kHeadBytes - 1);
  EXPECT_EQ(file_head(folder.write("a", std::string(kHeadBytes + 1, 'x'))).size(), kHeadBytes);
}

TEST(InputBytes, FilesNameFilesBesideThem) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.xml", "");
  EXPECT_EQ(file_beside(path, "b"), folder.file("b"));
  EXPECT_EQ(file_beside(path, "c/../b"), folder.file("c/../b"));
  EXPECT_EQ(input_complaint([&] { file_beside(path, "b\t"); }),
            path + ": names a file with control characters in its name");
  const std::string outside = folder.path().parent_path() / "b";
  EXPECT_EQ(input_complaint([&] { file_beside(path, "../b"); }),
            path + ": names " + outside +
                ", which lies outside the input's folder (NamedFiles::outside_too reads it)");
  EXPECT_EQ(input_complaint([&] { file_beside(path, "/dev/null"); }).substr(0, path.size() + 24),
            path + ": names /dev/null, which");
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(input_complaint([&] { file_beside(path, "pipe"); }),
            path + ": names " + pipe + ", which is a pipe or a device (a file expected)");
}

TEST(InputBytes, CellTypesAreKeptOnceAndAreNotMoreThan65536) {
  ForeignMesh mesh;
  EXPECT_EQ(mesh.type_place("tet", 4, kNoVolume), 0);
  EXPECT_EQ(mesh.type_place("tet", 10, kNoVolume), 1);
  EXPECT_EQ(mesh.type_place("brick", 4, kNoVolume), 2);
  EXPECT_EQ(mesh.type_place("tet", 10, kNoVolume), 1);
  mesh.types.resize(65535);
  EXPECT_EQ(mesh.type_place("last", 1, kNoVolume), 65535);
  EXPECT_EQ(mesh.type_place("last", 1, kNoVolume), 65535);
  EXPECT_EQ(input_complaint([&] { mesh.type_place("more", 1, kNoVolume); }),
            "more: one cell type too many (65536 at most expected)");
}

TEST(InputBytes, PolyhedraStandFaceAfterFace) {
  ForeignMesh mesh;
  mesh.cell_types.push_back(mesh.type_place("other", 0, kNoVolume));
  mesh.add_polyhedron("poly", {{1, 2, 3}, {4, 5, 6, 7}});
  mesh.add_polyhedron("poly", {});
  EXPECT_THAT(mesh.polyhedra.cells, testing::ElementsAre(1, 2));
  EXPECT_THAT(mesh.polyhedra.ends, testing::ElementsAre(9, 9));
  EXPECT_THAT(mesh.polyhedra.faces, testing::ElementsAre(3, 1, 2, 3, 4, 4, 5, 6, 7));
  EXPECT_THAT(mesh.cell_types, testing::ElementsAre(0, 1, 1));
}

}  // namespace
}  // namespace hiac::formats

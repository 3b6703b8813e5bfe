// Containers that are wrong in every way that ten thousand random changes find, and in some that
// are chosen: InputError or a valid mesh, never anything else.

#include <random>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/mman.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/mesh/sample_meshes.hpp"
#include "tests/mesh/zoo_bytes.hpp"

namespace hiac {
namespace {

using samples::ByteChunk;
using samples::fix_end;
using samples::join_zoo;
using samples::split_zoo;
using testing::HasSubstr;

/// A file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& bytes = "") : descriptor_(::memfd_create("zoo", 0)) {
    EXPECT_EQ(::write(descriptor_, bytes.data(), bytes.size()), std::ssize(bytes));
    ::lseek(descriptor_, 0, SEEK_SET);
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
  [[nodiscard]] std::string bytes() const {
    std::string content(static_cast<std::size_t>(::lseek(descriptor_, 0, SEEK_END)), '\0');
    EXPECT_EQ(::pread(descriptor_, content.data(), content.size(), 0), std::ssize(content));
    return content;
  }

 private:
  int descriptor_;
};

std::string zoo_bytes(const ZooFile& file) {
  const MemoryFile memory;
  write_zoo_stream(memory.descriptor(), file, "memory");
  return memory.bytes();
}

ZooFile sample_file() {
  ZooFile file{samples::one_of_each_kind(), {}};
  file.mesh.adjacency = build_face_adjacency(file.mesh);
  file.extras.push_back({"ORDER", std::vector<std::uint8_t>{1, 2, 3}});
  return file;
}

/// What the reader says of the bytes, by stream and by file; empty when it takes them.
std::string complaint_about(const std::string& bytes) {
  const MemoryFile memory(bytes);
  std::string of_stream, of_file;
  std::string hash_of_stream, hash_of_file;
  try {
    const ZooFile file = read_zoo_stream(memory.descriptor(), "m.zoo");
    validate(file.mesh, "m.zoo");
    hash_of_stream = content_hash(file.mesh);
    build_face_adjacency(file.mesh);
  } catch (const InputError& error) {
    of_stream = error.what();
  }
  try {
    hash_of_file = content_hash(read_zoo_file(memory.path()).mesh);
  } catch (const InputError& error) {
    of_file = error.what();
  }
  // a file must end where its end chunk ends; a stream may carry on
  if (of_file.find("goes on after") == std::string::npos) {
    EXPECT_EQ(of_stream.empty(), of_file.empty()) << of_stream << of_file;
    EXPECT_EQ(hash_of_stream, hash_of_file);
  }
  return of_file;
}

std::string complaint_about(const std::vector<ByteChunk>& chunks) {
  return complaint_about(join_zoo(chunks));
}

ByteChunk& chunk_of(std::vector<ByteChunk>& chunks, const std::string& type) {
  return *std::ranges::find(chunks, type, &ByteChunk::type);
}

TEST(ZooBytes, DocumentedLayoutIsTheWritersLayout) {
  const std::string bytes = zoo_bytes(sample_file());
  EXPECT_EQ(join_zoo(split_zoo(bytes)), bytes);
}

TEST(ZooBytes, ChunksMayComeInAnyOrder) {
  auto chunks = split_zoo(zoo_bytes(sample_file()));
  std::reverse(chunks.begin(), chunks.end() - 1);
  EXPECT_EQ(complaint_about(chunks), "");
}

TEST(ZooBytes, MissingAndRepeatedChunksAreNamed) {
  const auto sound = split_zoo(zoo_bytes(sample_file()));
  for (const std::string type : {"KINDS", "ELEMS", "NODES", "XYZ"}) {
    auto chunks = sound;
    std::erase_if(chunks, [&](const ByteChunk& chunk) { return chunk.type == type; });
    fix_end(chunks);
    EXPECT_THAT(complaint_about(chunks), HasSubstr("chunk " + type + " is missing"));
  }
  for (const std::string type : {"KINDS", "ELEMS", "NODES", "XYZ", "META", "FACEADJ"}) {
    auto chunks = sound;
    chunks.insert(chunks.begin(), ByteChunk(chunk_of(chunks, type)));
    fix_end(chunks);
    EXPECT_THAT(complaint_about(chunks), HasSubstr("chunk " + type + " is there twice"));
  }
}

TEST(ZooBytes, EndChunkProvesCompleteness) {
  auto chunks = split_zoo(zoo_bytes(sample_file()));
  std::erase_if(chunks, [](const ByteChunk& chunk) { return chunk.type == "FIELD"; });
  EXPECT_THAT(
      complaint_about(chunks),
      HasSubstr("chunks are missing or too many (11 before the end chunk expected, 7 found)"));
  fix_end(chunks);
  EXPECT_EQ(complaint_about(chunks), "");
  chunks.pop_back();
  EXPECT_THAT(complaint_about(chunks), HasSubstr("stream ended before its end chunk"));
}

TEST(ZooBytes, AnnouncedSizesAreNotBelieved) {
  const std::string sound = zoo_bytes(sample_file());
  for (const std::uint64_t size :
       {~std::uint64_t{0}, ~std::uint64_t{0} - 62, ~std::uint64_t{0} - 63, std::uint64_t{1} << 62,
        std::uint64_t{1} << 40, std::uint64_t{sound.size()}}) {
    std::string bytes = sound;
    samples::put(bytes, 64 + 8, size);
    samples::sign_header(bytes, 64);
    EXPECT_THAT(complaint_about(bytes),
                testing::AnyOf(HasSubstr("stream ended before the end of chunk 0 (META)"),
                               HasSubstr("chunk META: impossible size")));
  }
}

TEST(ZooBytes, BrokenContentIsNamed) {
  const auto sound = split_zoo(zoo_bytes(sample_file()));
  const auto after = [&](const std::string& type, const auto& change) {
    auto chunks = sound;
    change(chunk_of(chunks, type).payload);
    return complaint_about(chunks);
  };
  EXPECT_THAT(after("KINDS", [](auto& p) { p[3] = 77; }), HasSubstr("cell 3: unknown kind"));
  EXPECT_THAT(after("KINDS", [](auto& p) { p += '\0'; }), HasSubstr("node offsets"));
  EXPECT_THAT(after("ELEMS", [](auto& p) { p.pop_back(); }), HasSubstr("a multiple of 8 bytes"));
  EXPECT_THAT(after("NODES", [](auto& p) { p.resize(p.size() - 4); }), HasSubstr("list of nodes"));
  EXPECT_THAT(after("XYZ", [](auto& p) { p.resize(p.size() - 8); }), HasSubstr("not triples"));
  EXPECT_THAT(after("XYZ", [](auto& p) { p.resize(p.size() - 24); }),
              HasSubstr("wrong number of values"));
  EXPECT_THAT(after("META", [](auto& p) { samples::put(p, 0, ~std::uint32_t{0}); }),
              HasSubstr("chunk META: the payload ends within its"));
  EXPECT_THAT(after("META", [](auto& p) { p += 'x'; }), HasSubstr("left over"));
  EXPECT_THAT(after("FIELD", [](auto& p) { p[0] = 3; }), HasSubstr("unknown location"));
  EXPECT_THAT(after("FIELD", [](auto& p) { samples::put(p, 4, 0); }), HasSubstr("no components"));
  EXPECT_THAT(after("FIELD", [](auto& p) { samples::put(p, 8, ~0u); }),
              HasSubstr("within its name"));
  EXPECT_THAT(after("FIELD", [](auto& p) { p[63] = 1; }), HasSubstr("must be zero"));
  EXPECT_THAT(after("FACEADJ", [](auto& p) { p[10] = 1; }), HasSubstr("must be zero"));
  EXPECT_THAT(after("FACEADJ", [](auto& p) { samples::put(p, 64, 15u); }),
              HasSubstr("face 0: neighbour out of range"));
}

/// One random change; the checksums stay right or not.
class Mutator {
 public:
  explicit Mutator(const std::string& sound) : sound_(sound), chunks_(split_zoo(sound)) {}

  std::string mutated() {
    switch (below(7)) {
      case 0:
        return flipped();
      case 1:
        return sound_.substr(0, below(sound_.size()));
      case 2:
        return resized_header();
      case 3:
        return rearranged();
      case 4:
        return with_payload([&](std::string& p) { change_bytes(p); });
      case 5:
        return with_payload([&](std::string& p) { change_number(p); });
      default:
        return with_payload([&](std::string& p) { p.resize(below(p.size() + 100)); });
    }
  }

 private:
  std::size_t below(std::size_t bound) { return random_() % bound; }

  std::string flipped() {
    std::string bytes = sound_;
    change_bytes(bytes);
    return bytes;
  }
  void change_bytes(std::string& bytes) {
    if (bytes.empty()) return;
    for (std::size_t i = below(4) + 1; i > 0; --i)
      bytes[below(bytes.size())] = static_cast<char>(below(256));
  }
  void change_number(std::string& bytes) {
    static constexpr std::uint64_t kTelling[] = {
        0, 1, 2, 63, 64, 65, 255, 1u << 31, ~0u, 1ull << 32, 1ull << 61, 1ull << 63, ~0ull};
    const std::uint64_t number = kTelling[below(std::size(kTelling))];
    if (bytes.size() < 8) return;
    const std::size_t at = below(bytes.size() - 7) / 4 * 4;
    if (below(2) == 0)
      samples::put(bytes, at, number);
    else
      samples::put(bytes, at, static_cast<std::uint32_t>(number));
  }
  std::string resized_header() {
    std::string bytes = sound_;
    std::size_t at = 64;
    for (std::size_t skipped = below(chunks_.size()); skipped > 0; --skipped)
      at += 64 + (samples::get<std::uint64_t>(bytes, at + 8) + 63) / 64 * 64;
    std::string header = bytes.substr(at, 16);
    if (below(2) == 0)
      change_number(header);
    else
      samples::put<std::uint64_t>(header, 8, below(bytes.size()));
    bytes.replace(at, 16, header);
    samples::sign_header(bytes, at);
    return bytes;
  }
  std::string rearranged() {
    auto chunks = chunks_;
    const std::size_t from = below(chunks.size());
    const ByteChunk moved = chunks[from];
    if (below(2) == 0) chunks.erase(chunks.begin() + static_cast<std::ptrdiff_t>(from));
    if (below(3) != 0)
      chunks.insert(chunks.begin() + static_cast<std::ptrdiff_t>(below(chunks.size() + 1)), moved);
    if (below(4) != 0) fix_end(chunks);
    return join_zoo(chunks);
  }
  template <typename Change>
  std::string with_payload(const Change& change) {
    auto chunks = chunks_;
    change(chunks[below(chunks.size())].payload);
    return join_zoo(chunks);
  }

  std::string sound_;
  std::vector<ByteChunk> chunks_;
  std::mt19937 random_{19980101};
};

TEST(ZooMutation, TenThousandChangesGiveAnErrorOrAValidMesh) {
  Mutator mutator(zoo_bytes(sample_file()));
  int accepted = 0;
  constexpr int kRounds = 10000;
  for (int round = 0; round < kRounds; ++round) {
    std::string complaint;
    ASSERT_NO_THROW(complaint = complaint_about(mutator.mutated())) << round;
    accepted += complaint.empty();
    ASSERT_EQ(complaint.find('\n'), std::string::npos) << complaint;
  }
  // some changes are harmless (a coordinate, a value, a chunk's place), most are not
  EXPECT_GT(accepted, kRounds / 20);
  EXPECT_LT(accepted, kRounds / 2);
}

}  // namespace
}  // namespace hiac

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include "hiac/base/error.hpp"
#include "hiac/base/process/page_buffer.hpp"
#include "hiac/mesh/file_descriptor.hpp"
#include "hiac/mesh/zoo_chunks.hpp"

namespace hiac {
namespace {

using namespace zoo_layout;

[[noreturn]] void refuse_early_end(const std::string& subject, const std::string& within,
                                   std::uint64_t expected, std::uint64_t found) {
  throw InputError(subject, fmt::format("stream ended before {} ({} bytes expected, {} found)",
                                        within, expected, found));
}

/// Reads `size` bytes into memory that never exceeds twice the size that has arrived (or
/// kFirstStep). Returns fewer bytes if the stream ends.
SharedArray<std::uint8_t> read_growing(int descriptor, std::uint64_t size,
                                       const std::string& subject) {
  constexpr std::uint64_t kFirstStep = std::uint64_t{1} << 20;
  const auto buffer = std::make_shared<PageBuffer>();
  std::uint64_t filled = 0;
  while (filled < size) {
    buffer->grow(std::min(size, std::max(kFirstStep, 2 * filled)));
    const auto free = buffer->bytes().subspan(filled);
    const std::size_t got = read_fully(descriptor, free, subject);
    filled += got;
    if (got < free.size()) break;
  }
  return {buffer->bytes().first(filled), buffer};
}

template <typename Header>
Header read_header(int descriptor, const std::string& subject, const std::string& what) {
  std::array<std::uint8_t, sizeof(Header)> bytes;
  const std::size_t got = read_fully(descriptor, bytes, subject);
  if (got < bytes.size()) refuse_early_end(subject, what, bytes.size(), got);
  return std::bit_cast<Header>(bytes);
}

void check_padding(std::span<const std::uint8_t> padding, const std::string& type,
                   const std::string& subject) {
  if (!std::ranges::all_of(padding, [](std::uint8_t byte) { return byte == 0; }))
    throw InputError(subject,
                     fmt::format("chunk {}: the padding is damaged (zeros expected)", type));
}

/// Returns the size of the payload with its padding. Throws InputError if 64 bits cannot hold it.
std::uint64_t padded_size(const ChunkHeader& header, const std::string& type,
                          const std::string& subject) {
  const std::uint64_t padding = padding_after(header.payload_bytes);
  if (header.payload_bytes > std::numeric_limits<std::uint64_t>::max() - padding)
    throw InputError(subject, fmt::format("chunk {}: impossible size ({} bytes found)", type,
                                          header.payload_bytes));
  return header.payload_bytes + padding;
}

std::string the_rest_of(const std::string& type, std::size_t number) {
  return fmt::format("the end of chunk {} ({})", number, type);
}

/// A memory-mapped file.
class FileMapping {
 public:
  FileMapping(int descriptor, std::size_t size, const std::string& path) : size_(size) {
    data_ = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (data_ == MAP_FAILED) throw InputError(path, "cannot be mapped into memory");
  }
  ~FileMapping() { ::munmap(data_, size_); }
  FileMapping(const FileMapping&) = delete;
  FileMapping& operator=(const FileMapping&) = delete;

  [[nodiscard]] std::span<const std::uint8_t> bytes() const {
    return {static_cast<const std::uint8_t*>(data_), size_};
  }

 private:
  void* data_;
  std::size_t size_;
};

/// Walks the mapped file from chunk to chunk.
std::vector<RawChunk> chunks_of(const std::shared_ptr<const FileMapping>& mapping,
                                const std::string& path) {
  std::span<const std::uint8_t> rest = mapping->bytes();
  const auto take = [&](std::uint64_t bytes, const std::string& what) {
    if (bytes > rest.size()) refuse_early_end(path, what, bytes, rest.size());
    const auto taken = rest.first(bytes);
    rest = rest.subspan(bytes);
    return taken;
  };
  FileHeader file_header;
  std::memcpy(&file_header, take(sizeof file_header, "the end of its header").data(),
              sizeof file_header);
  check_file_header(file_header, path);
  std::vector<RawChunk> chunks;
  do {
    ChunkHeader header;
    std::memcpy(&header, take(sizeof header, "its end chunk").data(), sizeof header);
    const std::string type = check_chunk_header(header, chunks.size(), path);
    const auto padded = take(padded_size(header, type, path), the_rest_of(type, chunks.size()));
    check_padding(padded.subspan(header.payload_bytes), type, path);
    chunks.push_back(
        {type, {padded.first(header.payload_bytes), mapping}, header.payload_checksum});
  } while (chunks.back().type != kEnd);
  if (!rest.empty())
    throw InputError(path, fmt::format("the file goes on after its end chunk (0 bytes expected, {} "
                                       "found)",
                                       rest.size()));
  return chunks;
}

/// Reads chunk after chunk as they arrive.
std::vector<RawChunk> chunks_of_stream(int descriptor, const std::string& subject) {
  check_file_header(read_header<FileHeader>(descriptor, subject, "the end of its header"), subject);
  std::vector<RawChunk> chunks;
  do {
    const auto header = read_header<ChunkHeader>(descriptor, subject, "its end chunk");
    const std::string type = check_chunk_header(header, chunks.size(), subject);
    const std::uint64_t size = padded_size(header, type, subject);
    const auto padded = read_growing(descriptor, size, subject);
    if (padded.size() < size)
      refuse_early_end(subject, the_rest_of(type, chunks.size()), size, padded.size());
    check_padding(padded.view().subspan(header.payload_bytes), type, subject);
    chunks.push_back({type,
                      {padded.view().first(header.payload_bytes),
                       std::make_shared<SharedArray<std::uint8_t>>(padded)},
                      header.payload_checksum});
  } while (chunks.back().type != kEnd);
  return chunks;
}

/// Reads the chunks of a container from a file, a pipe or a device.
std::vector<RawChunk> chunks_of_path(const std::string& path) {
  const FileDescriptor file = open_to_read(path);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) throw InputError(path, "cannot be examined");
  if (S_ISDIR(status.st_mode)) throw InputError(path, "is a directory (a file expected)");
  // pipes and devices have no size and cannot be mapped
  if (!S_ISREG(status.st_mode)) return chunks_of_stream(file.number(), path);
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) refuse_early_end(path, "the end of its header", sizeof(FileHeader), 0);
  return chunks_of(std::make_shared<const FileMapping>(file.number(), size, path), path);
}

}  // namespace

ZooFile read_zoo_file(const std::string& path, MeshNumbers numbers) {
  return assemble_zoo(chunks_of_path(path), path, numbers);
}

ZooFile read_zoo_stream(int descriptor, const std::string& subject, MeshNumbers numbers) {
  return assemble_zoo(chunks_of_stream(descriptor, subject), subject, numbers);
}

std::vector<ExtraChunk> read_extra_chunks(const std::string& path) {
  return extra_chunks(chunks_of_path(path), path);
}

}  // namespace hiac

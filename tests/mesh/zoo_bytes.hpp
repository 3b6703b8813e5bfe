#pragma once

// Written from zoo-container.md, not from the library's code.

#define XXH_INLINE_ALL

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <xxhash.h>

namespace hiac::samples {

struct ByteChunk {
  std::string type;
  std::string payload;
};

template <typename T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}
template <typename T>
T get(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// Makes the checksum of the chunk header at `at` fit its first 24 bytes.
inline void sign_header(std::string& bytes, std::size_t at) {
  put<std::uint64_t>(bytes, at + 24, XXH3_64bits(bytes.data() + at, 24));
}

/// The chunks of a sound container, the end chunk included.
inline std::vector<ByteChunk> split_zoo(const std::string& bytes) {
  std::vector<ByteChunk> chunks;
  for (std::size_t at = 64; at < bytes.size();) {
    const auto size = get<std::uint64_t>(bytes, at + 8);
    chunks.push_back({std::string(bytes.data() + at, strnlen(bytes.data() + at, 8)),
                      bytes.substr(at + 64, size)});
    at += 64 + (size + 63) / 64 * 64;
  }
  return chunks;
}

/// A container of the chunks with all checksums right, whatever the chunks say.
inline std::string join_zoo(const std::vector<ByteChunk>& chunks) {
  std::string bytes("\x89ZOO\r\n\x1a\n\x01", 9);
  bytes.resize(64);
  for (const ByteChunk& chunk : chunks) {
    const std::size_t at = bytes.size();
    bytes.resize(at + 64);
    chunk.type.copy(bytes.data() + at, 8);
    put<std::uint64_t>(bytes, at + 8, chunk.payload.size());
    put<std::uint64_t>(bytes, at + 16, XXH3_64bits(chunk.payload.data(), chunk.payload.size()));
    sign_header(bytes, at);
    bytes += chunk.payload;
    bytes.resize((bytes.size() + 63) / 64 * 64);
  }
  return bytes;
}

/// Makes the end chunk, when it is there, state the right number.
inline void fix_end(std::vector<ByteChunk>& chunks) {
  for (std::size_t i = 0; i < chunks.size(); ++i)
    if (chunks[i].type == "END" && chunks[i].payload.size() == 8)
      put<std::uint64_t>(chunks[i].payload, 0, i);
}

}  // namespace hiac::samples

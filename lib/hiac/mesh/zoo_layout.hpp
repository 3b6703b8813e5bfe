#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace hiac::zoo_layout {

// The container's layout in bytes, which zoo-container.md beside this file explains. Little-endian.
static_assert(std::endian::native == std::endian::little, "hiac needs a little-endian machine");

/// Payloads, and all arrays that are used in place, start at a multiple of this.
inline constexpr std::uint64_t kAlignment = 64;

/// No text starts like this, and every transfer as text changes it (like PNG's signature).
inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'Z', 'O', 'O', '\r', '\n', 0x1a, '\n'};
inline constexpr std::uint32_t kVersion = 1;

/// The start of every container.
struct FileHeader {
  std::array<std::uint8_t, 8> magic;
  std::uint32_t version;
  std::array<std::uint8_t, 52> zeros;
};
static_assert(sizeof(FileHeader) == kAlignment);

/// The start of every chunk. The payload follows, then zeros up to a multiple of kAlignment.
struct ChunkHeader {
  std::array<char, 8> type;        ///< printable ASCII, then zeros
  std::uint64_t payload_bytes;     ///< without the zeros that follow it
  std::uint64_t payload_checksum;  ///< XXH3, 64 bits, seed 0, of the payload
  std::uint64_t header_checksum;   ///< the same for the three members above
  std::array<std::uint8_t, 32> zeros;
};
static_assert(sizeof(ChunkHeader) == kAlignment);
/// Number of a chunk header's bytes that its own checksum covers.
inline constexpr std::size_t kCheckedHeaderBytes = offsetof(ChunkHeader, header_checksum);

/// The start of a FIELD chunk. Name and unit follow, then zeros up to a multiple of kAlignment from
/// the payload's start, then the values.
struct FieldHeader {
  std::uint32_t location;  ///< FieldLocation
  std::uint32_t components;
  std::uint32_t name_bytes;
  std::uint32_t unit_bytes;
};
static_assert(sizeof(FieldHeader) == 16);

/// The start of a FACEADJ chunk; the neighbours follow.
struct AdjacencyHeader {
  std::uint64_t overshared;
  std::array<std::uint8_t, 56> zeros;
};
static_assert(sizeof(AdjacencyHeader) == kAlignment);

inline constexpr std::string_view kMeta = "META";
inline constexpr std::string_view kKinds = "KINDS";
inline constexpr std::string_view kElems = "ELEMS";
inline constexpr std::string_view kNodes = "NODES";
inline constexpr std::string_view kXyz = "XYZ";
inline constexpr std::string_view kField = "FIELD";
inline constexpr std::string_view kFaceAdjacency = "FACEADJ";
inline constexpr std::string_view kEnd = "END";

/// Returns whether the mesh reader interprets chunks of this type.
constexpr bool is_known(std::string_view type) {
  for (const std::string_view known :
       {kMeta, kKinds, kElems, kNodes, kXyz, kField, kFaceAdjacency, kEnd})
    if (type == known) return true;
  return false;
}

/// Returns whether `type` can name a chunk: 1 to 8 printable ASCII characters without blanks.
constexpr bool is_type(std::string_view type) {
  if (type.empty() || type.size() > 8) return false;
  for (const char c : type)
    if (c <= ' ' || c > '~') return false;
  return true;
}

/// Number of padding zeros after `bytes` bytes.
constexpr std::uint64_t padding_after(std::uint64_t bytes) {
  return (kAlignment - bytes % kAlignment) % kAlignment;
}

}  // namespace hiac::zoo_layout

#include "hiac/mesh/mesh_hash.hpp"

#include <bit>
#include <new>
#include <span>

#include <fmt/format.h>
#include <xxhash.h>

namespace hiac {
namespace {

// Hashes are taken of the arrays as they lie in memory, and must be the same everywhere.
static_assert(std::endian::native == std::endian::little, "hiac needs a little-endian machine");

/// The 128-bit state of XXH3, fed with sizes and arrays.
class ContentHasher {
 public:
  ContentHasher() : state_(XXH3_createState()) {
    if (state_ == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(state_);
  }
  ~ContentHasher() { XXH3_freeState(state_); }
  ContentHasher(const ContentHasher&) = delete;
  ContentHasher& operator=(const ContentHasher&) = delete;

  /// The size goes first, so that no two sequences of arrays run together.
  template <typename T>
  void add(std::span<const T> array) {
    add_number(array.size());
    if (!array.empty()) XXH3_128bits_update(state_, array.data(), array.size_bytes());
  }
  void add_number(std::uint64_t number) { XXH3_128bits_update(state_, &number, sizeof number); }
  void add_text(const std::string& text) { add(std::span<const char>(text)); }

  [[nodiscard]] std::string hexadecimal() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_);
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
  }

 private:
  XXH3_state_t* state_;
};

void add_geometry(ContentHasher& hasher, const ZooMesh& mesh) {
  hasher.add(mesh.kinds.view());
  hasher.add(mesh.nodes.view());
  hasher.add(mesh.xyz.view());
}

}  // namespace

std::string geometry_hash(const ZooMesh& mesh) {
  ContentHasher hasher;
  add_geometry(hasher, mesh);
  return hasher.hexadecimal();
}

std::string numbers_hash(std::span<const std::uint64_t> nodes,
                         std::span<const std::uint64_t> cells) {
  ContentHasher hasher;
  hasher.add(nodes);
  hasher.add(cells);
  return hasher.hexadecimal();
}

std::string content_hash(const ZooMesh& mesh) {
  ContentHasher hasher;
  add_geometry(hasher, mesh);
  hasher.add_number(mesh.fields.size());
  for (const Field& field : mesh.fields) {
    hasher.add_text(field.name);
    hasher.add_text(field.unit);
    hasher.add_number(static_cast<std::uint64_t>(field.location));
    hasher.add_number(field.components);
    hasher.add(field.values.view());
  }
  return hasher.hexadecimal();
}

}  // namespace hiac

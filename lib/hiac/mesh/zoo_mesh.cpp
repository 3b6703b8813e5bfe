#include "hiac/mesh/zoo_mesh.hpp"

#include <bit>
#include <new>

#include <fmt/format.h>
#include <xxhash.h>

namespace hiac {
namespace {

// Hashes cover the arrays as they are in memory, and must be the same on every machine.
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

  /// The size comes first, so that different sequences of arrays differ.
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

}  // namespace

std::vector<std::uint64_t> face_offsets(const ZooMesh& mesh) {
  std::vector<std::uint64_t> offsets(mesh.cell_count() + 1);
  std::uint64_t faces = 0;
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    offsets[cell] = faces;
    faces += face_count(mesh.kinds[cell]);
  }
  offsets.back() = faces;
  return offsets;
}

std::string content_hash(const ZooMesh& mesh) {
  ContentHasher hasher;
  hasher.add(mesh.kinds.view());
  hasher.add(mesh.nodes.view());
  hasher.add(mesh.xyz.view());
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

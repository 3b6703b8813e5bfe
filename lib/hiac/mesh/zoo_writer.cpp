#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

#include <fmt/format.h>
#include <xxhash.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/atomic_file.hpp"
#include "hiac/mesh/file_descriptor.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/mesh/zoo_layout.hpp"

namespace hiac {
namespace {

using namespace zoo_layout;
using Bytes = std::span<const std::uint8_t>;

template <typename T>
Bytes bytes_of(std::span<const T> array) {
  return {reinterpret_cast<const std::uint8_t*>(array.data()), array.size_bytes()};
}
template <typename T>
Bytes bytes_of_value(const T& value) {
  return bytes_of(std::span<const T>(&value, 1));
}

void append(std::vector<std::uint8_t>& bytes, Bytes more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}
void append_text(std::vector<std::uint8_t>& bytes, const std::string& text) {
  append(bytes, bytes_of(std::span<const char>(text)));
}
std::uint32_t size_of_text(const std::string& text, const std::string& subject) {
  if (text.size() > std::numeric_limits<std::uint32_t>::max())
    throw InputError(subject, fmt::format("a text is too long to be written (below 4 GiB expected, "
                                          "{} bytes found)",
                                          text.size()));
  return static_cast<std::uint32_t>(text.size());
}

/// Writes a container chunk by chunk, front to back.
class ChunkWriter {
 public:
  ChunkWriter(int descriptor, const std::string& subject)
      : descriptor_(descriptor), subject_(subject) {
    FileHeader header{};
    header.magic = kMagic;
    header.version = kVersion;
    write_fully(descriptor_, bytes_of_value(header), subject_);
  }

  /// Writes a chunk whose payload is `front`, then `back`.
  void write(std::string_view type, Bytes front, Bytes back = {}) {
    ChunkHeader header{};
    std::memcpy(header.type.data(), type.data(), type.size());
    header.payload_bytes = front.size() + back.size();
    header.payload_checksum = checksum(front, back);
    header.header_checksum = XXH3_64bits(&header, kCheckedHeaderBytes);
    static constexpr std::array<std::uint8_t, kAlignment> kZeros{};
    write_fully(descriptor_, bytes_of_value(header), subject_);
    write_fully(descriptor_, front, subject_);
    write_fully(descriptor_, back, subject_);
    write_fully(descriptor_, Bytes(kZeros).first(padding_after(header.payload_bytes)), subject_);
    ++chunks_;
  }

  void write_end() {
    const std::uint64_t chunks = chunks_;
    write(kEnd, bytes_of_value(chunks));
  }

 private:
  static std::uint64_t checksum(Bytes front, Bytes back) {
    if (back.empty()) return XXH3_64bits(front.data(), front.size());
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         &XXH3_freeState);
    if (state == nullptr) throw std::bad_alloc();
    XXH3_64bits_reset(state.get());
    XXH3_64bits_update(state.get(), front.data(), front.size());
    XXH3_64bits_update(state.get(), back.data(), back.size());
    return XXH3_64bits_digest(state.get());
  }

  int descriptor_;
  const std::string& subject_;
  std::uint64_t chunks_ = 0;
};

void write_metadata(ChunkWriter& writer, const ZooMesh& mesh, const std::string& subject) {
  if (mesh.metadata.empty()) return;
  std::vector<std::uint8_t> payload;
  append(payload, bytes_of_value(static_cast<std::uint32_t>(mesh.metadata.size())));
  for (const auto& [key, value] : mesh.metadata) {
    append(payload, bytes_of_value(size_of_text(key, subject)));
    append(payload, bytes_of_value(size_of_text(value, subject)));
    append_text(payload, key);
    append_text(payload, value);
  }
  writer.write(kMeta, payload);
}

void write_field(ChunkWriter& writer, const Field& field, const std::string& subject) {
  const FieldHeader header{static_cast<std::uint32_t>(field.location), field.components,
                           size_of_text(field.name, subject), size_of_text(field.unit, subject)};
  std::vector<std::uint8_t> front;
  append(front, bytes_of_value(header));
  append_text(front, field.name);
  append_text(front, field.unit);
  front.resize(front.size() + padding_after(front.size()));
  writer.write(kField, front, bytes_of(field.values.view()));
}

void write_adjacency(ChunkWriter& writer, const FaceAdjacency& adjacency) {
  const AdjacencyHeader header{adjacency.overshared, {}};
  writer.write(kFaceAdjacency, bytes_of_value(header), bytes_of(adjacency.neighbors.view()));
}

void check_extra(const ExtraChunk& extra) {
  if (!is_type(extra.type) || is_known(extra.type))
    throw std::invalid_argument(fmt::format("'{}' cannot be an extra chunk's type", extra.type));
}

}  // namespace

void write_zoo_stream(int descriptor, const ZooFile& file, const std::string& subject) {
  const ZooMesh& mesh = file.mesh;
  validate(mesh, subject);
  for (const ExtraChunk& extra : file.extras) check_extra(extra);
  ChunkWriter writer(descriptor, subject);
  write_metadata(writer, mesh, subject);
  writer.write(kKinds, bytes_of(mesh.kinds.view()));
  writer.write(kElems, bytes_of(mesh.elems.view()));
  writer.write(kNodes, bytes_of(mesh.nodes.view()));
  writer.write(kXyz, bytes_of(mesh.xyz.view()));
  for (const Field& field : mesh.fields) write_field(writer, field, subject);
  if (mesh.adjacency) write_adjacency(writer, *mesh.adjacency);
  for (const ExtraChunk& extra : file.extras) writer.write(extra.type, extra.payload);
  writer.write_end();
}

void write_zoo_file(const std::string& path, const ZooFile& file) {
  write_atomically(path, [&](int descriptor) { write_zoo_stream(descriptor, file, path); });
}

void write_extra_chunks(const std::string& path, const std::vector<ExtraChunk>& extras) {
  auto extra = extras.begin();
  write_extra_chunks(path, [&] {
    return extra == extras.end() ? std::nullopt : std::optional<ExtraChunk>(*extra++);
  });
}

void write_extra_chunks(const std::string& path,
                        const std::function<std::optional<ExtraChunk>()>& next) {
  write_atomically(path, [&](int descriptor) {
    ChunkWriter writer(descriptor, path);
    for (auto extra = next(); extra; extra = next()) {
      check_extra(*extra);
      writer.write(extra->type, extra->payload);
    }
    writer.write_end();
  });
}

}  // namespace hiac

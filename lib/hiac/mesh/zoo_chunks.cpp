#include "hiac/mesh/zoo_chunks.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>
#include <xxhash.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"

namespace hiac {
namespace {

using namespace zoo_layout;

bool all_zero(std::span<const std::uint8_t> bytes) {
  return std::ranges::all_of(bytes, [](std::uint8_t byte) { return byte == 0; });
}

std::string hexadecimal(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes)
    text += fmt::format("{}{:02x}", text.empty() ? "" : " ", byte);
  return text;
}

/// Takes a payload apart from front to back; every step checks that the bytes exist.
class PayloadReader {
 public:
  PayloadReader(const RawChunk& chunk, const std::string& subject)
      : chunk_(chunk), subject_(subject) {}

  template <typename T>
  T take_value(const char* what) {
    T value;
    std::memcpy(&value, take(sizeof(T), what).data(), sizeof(T));
    return value;
  }
  std::string take_text(std::size_t bytes, const char* what) {
    const auto text = take(bytes, what);
    return {text.begin(), text.end()};
  }
  /// The zeros up to the next multiple of kAlignment.
  void take_padding() { require_zero(take(padding_after(position_), "padding")); }
  void require_zero(std::span<const std::uint8_t> bytes) const {
    if (!all_zero(bytes)) refuse("bytes that must be zero are not");
  }
  /// Takes all remaining bytes, as an array that shares the payload's storage.
  template <typename T>
  SharedArray<T> take_array() {
    const auto rest = take(chunk_.payload.size() - position_, "values");
    if (rest.size() % sizeof(T) != 0)
      refuse(
          fmt::format("the size is no whole number of values (a multiple of {} bytes expected, "
                      "{} found)",
                      sizeof(T), rest.size()));
    return {std::span(reinterpret_cast<const T*>(rest.data()), rest.size() / sizeof(T)),
            std::make_shared<SharedArray<std::uint8_t>>(chunk_.payload)};
  }
  void require_end() const {
    if (position_ != chunk_.payload.size())
      refuse(fmt::format("bytes are left over ({} expected, {} found)", position_,
                         chunk_.payload.size()));
  }

 private:
  std::span<const std::uint8_t> take(std::size_t bytes, const char* what) {
    const std::size_t left = chunk_.payload.size() - position_;
    if (bytes > left)
      refuse(fmt::format("the payload ends within its {} ({} bytes expected, {} found)", what,
                         bytes, left));
    position_ += bytes;
    return chunk_.payload.view().subspan(position_ - bytes, bytes);
  }
  [[noreturn]] void refuse(const std::string& message) const {
    throw InputError(subject_, fmt::format("chunk {}: {}", chunk_.type, message));
  }

  const RawChunk& chunk_;
  const std::string& subject_;
  std::size_t position_ = 0;
};

void check_payloads(const std::vector<RawChunk>& chunks, const std::string& subject) {
  std::vector<std::uint64_t> found(chunks.size());
  parallel_for(chunks.size(), 1, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      found[i] = XXH3_64bits(chunks[i].payload.data(), chunks[i].payload.size());
  });
  for (std::size_t i = 0; i < chunks.size(); ++i)
    if (found[i] != chunks[i].checksum)
      throw InputError(subject, fmt::format("chunk {} ({}): the payload is damaged (checksum "
                                            "{:016x} expected, {:016x} found)",
                                            i, chunks[i].type, chunks[i].checksum, found[i]));
}

/// Returns the only chunk of the type, or null if there is none and `required` is false.
const RawChunk* single(const std::vector<RawChunk>& chunks, std::string_view type, bool required,
                       const std::string& subject) {
  const RawChunk* found = nullptr;
  for (const RawChunk& chunk : chunks) {
    if (chunk.type != type) continue;
    if (found != nullptr)
      throw InputError(subject, fmt::format("chunk {} is there twice (one expected)", type));
    found = &chunk;
  }
  if (required && found == nullptr)
    throw InputError(subject, fmt::format("chunk {} is missing (one expected, none found)", type));
  return found;
}

void check_end(const std::vector<RawChunk>& chunks, const std::string& subject) {
  const RawChunk& end = *single(chunks, kEnd, true, subject);
  PayloadReader reader(end, subject);
  const auto count = reader.take_value<std::uint64_t>("number of chunks");
  reader.require_end();
  if (&end != &chunks.back() || count != chunks.size() - 1)
    throw InputError(subject, fmt::format("chunks are missing or too many ({} before the end chunk "
                                          "expected, {} found)",
                                          count, &end - chunks.data()));
}

template <typename T>
SharedArray<T> read_array(const std::vector<RawChunk>& chunks, std::string_view type,
                          const std::string& subject) {
  return PayloadReader(*single(chunks, type, true, subject), subject).take_array<T>();
}

std::vector<std::pair<std::string, std::string>> read_metadata(const RawChunk& chunk,
                                                               const std::string& subject) {
  PayloadReader reader(chunk, subject);
  std::vector<std::pair<std::string, std::string>> metadata;
  const auto count = reader.take_value<std::uint32_t>("number of entries");
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto key_bytes = reader.take_value<std::uint32_t>("size of a key");
    const auto value_bytes = reader.take_value<std::uint32_t>("size of a value");
    std::string key = reader.take_text(key_bytes, "key");
    std::string value = reader.take_text(value_bytes, "value");
    metadata.emplace_back(std::move(key), std::move(value));
  }
  reader.require_end();
  return metadata;
}

Field read_field(const RawChunk& chunk, const std::string& subject) {
  PayloadReader reader(chunk, subject);
  const auto header = reader.take_value<FieldHeader>("header");
  Field field;
  field.name = reader.take_text(header.name_bytes, "name");
  field.unit = reader.take_text(header.unit_bytes, "unit");
  if (header.location > static_cast<std::uint32_t>(FieldLocation::corner))
    throw InputError(subject, fmt::format("field {:?}: unknown location (below 3 expected, {} "
                                          "found)",
                                          field.name, header.location));
  field.location = static_cast<FieldLocation>(header.location);
  field.components = header.components;
  reader.take_padding();
  field.values = reader.take_array<double>();
  return field;
}

FaceAdjacency read_adjacency(const RawChunk& chunk, const std::string& subject) {
  PayloadReader reader(chunk, subject);
  const auto header = reader.take_value<AdjacencyHeader>("header");
  reader.require_zero(header.zeros);
  return {reader.take_array<CellId>(), header.overshared};
}

}  // namespace

void check_file_header(const FileHeader& header, const std::string& subject) {
  if (header.magic != kMagic)
    throw NotZooError(subject,
                      fmt::format("not a zoo container (the magic bytes {} expected, {} found)",
                                  hexadecimal(kMagic), hexadecimal(header.magic)),
                      {header.magic.begin(), header.magic.end()});
  if (header.version != kVersion)
    throw InputError(subject, fmt::format("unknown version of the zoo container ({} expected, {} "
                                          "found)",
                                          kVersion, header.version));
  if (!all_zero(header.zeros))
    throw InputError(subject, "the header is damaged (zeros expected after the version)");
}

std::string check_chunk_header(const ChunkHeader& header, std::size_t number,
                               const std::string& subject) {
  const std::uint64_t checksum = XXH3_64bits(&header, kCheckedHeaderBytes);
  if (checksum != header.header_checksum)
    throw InputError(subject, fmt::format("chunk {}: the header is damaged (checksum {:016x} "
                                          "expected, {:016x} found)",
                                          number, header.header_checksum, checksum));
  const auto end = std::ranges::find(header.type, '\0');
  std::string type(header.type.begin(), end);
  if (!is_type(type) || !std::all_of(end, header.type.end(), [](char c) { return c == 0; }) ||
      !all_zero(header.zeros))
    throw InputError(subject, fmt::format("chunk {}: the header is malformed (a printable type, "
                                          "then zeros expected)",
                                          number));
  return type;
}

std::vector<ExtraChunk> extra_chunks(const std::vector<RawChunk>& chunks,
                                     const std::string& subject) {
  check_payloads(chunks, subject);
  check_end(chunks, subject);
  std::vector<ExtraChunk> extras;
  for (const RawChunk& chunk : chunks)
    if (!is_known(chunk.type)) extras.push_back({chunk.type, chunk.payload});
  return extras;
}

ZooFile assemble_zoo(const std::vector<RawChunk>& chunks, const std::string& subject,
                     MeshNumbers numbers) {
  ZooFile file;
  file.extras = extra_chunks(chunks, subject);
  ZooMesh& mesh = file.mesh;
  mesh.kinds = read_array<CellKind>(chunks, kKinds, subject);
  mesh.elems = read_array<std::uint64_t>(chunks, kElems, subject);
  mesh.nodes = read_array<NodeId>(chunks, kNodes, subject);
  mesh.xyz = read_array<double>(chunks, kXyz, subject);
  if (const RawChunk* meta = single(chunks, kMeta, false, subject))
    mesh.metadata = read_metadata(*meta, subject);
  if (const RawChunk* adjacency = single(chunks, kFaceAdjacency, false, subject))
    mesh.adjacency = read_adjacency(*adjacency, subject);
  for (const RawChunk& chunk : chunks)
    if (chunk.type == kField) mesh.fields.push_back(read_field(chunk, subject));
  if (numbers == MeshNumbers::checked)
    validate(mesh, subject);
  else
    validate_layout(mesh, subject);
  return file;
}

}  // namespace hiac

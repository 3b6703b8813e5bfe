#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hiac/base/error.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/mesh/zoo_layout.hpp"

namespace hiac {

/// A chunk as read. Its header is checked, its payload's checksum not yet.
struct RawChunk {
  std::string type;
  SharedArray<std::uint8_t> payload;  ///< starts at a multiple of zoo_layout::kAlignment in memory
  std::uint64_t checksum;
};

/// What begins with other bytes than a zoo container.
class NotZooError : public InputError {
 public:
  NotZooError(const std::string& subject, const std::string& message, std::string beginning)
      : InputError(subject, message), beginning_(std::move(beginning)) {}
  /// The bytes that were found in place of the magic ones.
  [[nodiscard]] const std::string& beginning() const { return beginning_; }

 private:
  std::string beginning_;
};

/// Throws NotZooError unless `header` has a container's magic bytes, and InputError unless it is of
/// a supported version.
void check_file_header(const zoo_layout::FileHeader& header, const std::string& subject);

/// Returns the chunk's type. Throws InputError unless the header's checksum, type and zeros are
/// right. `number` counts the file's chunks from 0, for messages.
std::string check_chunk_header(const zoo_layout::ChunkHeader& header, std::size_t number,
                               const std::string& subject);

/// Makes a mesh from the chunks up to the end chunk. Checks the payloads' checksums (in parallel),
/// the set of chunks, every size, and the mesh's invariants as `numbers` demands. Throws
/// InputError.
ZooFile assemble_zoo(const std::vector<RawChunk>& chunks, const std::string& subject,
                     MeshNumbers numbers);

/// Checks kinds and sizes as validate (zoo_mesh.hpp) does, but not node numbers and coordinates.
void validate_layout(const ZooMesh& mesh, const std::string& subject);

/// Returns the chunks that the mesh reader does not interpret. Checks all payloads and the end
/// chunk. Throws InputError.
std::vector<ExtraChunk> extra_chunks(const std::vector<RawChunk>& chunks,
                                     const std::string& subject);

}  // namespace hiac

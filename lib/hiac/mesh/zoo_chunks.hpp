#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_container.hpp"
#include "hiac/mesh/zoo_layout.hpp"

namespace hiac {

/// One chunk as read. Its header is checked; the checksum of its payload is not checked yet.
struct RawChunk {
  std::string type;
  SharedArray<std::uint8_t> payload;  ///< begins at a multiple of zoo_layout::kAlignment in memory
  std::uint64_t checksum;
};

/// Throws InputError unless `header` begins a container of a version that can be read.
void check_file_header(const zoo_layout::FileHeader& header, const std::string& subject);

/// The chunk's type. Throws InputError unless the header's checksum, type and zeros are right.
/// `number` counts the file's chunks from 0, for errors.
std::string check_chunk_header(const zoo_layout::ChunkHeader& header, std::size_t number,
                               const std::string& subject);

/// Makes a mesh from the chunks up to the end chunk. Checks the payloads' checksums (in parallel),
/// the set of chunks, every size, and the mesh's invariants as `numbers` asks.
/// Throws InputError.
ZooFile assemble_zoo(const std::vector<RawChunk>& chunks, const std::string& subject,
                     MeshNumbers numbers);

/// The part of validate (zoo_mesh.hpp) that checks kinds and sizes; node numbers and coordinates
/// are not checked.
void validate_layout(const ZooMesh& mesh, const std::string& subject);

/// The chunks that this library's mesh part does not interpret. Checks all payloads and the end
/// chunk. Throws InputError.
std::vector<ExtraChunk> extra_chunks(const std::vector<RawChunk>& chunks,
                                     const std::string& subject);

}  // namespace hiac

#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A chunk that the mesh reader does not interpret, for example an order. Such chunks are kept in
/// order so that tools can pass them on.
struct ExtraChunk {
  std::string type;  ///< up to 8 characters
  SharedArray<std::uint8_t> payload;
};

/// The contents of one zoo container.
struct ZooFile {
  ZooMesh mesh;
  std::vector<ExtraChunk> extras;
};

/// Whether a reader checks node numbers and coordinates.
enum class MeshNumbers : std::uint8_t {
  checked,  ///< node numbers are in range and coordinates finite: all invariants hold
  as_given  ///< neither is checked: for programs that check the mesh themselves
};

/// Reads a zoo container by memory map: arrays refer to the file. Checks the magic bytes, the
/// version, every size against the existing data, checksums, the end chunk, and the mesh's
/// invariants as `numbers` demands. Throws InputError with the file, what was expected and what was
/// found. If the file is replaced afterwards, the arrays keep the old content; it must not be
/// shortened or overwritten in place. A pipe or a device is read as a stream.
ZooFile read_zoo_file(const std::string& path, MeshNumbers numbers = MeshNumbers::checked);

/// Reads a zoo container from an open file descriptor (a pipe) up to its end chunk. Memory grows
/// with the data that arrives, never with a size in a header. `subject` names the stream in
/// messages.
ZooFile read_zoo_stream(int descriptor, const std::string& subject,
                        MeshNumbers numbers = MeshNumbers::checked);

/// Writes a container front to back, without seeking. Throws InputError if the write fails.
void write_zoo_stream(int descriptor, const ZooFile& file, const std::string& subject);

/// Writes a file beside `path`, then renames it (see write_atomically), so that `path` is complete
/// or unchanged.
void write_zoo_file(const std::string& path, const ZooFile& file);

/// Reads only the extra chunks of a container, with or without a mesh. Checks the container as
/// read_zoo_file does, but not the mesh. Throws InputError.
std::vector<ExtraChunk> read_extra_chunks(const std::string& path);

/// Writes a container that holds extra chunks and no mesh, completely or not at all.
void write_extra_chunks(const std::string& path, const std::vector<ExtraChunk>& extras);

/// Writes all chunks that `next` returns until it returns none; no chunk stays in memory.
void write_extra_chunks(const std::string& path,
                        const std::function<std::optional<ExtraChunk>()>& next);

}  // namespace hiac

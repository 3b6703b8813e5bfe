#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A chunk that this library's mesh part does not interpret: an order, say. Kept, in order, so that
/// tools can pass it on.
struct ExtraChunk {
  std::string type;  ///< up to 8 characters
  SharedArray<std::uint8_t> payload;
};

/// What one zoo container holds.
struct ZooFile {
  ZooMesh mesh;
  std::vector<ExtraChunk> extras;
};

/// What a reader asks of a mesh's numbers: of the nodes that cells name, and of coordinates.
enum class MeshNumbers : std::uint8_t {
  checked,  ///< nodes are there, coordinates are finite: all of the mesh's invariants
  as_given  ///< neither: for those who judge the mesh themselves
};

/// Reads a zoo container by memory map: arrays look into the file. Checks magic, version, every
/// size against what is there, checksums, the end chunk, and the mesh's invariants but for
/// `numbers`. Throws InputError naming the file, what was expected and what was found. A file that
/// is replaced afterwards keeps its old content here; it must not be shortened or overwritten in
/// place. A pipe or a device is read as a stream.
ZooFile read_zoo_file(const std::string& path, MeshNumbers numbers = MeshNumbers::checked);

/// Reads a zoo container from an open file descriptor (a pipe) to its end chunk. Memory grows with
/// what arrives, never with what a header announces. `subject` names the stream in errors.
ZooFile read_zoo_stream(int descriptor, const std::string& subject,
                        MeshNumbers numbers = MeshNumbers::checked);

/// Writes a container front to back; never seeks. Throws InputError when the write fails.
void write_zoo_stream(int descriptor, const ZooFile& file, const std::string& subject);

/// Writes a file beside `path`, then renames it (see write_atomically): `path` is whole or
/// untouched.
void write_zoo_file(const std::string& path, const ZooFile& file);

/// The extra chunks of a container alone, whether it holds a mesh or not. Checks what read_zoo_file
/// checks of the container, and nothing of a mesh. Throws InputError.
std::vector<ExtraChunk> read_extra_chunks(const std::string& path);

/// Writes a container that holds extra chunks and no mesh; whole or not at all.
void write_extra_chunks(const std::string& path, const std::vector<ExtraChunk>& extras);

/// The same with all chunks that `next` returns, one after another; none is kept.
void write_extra_chunks(const std::string& path,
                        const std::function<std::optional<ExtraChunk>()>& next);

}  // namespace hiac

#pragma once

#include <cstddef>
#include <string>

#include "hiac/mesh/parted/mesh_part.hpp"
#include "hiac/mesh/parted/parted_index.hpp"
#include "hiac/mesh/zoo_container.hpp"

namespace hiac {

/// The extra chunks of a part's zoo container: one u64 a node, and one a cell.
inline constexpr const char* kGlobalNodesChunk = "GNODES";
inline constexpr const char* kGlobalCellsChunk = "GCELLS";

/// Reads one part by memory map (read_zoo_file) and compares it with the index: cells, nodes, box
/// and both hashes. Checks that the global numbers rise strictly and are below those of the whole
/// mesh. What parts have in common is left to PartAgreement (part_agreement.hpp). Throws InputError
/// naming the part's file, what was expected and what was found.
MeshPart read_mesh_part(const PartedIndex& index, std::size_t part);

/// A part's zoo container. It holds the part's arrays, not copies.
ZooFile zoo_file_of(const MeshPart& part);

/// Returns what an index says of a part whose file has that name.
PartInfo part_info(const MeshPart& part, const std::string& file);

}  // namespace hiac

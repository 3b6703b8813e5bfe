#pragma once

#include <span>
#include <vector>

#include "hiac/mesh/parted/mesh_part.hpp"
#include "hiac/mesh/parted/parted_index.hpp"

namespace hiac {

/// Reads all parts, each by memory map (read_mesh_part), and checks that they agree
/// (check_agreement). Throws InputError.
std::vector<MeshPart> read_all_parts(const PartedIndex& index);

/// Joins the parts to the whole mesh, whose content_hash the index names: its cells and nodes in
/// their order, its fields, and the metadata of part 0; the adjacency is omitted and must be
/// computed again. Throws InputError: the whole mesh is too large for one mesh, or has another
/// hash.
ZooMesh join_parts(const PartedIndex& index, std::span<const MeshPart> parts);

}  // namespace hiac

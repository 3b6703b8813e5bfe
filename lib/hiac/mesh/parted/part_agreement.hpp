#pragma once

#include <span>

#include "hiac/mesh/parted/mesh_part.hpp"
#include "hiac/mesh/parted/parted_index.hpp"

namespace hiac {

/// Checks that parts, all those of the index and each read by read_mesh_part, are those of one
/// mesh: the same fields; every cell of the whole in exactly one part and every node in one at
/// least; and of a node that several parts share the same coordinates and values, bit for bit.
/// Takes 8 bytes a node of the whole and a bit a cell. Throws InputError naming the file of a part,
/// and what it has in common with which other.
void check_agreement(const PartedIndex& index, std::span<const MeshPart> parts);

}  // namespace hiac

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/mesh/parted/mesh_part.hpp"

namespace hiac {

/// Two parts that are neighbours, and how many faces they have in common.
struct PartContact {
  std::uint32_t part, other;  ///< part < other
  std::uint64_t faces;
};

/// Finds the neighbours among the parts of a mesh, by ascending `part`, then `other`. Faces are the
/// same if their corners have the same global numbers; a face that more than two parts share counts
/// for none, as one that more than two cells share is unmatched (FaceAdjacency). Takes 40 bytes a
/// face of the parts' boundaries; a part without adjacency has it computed.
std::vector<PartContact> part_contacts(std::span<const MeshPart> parts);

}  // namespace hiac

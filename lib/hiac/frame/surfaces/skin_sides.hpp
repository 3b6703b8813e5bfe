#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// An edge of a face of the skin.
struct SkinSide {
  std::array<NodeId, 2> edge;  ///< its ends, the lower one first
  CellId cell;
  std::uint8_t face;  ///< of the cell
  bool ascending;     ///< whether the face's corners pass the edge from its lower end
};

/// The edges of all faces of a skin, by ascending edges. `faces`: a bit for each face of every
/// cell, set on the skin.
std::vector<SkinSide> skin_sides(const ZooMesh& mesh, std::span<const std::uint8_t> faces);

/// Those of one edge; `sides`: the result of skin_sides.
std::span<const SkinSide> sides_at(std::span<const SkinSide> sides, std::array<NodeId, 2> edge);

}  // namespace hiac

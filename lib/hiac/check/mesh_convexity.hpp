#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// An edge at which a mesh bends inwards, and the two cells whose boundary faces meet there.
struct ReentrantEdge {
  NodeId low, high;
  CellId first, second;

  bool operator==(const ReentrantEdge&) const = default;
};

enum class Convexity : std::uint8_t { convex, not_convex, unknown };

/// Whether the region that a mesh fills is convex, so that no straight line meets it in more than
/// one piece, and what refutes it.
struct MeshConvexity {
  Convexity verdict = Convexity::unknown;
  std::vector<ReentrantEdge> edges;  ///< ascending
  std::size_t surfaces = 0;          ///< boundary surfaces, connected across edges: 1 when convex
  std::string_view reason;           ///< of what is unknown
};

/// Decides by exact determinants. Convex: boundary_is_convex (H. Tietze, 1928; S. Nakajima, 1928).
/// Not convex: a boundary face has a corner of the next one strictly on its outer side, which no
/// convex body can have; or the boundary is several surfaces, around gaps or cavities. Unknown:
/// boundary faces that are curved or not planar, cells without volume, edges with other numbers of
/// boundary faces than two, or faces that lie on others without being shared (`interfaces`), where
/// what looks like the boundary is inside.
MeshConvexity judge_convexity(const ZooMesh& mesh, const FaceAdjacency& adjacency, bool interfaces);

}  // namespace hiac

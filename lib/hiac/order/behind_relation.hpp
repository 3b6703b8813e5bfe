#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Arrows of the behind-relation across one face of a cell, as seen from that cell. A viewing ray
/// meets a cell before another one that lies behind it.
enum FaceArrows : std::uint8_t {
  kNoArrow = 0,        ///< no ray crosses the face: it is seen edge-on, or has no neighbour
  kNeighborFirst = 1,  ///< rays come from the neighbour into this cell
  kCellFirst = 2,      ///< rays go from this cell into the neighbour
  kBothWays = 3        ///< rays may cross either way: undecidable, or the cells overlap
};

/// The relation across shared faces, for every face of every cell in the numbering of
/// FaceAdjacency. What one side of a face says is what the other says, mirrored.
struct BehindRelation {
  std::vector<std::uint64_t> face_offset;  ///< see face_offsets()
  std::vector<std::uint8_t> arrows;        ///< FaceArrows of every face
  std::uint64_t both_ways = 0;             ///< number of shared faces with arrows both ways
};

/// Decides every shared face by exact orientation determinants of the input coordinates
/// (design: source 1 and, for what cannot be decided, source 3).
///
/// A face is on the side of its plane on which the rest of its cell lies; the eye's side against
/// that says which way rays cross. Quadrilaterals are bilinear patches: when the eye lies on one
/// side of the four corner triangles all rays cross one way, else both arrows are put, unless the
/// patch deviates from a plane by less than `planarity` of its size. A cell without volume has no
/// side of its own and takes what its neighbours say; between two such cells go both arrows
/// where rays cross the face. All faces that the same two cells share get the same arrows.
///
/// Throws InputError when the adjacency is not mutual: when a cell names a neighbour that does not
/// name it back as often.
BehindRelation shared_face_relation(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                                    const View& view, double planarity);

/// Deviation of a quadrilateral from a plane: the distance between its two diagonals' lines,
/// divided by the longer diagonal. 0 for a degenerate face.
double quadrilateral_deviation(std::span<const double, 3> a, std::span<const double, 3> b,
                               std::span<const double, 3> c, std::span<const double, 3> d);

}  // namespace hiac

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/geometry/face_form.hpp"
#include "hiac/geometry/view.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// Arrows of the behind-relation across one face of a cell, as seen from that cell. A viewing ray
/// meets a cell before another one that lies behind it.
enum FaceArrows : std::uint8_t {
  kNoArrow = 0,        ///< no ray crosses the face: it is seen edge-on, or has no neighbour
  kNeighborFirst = 1,  ///< rays come from the neighbour into this cell
  kCellFirst = 2,      ///< rays go from this cell into the neighbour
  kBothWays = 3        ///< rays may cross either way: undecidable, or the cells overlap
};

/// The arrows across all faces of one cell: bit f of each mask is the cell's face f.
struct CellArrows {
  std::uint8_t cell_first = 0;
  std::uint8_t neighbor_first = 0;

  [[nodiscard]] FaceArrows across(std::size_t face) const {
    return static_cast<FaceArrows>(((cell_first >> face) & 1U) << 1 |
                                   ((neighbor_first >> face) & 1U));
  }
  void set(std::size_t face, unsigned arrows) {
    const auto put = [face](std::uint8_t& mask, unsigned on) {
      mask = static_cast<std::uint8_t>((mask & ~(1U << face)) | (on << face));
    };
    put(cell_first, arrows >> 1 & 1U);
    put(neighbor_first, arrows & 1U);
  }
};

/// The number of faces in a mask. (Without an instruction for it, which not every processor has,
/// std::popcount is a call.)
constexpr unsigned count_faces(unsigned mask) {
  constexpr std::uint64_t kOnesOfThreeBits = 0x32212110;  // nibble k: the ones in k
  return static_cast<unsigned>((kOnesOfThreeBits >> (4 * (mask & 7U))) & 7U) +
         static_cast<unsigned>((kOnesOfThreeBits >> (4 * (mask >> 3 & 7U))) & 7U);
}

/// The relation across shared faces. What one side of a face says is what the other says, mirrored.
struct BehindRelation {
  std::vector<CellArrows> of_cell;
  std::uint64_t both_ways = 0;  ///< number of shared faces with arrows both ways
  std::uint64_t edge_on = 0;    ///< number of shared faces that no ray crosses
};

/// Decides every shared face by exact orientation determinants of the input coordinates
/// (design: source 1 and, for what cannot be decided, source 3).
///
/// A face is on the side of its plane on which the rest of its cell lies; the eye's side against
/// that says which way rays cross. Quadrilaterals are bilinear patches: when the eye lies on one
/// side of the four corner triangles all rays cross one way, else both arrows are put, unless the
/// patch deviates from a plane by less than `planarity` of its size: then it is seen edge-on. Faces
/// with curved edges: the same by Bernstein coefficients (patch_side.hpp). A
/// cell without volume has no side of its own and takes what its neighbours say; between two such
/// cells go both arrows where rays cross the face. All faces that the same two cells share get the
/// same arrows.
BehindRelation shared_face_relation(const OrderBasis& basis, const View& view, double planarity);

}  // namespace hiac

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/geometry/face_form.hpp"
#include "hiac/geometry/view.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// The arrows of the behind-relation across one face of a cell, as seen from that cell. An arrow
/// leads from a cell to another one that viewing rays meet behind it.
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

/// Returns the number of faces in a mask. (std::popcount would be a function call, as not every
/// processor has an instruction for it.)
constexpr unsigned count_faces(unsigned mask) {
  constexpr std::uint64_t kOnesOfThreeBits = 0x32212110;  // nibble k: the ones in k
  return static_cast<unsigned>((kOnesOfThreeBits >> (4 * (mask & 7U))) & 7U) +
         static_cast<unsigned>((kOnesOfThreeBits >> (4 * (mask >> 3 & 7U))) & 7U);
}

/// The relation across shared faces. Both cells of a face store its arrows, mirrored.
struct BehindRelation {
  std::vector<CellArrows> of_cell;
  std::uint64_t both_ways = 0;  ///< number of shared faces with arrows both ways
  std::uint64_t edge_on = 0;    ///< number of shared faces that no ray crosses
};

/// Decides every shared face by exact orientation determinants of the input coordinates (sources 1
/// and 3 of docs/visibility-order.md).
///
/// A cell lies on a known side of its face's plane; whether the eye lies on the same side tells
/// which way rays cross the face. Quadrilaterals are bilinear patches: when the eye lies on the
/// same side of the triangles at all four corners, all rays cross one way; otherwise both arrows
/// are set, unless the patch deviates from a plane by less than `planarity` of its size and so is
/// seen edge-on. Faces with curved edges are decided likewise by Bernstein coefficients
/// (patch_side.hpp). A cell without volume has no side of its own and takes its neighbours'
/// answers; between two such cells both arrows are set if rays cross the face. All faces that the
/// same two cells share get the same arrows.
BehindRelation shared_face_relation(const OrderBasis& basis, const View& view, double planarity);

}  // namespace hiac

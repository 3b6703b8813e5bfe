#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/geometry/predicates.hpp"
#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/published/face_plane.hpp"

namespace hiac {

/// Decides for pairs of convex cells whether one obstructs the other: the subroutines Obstructs and
/// ProjectsBehind of P. Williams, N. Max, C. Stein, "A High Accuracy Volume Renderer for
/// Unstructured Data", 1998, sections 6 and 6.1, except for the tests of extents, which the caller
/// performs (screen_extents.hpp).
///
/// Where the paper computes with transformed and rounded coordinates, exact determinants of the
/// input coordinates decide: for the planes of triangles, for crossings of edges on the screen and
/// their depths, and, where edges do not cross properly (the two configurations of section 6.1, and
/// edges that meet or hide each other exactly), for the overlap of faces on the screen. If no plane
/// separates two cells exactly, one that separates them to within the rounding of their coordinates
/// counts.
///
/// Exact for cells with planar faces that overlap by no more than rounding. A cell without volume
/// obstructs nothing. The object refers to the mesh, which must outlive it, and takes a byte per
/// face.
class CellObstruction {
 public:
  /// `planarity` is the deviation, relative to the size of a face, below which a quadrilateral
  /// counts as planar.
  CellObstruction(const ZooMesh& mesh, const View& view, double planarity);

  /// A cell prepared for tests against others; the planes of its faces are computed when needed.
  class Cell {
   public:
    Cell(const ZooMesh& mesh, CellId cell, const std::uint8_t* how_faces_lie)
        : id(cell),
          corners(mesh, cell),
          faces(topology_of(mesh.kinds[cell]).faces),
          facing(how_faces_lie, faces.size()) {}

    /// The plane of a face, with its normal pointing outwards.
    const FacePlane& plane(std::size_t face, const MeshScale& scale);

    CellId id;
    CellCorners corners;
    std::span<const ShapeFace> faces;
    std::span<const std::uint8_t> facing;  ///< how the eye sees each face, a byte per face

   private:
    std::uint32_t known_ = 0;  // a bit per plane
    std::array<FacePlane, 6> planes_;
  };
  [[nodiscard]] Cell cell(CellId id) const {
    return {mesh_, id, facing_.data() + face_offset_[id]};
  }

  /// Returns whether some ray meets `p` before `q`; false if no ray meets both.
  [[nodiscard]] bool obstructs(Cell& p, Cell& q) const;

 private:
  /// Whether a plane separates two cells exactly (`surely`) or only to within rounding (`nearly`).
  enum class Separation : std::uint8_t { none, nearly, surely };

  [[nodiscard]] Separation beyond(Cell& of, std::size_t face, const CellCorners& corners) const;
  [[nodiscard]] Separation nearly_beyond(Cell& of, std::size_t face, const CellCorners& corners,
                                         const std::array<double, 8>& values) const;
  [[nodiscard]] Separation lies_behind(Cell& p, Cell& q) const;
  [[nodiscard]] bool separated_by_edge(const Cell& p, const Cell& q) const;
  [[nodiscard]] bool projections_meet(const Cell& p, const Cell& q) const;
  [[nodiscard]] bool projects_before(const Cell& p, const Cell& q) const;

  const ZooMesh& mesh_;
  View view_;
  double planarity_;
  MeshScale scale_;
  std::vector<std::uint64_t> face_offset_;
  std::vector<std::uint8_t> facing_;
};

}  // namespace hiac

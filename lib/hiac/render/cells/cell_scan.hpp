#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "hiac/element/cell_surface.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/pixel_mask.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/render/cells/curved/curved_faces.hpp"

namespace hiac {

/// Where the ray of pixel (x, y) enters and leaves a cell: ray parameters, front <= back.
struct CellCrossing {
  int x, y;
  double front, back;
  std::uint8_t front_face, back_face;  ///< CellSurface::Triangle::face
  /// Reference coordinates of the two points if their faces are curved, otherwise NaN.
  std::array<double, 3> front_reference, back_reference;
  /// How far rounding may have moved the two points along the ray, in world units
  /// (CurvedFaces::doubt), if the face is curved and errors are requested; otherwise NaN.
  double front_doubt, back_doubt;
};

/// Reference coordinates of a point where the ray enters or leaves through a curved face; NaN if
/// both faces are planar.
inline std::array<double, 3> place_of(const CellCrossing& crossing) {
  return std::isnan(crossing.front_reference[0]) ? crossing.back_reference
                                                 : crossing.front_reference;
}

/// Appends the crossings of a cell with the rays of a tile's pixels, ray by ray front to back;
/// z-clipping is not applied. All corners must be projectable (ProjectedNode). `curved`: the cell's
/// curved faces (curved_faces.hpp), or null if it has none; a cell without curved faces is convex.
///
/// A pixel belongs to a triangle of the surface by the rule of the tetrahedron kernel
/// (scan_conversion-inl.hpp), and depths on triangles are computed as there, operation by
/// operation: on a shared face this function and the kernel find the same pixels and the same
/// depths. A triangle seen edge-on, whose depth would depend on rounding alone, takes the depth of
/// the point where the row of pixels enters it; the kernel does not draw cells with such faces
/// (kernel_cells.hpp). A ray that lies in faces to within rounding may cross a cell several times;
/// neighbouring cells divide such a ray without gap or overlap.
void scan_projected_cell(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                         const TileRect& tile, std::vector<CellCrossing>& crossings,
                         const PixelMask* only = nullptr);

/// Crossings of a cell without curved faces by the rays of rows of pixels, where each ray enters
/// and leaves once. Structure of arrays: a run owns `count` entries from `first` on.
struct CrossingRuns {
  struct Run {
    int x, y;  ///< the first pixel
    std::size_t first, count;
  };
  std::vector<Run> runs;
  std::vector<double> front, back;  ///< ray parameters; padded to whole vectors
  std::size_t count = 0;

  /// Removes all runs.
  void clear() {
    runs.clear();
    count = 0;
  }
};

/// Does the work of scan_projected_cell for a cell without curved faces, many rays at a time. Where
/// a ray of a row does not enter and leave exactly once, because it runs along a surface that
/// rounding has roughened, the crossings of the whole row go to `others`.
void scan_projected_runs(const Frame& frame, const CellSurface& surface, const TileRect& tile,
                         CrossingRuns& runs, std::vector<CellCrossing>& others);

/// Does the same for a cell some of whose nodes are not projectable, in perspective: parts of the
/// cell lie beside or behind the eye. So may the crossings; behind it front and back are below 0.
///
/// Scan conversion takes place in three dimensions. The plane through the eye and a row of pixel
/// centres separates the nodes, as the row does on the screen; it cuts triangles in straight pieces
/// between two of their edges. In that plane, each cut edge lies to the left or to the right of the
/// line through the eye and a pixel centre; the line crosses a triangle if the triangle's two edges
/// lie on different sides. For an edge with projectable nodes both tests give the same answer as on
/// the screen. Therefore every line crosses the surfaces of all cells consistently, whatever
/// rounding does, and the tie break is the same: the pixel is moved right, and then down, by
/// infinitesimal amounts.
void scan_cell_beside_eye(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                          const TileRect& tile, std::vector<CellCrossing>& crossings,
                          const PixelMask* only = nullptr);

/// Whether all corners are projectable (ProjectedNode).
bool is_projectable(const Frame& frame, const CellSurface& surface);

/// Appends the crossings of a cell of the frame's mesh, by scan_projected_cell or
/// scan_cell_beside_eye, whichever applies. `only`, if it is not null, limits the work to rays of
/// these pixels; others may be appended all the same.
void scan_cell(const Frame& frame, CellId cell, const TileRect& tile,
               std::vector<CellCrossing>& crossings, const PixelMask* only = nullptr);

}  // namespace hiac

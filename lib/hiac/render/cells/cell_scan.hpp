#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "hiac/element/cell_surface.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/render/cells/curved_faces.hpp"

namespace hiac {

/// Where the ray of pixel (x, y) enters and leaves a cell: ray parameters, front <= back.
struct CellCrossing {
  int x, y;
  double front, back;
  std::uint8_t front_face, back_face;  ///< CellSurface::Triangle::face
  /// Reference coordinates of the places, where the faces are curved; else not numbers.
  std::array<double, 3> front_reference, back_reference;
  /// How far along the ray, in world units, rounding may have moved the places: where faces are
  /// curved and errors are asked for (CurvedFaces::doubt); else not a number.
  double front_doubt, back_doubt;
};

/// Reference coordinates of a place where the ray enters or leaves through a curved face; where
/// both faces are planar, not numbers.
inline std::array<double, 3> place_of(const CellCrossing& crossing) {
  return std::isnan(crossing.front_reference[0]) ? crossing.back_reference
                                                 : crossing.front_reference;
}

/// Appends the crossings of a cell with the rays of a tile's pixels, ray by ray front to back;
/// z-clipping is not applied. All corners must be projectable (ProjectedNode). `curved`: the cell's
/// faces that are not planar (curved_faces.hpp), none where it is null; a cell that has none is
/// convex.
///
/// A pixel belongs to a triangle of the surface by the rule of the tetrahedron kernel
/// (scan_conversion-inl.hpp), and depths on triangles are computed as there, operation by
/// operation: on a shared face this and the kernel find the same pixels and the same depths. A
/// triangle seen edge-on, whose depth rounding would decide, lies where the row of pixels enters
/// it; the kernel does not draw cells with such faces (kernel_cells.hpp). A ray that runs in faces
/// to within rounding may cross a cell several times; cells share what such rays see without gap
/// or overlap.
void scan_projected_cell(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                         const TileRect& tile, std::vector<CellCrossing>& crossings);

/// Crossings of a cell without curved faces with the rays of rows of pixels, each of which enters
/// and leaves it once: arrays, of which a run has `count` from `first` on.
struct CrossingRuns {
  struct Run {
    int x, y;  ///< the first pixel
    std::size_t first, count;
  };
  std::vector<Run> runs;
  std::vector<double> front, back;  ///< ray parameters; with places for vectors behind the last
  std::size_t count = 0;

  /// There are none yet.
  void clear() {
    runs.clear();
    count = 0;
  }
};

/// scan_projected_cell for a cell without curved faces, many rays at a time. Rows some of whose
/// rays do not enter and leave once, along surfaces that rounding has roughened, go to `others`.
void scan_projected_runs(const Frame& frame, const CellSurface& surface, const TileRect& tile,
                         CrossingRuns& runs, std::vector<CellCrossing>& others);

/// The same for a cell some of whose nodes are not projectable, in perspective: parts of it lie
/// beside or behind the eye, and so may the crossings (front and back below 0).
///
/// Scan conversion goes on in three dimensions. The plane through the eye and a row of pixel
/// centres separates the nodes, as the row does on the screen; it cuts triangles in straight
/// pieces between their edges. In that plane the line through the eye and a pixel centre has edges
/// on its left and on its right; a triangle is crossed where its two edges lie on different sides.
/// For an edge with projectable nodes both questions have the answer that the screen gives. So
/// every line crosses the surfaces of all cells consistently, whatever rounding does, and the tie
/// break is the same: the pixel is moved right, and then down, by infinitesimal amounts.
void scan_cell_beside_eye(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                          const TileRect& tile, std::vector<CellCrossing>& crossings);

/// Whether all corners are projectable (ProjectedNode).
bool is_projectable(const Frame& frame, const CellSurface& surface);

/// The crossings of a cell of the frame's mesh, by whichever of the two is for it.
void scan_cell(const Frame& frame, CellId cell, const TileRect& tile,
               std::vector<CellCrossing>& crossings);

}  // namespace hiac

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/element/cell_surface.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/screen_bounds.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/geometry/face_form.hpp"
#include "hiac/geometry/patch_zeros.hpp"
#include "hiac/render/cells/curved/curved_edge.hpp"
#include "hiac/render/cells/curved/curved_face.hpp"

namespace hiac {

/// The curved faces of one cell, and where rays cross them.
///
/// How often a face covers a pixel, signed by the side that faces the eye, is the number of times
/// that its projected border winds around the pixel centre. This number depends on the edges alone,
/// and each edge is evaluated identically for all faces that share it, so that the surface of a
/// cell, and that of a whole mesh, is closed. The crossing point itself is computed from the face's
/// nodes, in an order that both cells of the face share (patch_zeros): they find the same
/// crossings, to the bit.
///
/// The caller supplies where a row of pixel centres crosses a straight edge
/// (edge_crossings-inl.hpp); of curved edges CurvedEdge knows. All computations are in homogeneous
/// coordinates and equally valid beside and behind the eye.
class CurvedFaces {
 public:
  static constexpr std::size_t kMostFaces = 6, kMostZeros = kMostFaces * PatchZeros::kMost;

  /// `surface` is that of the cell.
  CurvedFaces(const Frame& frame, CellId cell, const CellSurface& surface);

  [[nodiscard]] bool holds(std::size_t face) const { return ((held_ >> face) & 1U) != 0; }
  [[nodiscard]] bool has_curved_edges() const { return curve_count_ > 0; }
  /// The bounds on the screen of the curved faces alone.
  [[nodiscard]] ScreenBounds bounds() const;

  /// Selects a row of pixel centres; `above` tells which corners of the surface lie on the row or
  /// above it.
  void begin_row(double center, const TileRect& tile, const bool* above);
  /// The range of columns of the row outside which no curved face covers a pixel, except between
  /// straight edges.
  [[nodiscard]] std::array<int, 2> columns() const { return columns_; }

  /// Calls visit(t, face, u, v) for every crossing by the ray of pixel x of the row. The pixels of
  /// a row must be visited from left to right. `left(e)`: whether the row crosses the straight edge
  /// e of the surface left of the pixel.
  template <typename Left, typename Visit>
  void at_pixel(int x, const Left& left, const Visit& visit) {
    for (std::size_t k = 0; k < count_; ++k) {
      CurvedFace& face = faces_[k];
      if (!face.in_row) continue;
      const int winding = winding_of(face, x, left);
      if (winding == 0 && (face.turns != 0 || x < face.first || x >= face.last)) continue;
      for (const PatchZero& zero : face.crossings(pixel_center(x), winding))
        visit(face.parameter(zero), face.number, zero.u, zero.v);
    }
  }

  /// Whether `doubt` may be called: true if the frame requests errors.
  [[nodiscard]] bool with_doubts() const { return displaced_ > 0; }
  /// How far rounding may have displaced faces (RayDisplacement), in world units.
  [[nodiscard]] double displaced() const { return displaced_; }
  /// How far the computed crossing (u, v) of the ray of pixel x of the row may be, along the ray
  /// and in world units, from the point where the ray meets the true face, if that is displaced
  /// continuously and nowhere by more than `displaced` (CurvedFace::moved_along). Returns infinity
  /// if the ray touches the face to within rounding.
  [[nodiscard]] double doubt(std::size_t face, double u, double v, int x, double displaced) const;

  /// Reference coordinates of a point of a face.
  [[nodiscard]] std::array<double, 3> reference(std::size_t face, double u, double v) const;

 private:
  static constexpr std::uint8_t kStraight = 255;

  [[nodiscard]] const CurvedFace& face_of(std::size_t number) const;

  void add_face(const Frame& frame, CellId cell, const CellSurface& surface, std::size_t number);
  void add_curves(const Frame& frame, CellId cell, const CellSurface& surface);
  void set_columns(CurvedFace& face, const TileRect& tile) const;

  template <typename Left>
  [[nodiscard]] int winding_of(const CurvedFace& face, int x, const Left& left) const {
    int winding = 0;
    for (std::size_t k = 0; k < face.shape.corner_count(); ++k) {
      const std::uint8_t e = face.edges[k];
      int sum = 0;
      if (curve_of_[e] == kStraight) {
        if (crossed_[e] && left(e)) sum = comes_up_[e] ? 1 : -1;
      } else {
        sum = curves_[curve_of_[e]].crossed_left_of(x);
      }
      // a border that winds counter-clockwise around the pixel comes down on its left
      winding += face.along[k] ? -sum : sum;
    }
    return winding;
  }

  const CellSurface& surface_;
  const Projector& projector_;
  double displaced_;  // how far faces may be off, world units; 0 if no errors are requested
  std::array<CurvedFace, kMostFaces> faces_;
  std::size_t count_ = 0;
  unsigned held_ = 0;
  std::array<CurvedEdge, 12> curves_;
  std::size_t curve_count_ = 0;
  std::array<std::uint8_t, CellSurface::kMostEdges> curve_of_;
  // of the current row
  double row_ = 0;  // y of the pixel centres
  std::array<bool, CellSurface::kMostEdges> crossed_, comes_up_;
  std::array<int, 2> columns_;
};

}  // namespace hiac

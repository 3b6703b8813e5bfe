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

namespace hiac {

/// The faces of one cell that are not planar, and the rays that cross them.
///
/// How often a face covers a pixel, with the side from which, is the number of times that its
/// projected border winds around the pixel's centre: its edges alone decide, each once for all
/// faces that have it, so that the surface of a cell and those of a whole mesh are closed. Where a
/// face is crossed, between its borders, is computed from its own nodes in an order that its two
/// cells share (patch_zeros): they find the same crossings, to the bit.
///
/// A straight edge is crossed by a row of pixel centres where the caller says so
/// (edge_crossings-inl.hpp). A curved one is a polynomial curve: its row's crossings are the places
/// where it changes sides, as many as bring it from its first corner's side to its last one's. All
/// of this is in homogeneous coordinates, and as good beside and behind the eye.
class CurvedFaces {
 public:
  static constexpr std::size_t kMostFaces = 6, kMostZeros = kMostFaces * PatchZeros::kMost;

  /// `surface`: of the cell.
  CurvedFaces(const Frame& frame, CellId cell, const CellSurface& surface);

  [[nodiscard]] bool holds(std::size_t face) const { return ((held_ >> face) & 1U) != 0; }
  [[nodiscard]] bool has_curved_edges() const { return curve_count_ > 0; }
  /// Of these faces alone.
  [[nodiscard]] ScreenBounds bounds() const;

  /// Turns to a row of pixel centres; `above`: the surface's corners on the row or above it.
  void begin_row(double center, const TileRect& tile, const bool* above);
  /// The columns of the row outside of which none of the faces covers pixels, but for those that
  /// straight edges bound.
  [[nodiscard]] std::array<int, 2> columns() const { return columns_; }

  /// Calls visit(t, face, u, v) for every crossing with the ray of pixel x of the row. Pixels of a
  /// row are taken from left to right. `left(e)`: whether the surface's edge e, a straight one that
  /// the row crosses, does so left of the pixel.
  template <typename Left, typename Visit>
  void at_pixel(int x, const Left& left, const Visit& visit) {
    for (std::size_t k = 0; k < count_; ++k) {
      Face& face = faces_[k];
      if (!face.in_row) continue;
      const int winding = winding_of(face, x, left);
      if (winding == 0 && (face.turns != 0 || x < face.first || x >= face.last)) continue;
      for (const PatchZero& zero : crossings(face, x, winding))
        visit(parameter(face, zero), face.number, zero.u, zero.v);
    }
  }

  /// Whether doubts may be asked for: where the frame wants errors.
  [[nodiscard]] bool with_doubts() const { return displaced_ > 0; }
  /// What rounding may have displaced faces by (RayDisplacement), in world units.
  [[nodiscard]] double displaced() const { return displaced_; }
  /// How far the point of a face where pixel x of the row is may be, along the ray, in world units,
  /// from where the ray meets the face, when that has been displaced, continuously and nowhere by
  /// more than `displaced`; what the point itself is off counts.
  ///
  /// That is a proof. With J the Jacobian of the distances (a, b) of the face from the ray in the
  /// point, J^-1 takes a box around the point, on which second derivatives in Bernstein form bound
  /// how far the map is from a linear one, into itself: by Brouwer's theorem the displaced face
  /// meets the ray in the box (the existence test of R. Krawczyk, 1969). Infinite where no box of
  /// twice the linear map's size will do: the ray touches the face to within rounding.
  [[nodiscard]] double doubt(std::size_t face, double u, double v, int x, double displaced) const;

  /// Reference coordinates of a point of a face.
  [[nodiscard]] std::array<double, 3> reference(std::size_t face, double u, double v) const;

 private:
  /// A place where an edge changes sides of a row. Left of pixels from `column` on, or before it.
  struct Cut {
    int column;
    bool from_column_on;
    int sign;  // +1: it comes up, as the edge runs from its lower corner to the other
  };

  struct Curve {
    std::uint8_t degree;
    std::array<double, 4> x, y, w;
    std::array<double, 4> height;  // above the row, of its control points
    std::array<Cut, 3> cuts;
    std::size_t cut_count;
  };

  struct Face {
    PatchShape shape;
    std::uint8_t number;                // of the cell
    std::array<std::uint8_t, 4> edges;  // of the surface, around the face
    std::array<bool, 4> along;          // whether an edge runs around the face as it is listed
    std::array<std::array<double, 3>, 4> reference;
    PatchNet<double> x, y, w, t, height;
    double rounding;  // of the coordinates
    int turns;        // patch_facing, or 0
    std::array<double, 2> guess;
    bool in_row;
    int first, last;  // columns
  };

  static constexpr std::uint8_t kStraight = 255;

  [[nodiscard]] const Face& face_of(std::size_t number) const;

  void add_face(const Frame& frame, CellId cell, const CellSurface& surface, std::size_t number);
  void add_curves(const Frame& frame, CellId cell, const CellSurface& surface);
  void cut_curve(Curve& curve, const TileRect& tile, bool begins_above, bool ends_above) const;
  void add_cut(Curve& curve, const TileRect& tile, double s, bool comes_up) const;
  [[nodiscard]] double slack_at(const Curve& curve, double s, double x) const;
  void set_columns(Face& face, const TileRect& tile) const;
  [[nodiscard]] PatchZeros crossings(Face& face, int x, int winding) const;
  [[nodiscard]] double parameter(const Face& face, const PatchZero& zero) const;

  template <typename Left>
  [[nodiscard]] int winding_of(const Face& face, int x, const Left& left) const {
    int winding = 0;
    for (std::size_t k = 0; k < face.shape.corner_count(); ++k) {
      const std::uint8_t e = face.edges[k];
      int sum = 0;
      if (curve_of_[e] == kStraight) {
        if (crossed_[e] && left(e)) sum = comes_up_[e] ? 1 : -1;
      } else {
        const Curve& curve = curves_[curve_of_[e]];
        for (std::size_t i = 0; i < curve.cut_count; ++i)
          if ((x >= curve.cuts[i].column) == curve.cuts[i].from_column_on)
            sum += curve.cuts[i].sign;
      }
      // on the left a border that winds around the pixel counter-clockwise comes down
      winding += face.along[k] ? -sum : sum;
    }
    return winding;
  }

  const CellSurface& surface_;
  const Projector& projector_;
  double displaced_;  // what faces may be moved by, in world units; 0 where no errors are asked for
  std::array<Face, kMostFaces> faces_;
  std::size_t count_ = 0;
  unsigned held_ = 0;
  std::array<Curve, 12> curves_;
  std::size_t curve_count_ = 0;
  std::array<std::uint8_t, CellSurface::kMostEdges> curve_of_;
  // of the row at hand
  double row_ = 0;  // y of the pixel centres
  std::array<bool, CellSurface::kMostEdges> crossed_, comes_up_;
  std::array<int, 2> columns_;
};

}  // namespace hiac

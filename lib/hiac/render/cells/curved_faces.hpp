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
/// (edge_crossings-inl.hpp). A curved edge is a polynomial curve: the row crosses it where it
/// changes sides, and the number of changes agrees with the sides of its two corners. All
/// computations are in homogeneous coordinates and equally valid beside and behind the eye.
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
      Face& face = faces_[k];
      if (!face.in_row) continue;
      const int winding = winding_of(face, x, left);
      if (winding == 0 && (face.turns != 0 || x < face.first || x >= face.last)) continue;
      for (const PatchZero& zero : crossings(face, x, winding))
        visit(parameter(face, zero), face.number, zero.u, zero.v);
    }
  }

  /// Whether `doubt` may be called: true if the frame requests errors.
  [[nodiscard]] bool with_doubts() const { return displaced_ > 0; }
  /// How far rounding may have displaced faces (RayDisplacement), in world units.
  [[nodiscard]] double displaced() const { return displaced_; }
  /// How far the computed crossing (u, v) of the ray of pixel x of the row may be, along the ray
  /// and in world units, from the point where the ray meets the true face, if that is displaced
  /// continuously and nowhere by more than `displaced`. The residual of the computed point is
  /// included.
  ///
  /// The bound is proven. Let J be the Jacobian, at the point, of the distances (a, b) of the face
  /// from the ray. Second derivatives in Bernstein form bound how far the map is from linear on a
  /// box around the point; if the Newton map with J^-1 takes the box into itself, then by Brouwer's
  /// theorem the displaced face meets the ray in the box (the existence test of R. Krawczyk, 1969).
  /// Returns infinity if a box of twice the linear map's size fails this test: then the ray touches
  /// the face to within rounding.
  [[nodiscard]] double doubt(std::size_t face, double u, double v, int x, double displaced) const;

  /// Reference coordinates of a point of a face.
  [[nodiscard]] std::array<double, 3> reference(std::size_t face, double u, double v) const;

 private:
  /// A point where an edge changes sides of a row. It lies left of the pixels from `column` on, or
  /// of those before `column`.
  struct Cut {
    int column;
    bool from_column_on;
    int sign;  // +1: the edge comes up, followed from its corner of lower number
  };

  struct Curve {
    std::uint8_t degree;
    std::array<double, 4> x, y, w;
    std::array<double, 4> height;  // of its control points above the row
    std::array<Cut, 3> cuts;
    std::size_t cut_count;
  };

  struct Face {
    PatchShape shape;
    std::uint8_t number;                // of the cell
    std::array<std::uint8_t, 4> edges;  // of the surface, around the face
    std::array<bool, 4> along;          // whether the edge's own direction agrees with the face's
    std::array<std::array<double, 3>, 4> reference;
    PatchNet<double> x, y, w, t, height;
    double rounding;  // that of the coordinates
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
      // a border that winds counter-clockwise around the pixel comes down on its left
      winding += face.along[k] ? -sum : sum;
    }
    return winding;
  }

  const CellSurface& surface_;
  const Projector& projector_;
  double displaced_;  // how far faces may be off, world units; 0 if no errors are requested
  std::array<Face, kMostFaces> faces_;
  std::size_t count_ = 0;
  unsigned held_ = 0;
  std::array<Curve, 12> curves_;
  std::size_t curve_count_ = 0;
  std::array<std::uint8_t, CellSurface::kMostEdges> curve_of_;
  // of the current row
  double row_ = 0;  // y of the pixel centres
  std::array<bool, CellSurface::kMostEdges> crossed_, comes_up_;
  std::array<int, 2> columns_;
};

}  // namespace hiac

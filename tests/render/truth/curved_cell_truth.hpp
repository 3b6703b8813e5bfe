#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac::test {

/// A cell with curved edges or faces that are not planar, met by rays, in extended precision (64
/// bits).
///
/// Faces are the images of those of the reference cell. Each is laid out in a grid of points; near
/// every square of it that a ray may pass, Newton's iteration looks for the crossing. Two crossings
/// of a face closer together than about a thousandth of it may be missed, both of them. Shares
/// nothing with the engine but the shape functions and the topology.
class CurvedCellTruth {
 public:
  using Real = long double;
  using Vec = std::array<Real, 3>;

  /// `nodes`: positions of the kind's nodes, in their order.
  CurvedCellTruth(CellKind kind, std::span<const Vec> nodes);

  struct Crossing {
    Real t;
    Vec reference;  ///< reference coordinates of the place
  };
  /// Where the line origin + t direction crosses the cell's surface, ascending; the line is inside
  /// between the first and the second, and so on. An odd number where a crossing was missed.
  [[nodiscard]] std::vector<Crossing> crossings(const Vec& origin, const Vec& direction) const;

 private:
  struct Face {
    std::size_t corner_count, squares;
    std::array<Vec, 4> corners;  // of the reference cell
    std::vector<Vec> grid;       // (squares + 1)^2 points
    Vec center{};
    Real reach = 0;  // of the points of the grid from there
  };
  struct Place {
    Vec reference, point, by_u, by_v;
  };
  [[nodiscard]] Place place(const Face& face, Real u, Real v) const;
  void add_crossings(const Face& face, const Vec& origin, const Vec& direction,
                     std::vector<Crossing>& found) const;

  CellKind kind_;
  std::vector<Vec> nodes_;
  std::vector<Face> faces_;
};

}  // namespace hiac::test

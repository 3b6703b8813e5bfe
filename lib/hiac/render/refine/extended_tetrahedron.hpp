#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hiac/frame/frame.hpp"

namespace hiac {

/// Numbers at a tetrahedron's corners, in the order of ExtendedTetrahedron::corners().
using CornerValues = std::array<long double, 4>;

/// A linear tetrahedron, intersected with one ray at a time in extended precision. The faces that
/// cover a pixel are those that the engine finds, by the same operations; the points where the ray
/// meets them are recomputed. Like the engine, this class intersects cells of the kernel on the
/// screen (tetrahedron_kernel.hpp), but with unrounded projected corners, and other cells in the
/// world (general_cells.hpp).
class ExtendedTetrahedron {
 public:
  ExtendedTetrahedron(const Frame& frame, CellId cell);

  /// The cell's corners by ascending node id, as indices into the cell's nodes.
  [[nodiscard]] const std::array<std::size_t, 4>& corners() const { return corner_; }

  /// The point where the ray of a pixel meets a face. Barycentric coordinates refer to the face on
  /// the screen, and to the cell in the world.
  struct Place {
    std::size_t face;  ///< the corner that it lacks, 0 to 3
    CornerValues weights;
    long double depth;  ///< ProjectedNode
    long double t;      ///< ray parameter
  };
  struct Crossing {
    Place front, back;
  };
  /// How often a pixel's ray meets the cell: never or once; `doubtful` stands for all other cases.
  enum class Met : std::uint8_t { no, once, doubtful };
  [[nodiscard]] Met cross(int x, int y, Crossing& crossing) const;

  /// The value at a point of a scalar that is linear in the cell. On the screen it is exactly 0 if
  /// the scalar is 0 at all corners of the face, and identical for both cells of a face.
  [[nodiscard]] long double at(const Place& place, const CornerValues& values) const;

 private:
  [[nodiscard]] bool covered(std::size_t lacking, int x, double center) const;
  [[nodiscard]] Place place_on(std::size_t lacking, int x, int y) const;
  [[nodiscard]] Met cross_in_world(int x, int y, Crossing& crossing) const;
  [[nodiscard]] bool place_in_world(std::uint8_t face, int x, int y, Place& place) const;

  const Frame& frame_;
  CellId cell_;
  bool perspective_, on_screen_;
  std::array<std::size_t, 4> corner_;
  std::array<ProjectedNode, 4> rounded_;
  std::array<std::array<long double, 3>, 4> exact_;  // x, y, depth; or camera coordinates
};

}  // namespace hiac

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hiac/frame/frame.hpp"

namespace hiac {

/// Numbers at a tetrahedron's corners, in the order of ExtendedTetrahedron::corners().
using CornerValues = std::array<long double, 4>;

/// A linear tetrahedron met by one ray at a time, in extended precision. Which faces cover a pixel
/// is what the engine says, by the same operations; where the ray meets them is found anew. As the
/// engine does, it meets the cells of its kernel over the screen (tetrahedron_kernel.hpp), but from
/// projected corners that are not rounded, and others in the world (general_cells.hpp).
class ExtendedTetrahedron {
 public:
  ExtendedTetrahedron(const Frame& frame, CellId cell);

  /// The cell's corners by ascending node id: places among the cell's nodes.
  [[nodiscard]] const std::array<std::size_t, 4>& corners() const { return corner_; }

  /// Where the ray of a pixel meets a face. Barycentric coordinates: over the screen those of the
  /// face, else those of the cell.
  struct Place {
    std::size_t face;  ///< the corner that it lacks, 0 to 3
    CornerValues weights;
    long double depth;  ///< ProjectedNode
    long double t;      ///< ray parameter
  };
  struct Crossing {
    Place front, back;
  };
  /// How a pixel's ray meets the cell: once, or not; `doubtful` is for what is neither.
  enum class Met : std::uint8_t { no, once, doubtful };
  [[nodiscard]] Met cross(int x, int y, Crossing& crossing) const;

  /// A scalar that is linear in the cell at a place. Over the screen it is exactly 0 where it is at
  /// all corners of the face, and the same for both cells of a face.
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

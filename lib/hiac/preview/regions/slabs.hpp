#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "hiac/preview/regions/polyhedron.hpp"

namespace hiac::preview {

/// Parallel planes in a tetrahedron: where a linear field takes some values.
struct PlaneFamily {
  std::array<double, 4> values;  ///< of the field at the tetrahedron's corners
  std::vector<double> levels;    ///< ascending, each once, all above the least of the values
};

/// What is seen of a sliced tetrahedron, one thing after the other.
struct SlabVisitor {
  /// A slab: part[f] of family f's levels lie below it.
  std::function<void(const Polyhedron& slab, std::span<const std::size_t> part)> slab;
  /// The polygon (vertices of `owner`) in level `level` of family `family`.
  std::function<void(const Polyhedron& owner, std::span<const std::uint16_t> polygon,
                     std::size_t family, std::size_t level)>
      polygon;
};

/// Slices tetrahedra into the slabs between planes (Williams, Max, Stein 1998, section 5.1, Fig. 3)
/// of several fields and visits slabs and polygons back to front: those on one side of the eye slab
/// away from its end, then those on the other, the eye slab last.
class Slicer {
 public:
  /// `whole`: of a tetrahedron, cut or not, in camera coordinates. A level that is the largest of
  /// its family's values has a polygon where the whole of a face has the value.
  void visit(const Polyhedron& whole, std::span<const std::array<double, 3>, 4> camera,
             bool perspective, std::span<const PlaneFamily> families, const SlabVisitor& visitor);
  /// Polyhedra that were not cut because of rounding (PolyhedronCutter).
  [[nodiscard]] std::uint64_t uncut() const { return uncut_; }

 private:
  // the slabs of one family, in a polyhedron that others have cut
  struct Stage {
    std::vector<Polyhedron> parts;
    std::vector<std::vector<double>> values;
    std::vector<std::vector<std::uint16_t>> polygons;
    Polyhedron rest, above;
    std::size_t eye_part;
  };

  void visit_family(const Polyhedron& whole, std::size_t family);
  void cut(const Polyhedron& whole, const PlaneFamily& family, Stage& stage);
  void visit_part(const Stage& stage, std::size_t family, std::size_t part);
  void visit_polygon(const Stage& stage, std::size_t family, std::size_t level);

  PolyhedronCutter cutter_;
  std::vector<std::unique_ptr<Stage>> stages_;
  std::vector<std::size_t> part_;
  std::span<const PlaneFamily> families_;
  const SlabVisitor* visitor_ = nullptr;
  std::uint64_t uncut_ = 0;
};

/// The gradient of a linear field with these values at a tetrahedron's corners, and its value at
/// the origin of coordinates. Zero for a tetrahedron without volume.
struct LinearField {
  std::array<double, 3> gradient;
  double at_origin;
};
LinearField linear_field(std::span<const std::array<double, 3>, 4> corners,
                         const std::array<double, 4>& values);

}  // namespace hiac::preview

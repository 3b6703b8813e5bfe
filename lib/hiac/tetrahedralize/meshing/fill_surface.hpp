#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/tetrahedralize/meshing/surface_meshing.hpp"
#include "hiac/tetrahedralize/surface.hpp"

namespace hiac {

/// Which parts of the space that a surface encloses stay empty, besides those with its own holes.
struct EmptyParts {
  /// Those around which the surface winds no time (winding_number), as around the cavity between a
  /// shell that is oriented outwards and one inside it that is oriented inwards. Holds for surfaces
  /// of triangles without opposed edges (surface_orientation); others are filled.
  bool by_orientation = false;
  std::vector<std::array<double, 3>> around;  ///< the parts around these points
};

/// A part of the space that a surface encloses, and what has become of it.
struct FilledPart {
  std::array<double, 3> point{};  ///< inside it
  double volume = 0;              ///< world units cubed
  std::optional<int> winding;     ///< winding_number; none if the triangles do not agree on it
  std::optional<int> region;      ///< its number in the field "region"; none: it stays empty
};

struct FilledSurface {
  ZooMesh mesh;
  /// In the order of number_parts, the empty ones included. None if the surface has regions of its
  /// own, whose attributes name its parts.
  std::vector<FilledPart> parts;
};

/// Fills a surface with tetrahedra (mesh_surface), but for the parts that are to stay empty. The
/// parts that are filled are numbered from 1 in the field "region", in the order of number_parts.
/// Throws what mesh_surface throws; UsageError "hole ..." if one of the points is in no part or on
/// the surface; and JudgementError if all parts are to stay empty.
FilledSurface fill_surface(const Surface& surface, const SurfaceMeshing& how,
                           const EmptyParts& empty);

}  // namespace hiac

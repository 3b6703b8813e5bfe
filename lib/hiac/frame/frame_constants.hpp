#pragma once

#include <limits>

#include "hiac/frame/frame.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// What the constants of a frame depend on in a mesh. Those of a whole mesh are joined from those
/// of its parts, to the bit.
struct MeshExtremes {
  /// Ray parameters of the nearest and the farthest node; of no node: infinite, inverted.
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -std::numeric_limits<double>::infinity();
  double largest_color = 0, largest_extinction = 0;  ///< magnitudes of the fields' values

  void add(const MeshExtremes& other);
  /// The extent in the ray parameter.
  [[nodiscard]] double depth() const { return nearest <= farthest ? farthest - nearest : 0; }
};

/// The extremes of the frame's own mesh. The frame's fields have their values.
MeshExtremes extremes_of(const Frame& frame);

/// Sets what a frame derives from its scene and from these extremes, those of its own mesh or of
/// the mesh that its own is a part of: the optics and the fields' intervals in them, `depth`,
/// `witness_tolerance`, `largest_light` and `least_transparency`.
void set_constants(Frame& frame, const Scene& scene, const MeshExtremes& extremes);

}  // namespace hiac

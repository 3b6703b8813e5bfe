#pragma once

#include "hiac/frame/projection.hpp"
#include "hiac/geometry/extended_vector.hpp"

namespace hiac {

/// A pixel's ray in extended precision, camera frame: origin + t direction, with the usual ray
/// parameter t.
struct ExtendedRay {
  ExtendedVector origin, direction;
  long double scale;  ///< world length per unit of t

  ExtendedRay(const Projector& projector, int x, int y);
  [[nodiscard]] ExtendedVector at(long double t) const;
  /// The direction, of length 1.
  [[nodiscard]] ExtendedVector along() const;
};

}  // namespace hiac

#pragma once

#include <span>

namespace hiac {

/// Returns the signs of predicates.hpp without a filter: the slow path, exact for all finite input.
int exact_orientation(std::span<const double, 3> a, std::span<const double, 3> b,
                      std::span<const double, 3> c, std::span<const double, 3> d);
int exact_orientation_towards(std::span<const double, 3> a, std::span<const double, 3> b,
                              std::span<const double, 3> c, std::span<const double, 3> v);

}  // namespace hiac

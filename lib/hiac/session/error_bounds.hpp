#pragma once

#include <optional>

#include "hiac/image/image.hpp"

namespace hiac {

/// The largest bound of error of a picture's pixels; none if it has no channel "error"
/// (reason_unbounded says of which scenes) or if the bound of some pixel is not known.
std::optional<double> largest_error_bound(const Image& picture);

}  // namespace hiac

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hiac/image/image.hpp"

namespace hiac::view {

/// The smallest and the largest finite value of a channel; none if it has none.
std::optional<std::array<double, 2>> finite_range(const Image& image, std::size_t channel);

/// A channel in grey, three bytes a pixel: from black at `range[0]` to white at `range[1]`, even in
/// the value or, with `logarithmic`, in its logarithm (both ends are positive then). What is not a
/// finite number is red, and so is, on a logarithmic scale, what is not positive.
std::vector<std::uint8_t> channel_bytes(const Image& image, std::size_t channel,
                                        const std::array<double, 2>& range, bool logarithmic);

}  // namespace hiac::view

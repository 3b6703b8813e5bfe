#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/cluster/communicator.hpp"

namespace hiac {

/// The largest number that any process gives.
std::uint64_t most_of_all(Communicator& all, std::uint64_t own);

/// The sums of what all processes give, number by number.
std::vector<std::uint64_t> sum_of_all(Communicator& all, std::span<const std::uint64_t> own);

}  // namespace hiac

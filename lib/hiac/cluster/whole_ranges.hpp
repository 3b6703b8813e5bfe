#pragma once

#include <span>

#include "hiac/cluster/communicator.hpp"
#include "hiac/cluster/part_boundary.hpp"
#include "hiac/scene/specification.hpp"

namespace hiac {

/// A specification with its transfer functions over the ranges that it leaves to the fields' values
/// ("auto", percentiles), those of the whole mesh: the same, to the bit, that with_field_ranges
/// (session.hpp) finds in it. All processes call it, with the same specification. No process holds
/// more than its own parts' values. Throws as with_field_ranges does.
ParsedScene with_whole_ranges(Communicator& all, std::span<const NumberedPart> own,
                              ParsedScene parsed);

}  // namespace hiac

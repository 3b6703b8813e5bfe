#pragma once

#include <string>
#include <vector>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Gives every piece with cells all fields that any piece with cells has, in one order: NaN where
/// the piece lacks a field, which a note of the first piece tells. Throws InputError(subject, ...)
/// where a field has other components in another piece.
void complete_fields(std::vector<Reading>& pieces, const std::string& subject);

}  // namespace hiac::formats

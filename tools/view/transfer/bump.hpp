#pragma once

#include <array>
#include <string>

#include "tools/view/document/document.hpp"

namespace hiac::view {

/// Adds a peak of the extinction where its field has a value (transfer_text.hpp: with_bump), as
/// wide as a fortieth of the field's values. A view that does not absorb yet absorbs there alone,
/// by its colour's field. Tells why if there is no mesh or no field. One edit.
void add_bump(Document& document, double value);

/// The smallest and the largest value of a scalar field of the document's mesh; {0, 0} if it has
/// none. Throws UsageError for a field that does not exist.
std::array<double, 2> field_extent(const Document& document, const std::string& field);

}  // namespace hiac::view

#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace hiac::formats {

/// The steps at which every field has values, by the field's name. Solvers write some fields at
/// some steps only.
using FieldSteps = std::map<std::string, std::set<std::size_t>>;

/// Adds a note for every field that has no values at `step`, with the steps at which it has some.
void note_absent_fields(const FieldSteps& fields, std::span<const double> times, std::size_t step,
                        std::vector<std::string>& notes);

/// For a listing: adds a note for every field that has values at some of the steps only.
void note_partial_fields(const FieldSteps& fields, std::size_t steps,
                         std::vector<std::string>& notes);

}  // namespace hiac::formats

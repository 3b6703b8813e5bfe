#pragma once

#include <string>

#include "formats/common/mesh/format.hpp"
#include "formats/common/mesh/used_points.hpp"

namespace hiac::formats {

/// The checks that every mesh from a foreign file passes: coordinates are finite, edge nodes lie
/// near their edges (a wrong node order gets an error that says so), and the mesh's invariants
/// hold, so that every index is in range. `used` maps the nodes to the file's points. Throws
/// InputError(subject, ...).
void pass_gate(Reading& reading, const UsedPoints& used, const std::string& subject);

/// Throws InputError(subject, ...), with the notes on what was left out, when there are no cells;
/// otherwise adds the file's name to the metadata.
void finish_reading(Reading& reading, const std::string& subject);

}  // namespace hiac::formats

#pragma once

#include <compare>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "formats/cgns/cgns_file.hpp"
#include "formats/cgns/zone.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats::cgns {

/// The step of fields that belong to no step.
inline constexpr std::size_t kAlways = std::numeric_limits<std::size_t>::max();

struct FieldKey {
  std::string name;
  FieldLocation location;
  std::size_t components;
  std::size_t step;
  auto operator<=>(const FieldKey&) const = default;
};

/// Fields by what tells them apart, each with its part in every zone; a part without arrays: the
/// zone does not have the field.
using FieldParts = std::map<FieldKey, std::vector<FieldPart>>;

/// Adds the solutions of zone `z` of `zones` to `fields`. A solution that lies neither on points
/// nor in cells is left out, with a note; if the zone's pointers name solutions for the file's
/// `step_count` steps, so is one that they do not name.
void add_solutions(const CgnsFile& file, const std::vector<Zone>& zones, std::size_t z,
                   std::size_t step_count, FieldParts& fields, std::vector<std::string>& notes);

}  // namespace hiac::formats::cgns

#include "hiac/mesh/fields/find_field.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/fields/location_name.hpp"

namespace hiac {
namespace {

/// A field's name with its location: what tells fields of one name apart.
std::string located_name(const Field& field) {
  return fmt::format("{}@{}", field.name, location_name(field.location));
}

}  // namespace

const Field* find_field(const ZooMesh& mesh, std::string_view name) {
  const Field* found = nullptr;
  for (const Field& field : mesh.fields) {
    if (field.name != name && located_name(field) != name) continue;
    if (found != nullptr)
      throw UsageError(
          fmt::format("field '{}': the name is ambiguous (one field expected, {} and "
                      "{} found)",
                      name, located_name(*found), located_name(field)));
    found = &field;
  }
  return found;
}

std::string distinct_name(const ZooMesh& mesh, const Field& field) {
  const auto same_name = [&](const Field& other) { return other.name == field.name; };
  return std::ranges::count_if(mesh.fields, same_name) > 1 ? located_name(field) : field.name;
}

}  // namespace hiac

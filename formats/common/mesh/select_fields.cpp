#include "formats/common/mesh/select_fields.hpp"

#include <array>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

constexpr std::array<std::pair<std::string_view, FieldLocation>, 3> kLocations{
    {{"node/", FieldLocation::node},
     {"cell/", FieldLocation::cell},
     {"corner/", FieldLocation::corner}}};

/// The fields with that name, at the location that a prefix of the name gives.
std::vector<Field> fields_named(const ZooMesh& mesh, const std::string& name) {
  std::vector<Field> found;
  for (const Field& field : mesh.fields)
    if (field.name == name) found.push_back(field);
  if (!found.empty()) return found;
  for (const auto& [prefix, location] : kLocations) {
    if (!name.starts_with(prefix)) continue;
    for (const Field& field : mesh.fields)
      if (field.location == location && field.name == name.substr(prefix.size()))
        found.push_back(field);
  }
  return found;
}

/// The scalar that `reference` names, a component or a magnitude, if it names one.
std::optional<Field> scalar_named(const ZooMesh& mesh, const std::string& reference) {
  const std::size_t colon = reference.rfind(':');
  if (colon == std::string::npos) return std::nullopt;
  ZooMesh one;
  one.fields = fields_named(mesh, reference.substr(0, colon));
  if (one.fields.size() != 1) return std::nullopt;
  try {
    return scalar_field(one, one.fields.front().name + reference.substr(colon));
  } catch (const UsageError&) {
    return std::nullopt;  // no such component: perhaps NAME=NEW, else refused by the caller
  }
}

/// The fields that a request without a new name selects; empty when there are none.
std::vector<Field> fields_for(const ZooMesh& mesh, const std::string& name) {
  std::vector<Field> found = fields_named(mesh, name);
  if (!found.empty()) return found;
  if (auto scalar = scalar_named(mesh, name)) found.push_back(std::move(*scalar));
  return found;
}

[[noreturn]] void refuse(const ZooMesh& mesh, const std::string& option) {
  std::vector<std::string> names;
  for (const Field& field : mesh.fields) names.push_back(field.name);
  throw UsageError(names.empty()
                       ? fmt::format("{}: there is no such field (the mesh has none)", option)
                       : fmt::format("{}: there is no such field (expected one of {}, or a "
                                     "component NAME:x or NAME:magnitude)",
                                     option, fmt::join(names, ", ")));
}

std::vector<Field> requested(const ZooMesh& mesh, const std::string& request) {
  // a whole name first: names may hold '='
  std::vector<Field> found = fields_for(mesh, request);
  if (!found.empty()) return found;
  const std::size_t equals = request.rfind('=');
  const std::string option = fmt::format("field {}", request);
  if (equals == std::string::npos) refuse(mesh, option);
  found = fields_for(mesh, request.substr(0, equals));
  if (found.empty()) refuse(mesh, option);
  if (found.size() > 1)
    throw UsageError(
        fmt::format("{}: several fields have that name (node/NAME, cell/NAME or "
                    "corner/NAME expected)",
                    option));
  found.front().name = request.substr(equals + 1);
  if (found.front().name.empty()) throw UsageError(option + ": the new name is empty");
  return found;
}

}  // namespace

std::vector<Field> select_fields(const ZooMesh& mesh, std::span<const std::string> requests) {
  std::vector<Field> fields;
  if (requests.empty()) fields = mesh.fields;
  for (const std::string& request : requests)
    for (Field& field : requested(mesh, request)) fields.push_back(std::move(field));
  return fields;
}

}  // namespace hiac::formats

#include "formats/common/pieces/complete_fields.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

Field not_known(const Field& wanted, const ZooMesh& mesh) {
  Field field = wanted;
  std::size_t tuples = mesh.nodes.size();
  if (wanted.location == FieldLocation::node) tuples = mesh.node_count();
  if (wanted.location == FieldLocation::cell) tuples = mesh.cell_count();
  field.values =
      std::vector<double>(tuples * wanted.components, std::numeric_limits<double>::quiet_NaN());
  return field;
}

}  // namespace

void complete_fields(std::vector<Reading>& pieces, const std::string& subject) {
  std::vector<Field> all;
  const auto is = [](const Field& a) {
    return [&a](const Field& b) { return a.name == b.name && a.location == b.location; };
  };
  for (Reading& piece : pieces) {
    if (piece.mesh.cell_count() == 0) piece.mesh.fields.clear();
    for (const Field& field : piece.mesh.fields) {
      const auto known = std::find_if(all.begin(), all.end(), is(field));
      if (known == all.end())
        all.push_back({field.name, field.unit, field.location, field.components, {}});
      else if (known->components != field.components)
        throw InputError(subject, fmt::format("field '{}' has {} components in one block and {} "
                                              "in another",
                                              field.name, known->components, field.components));
    }
  }
  std::map<std::string, std::size_t> missing;
  for (Reading& piece : pieces) {
    if (piece.mesh.cell_count() == 0) continue;
    std::vector<Field> fields;
    for (const Field& wanted : all) {
      const auto found =
          std::find_if(piece.mesh.fields.begin(), piece.mesh.fields.end(), is(wanted));
      fields.push_back(found != piece.mesh.fields.end() ? *found : not_known(wanted, piece.mesh));
      if (found == piece.mesh.fields.end()) ++missing[wanted.name];
    }
    piece.mesh.fields = std::move(fields);
  }
  for (const auto& [name, count] : missing)
    pieces.front().notes.push_back(
        fmt::format("field '{}' is missing in {} files: NaN there", name, count));
}

}  // namespace hiac::formats

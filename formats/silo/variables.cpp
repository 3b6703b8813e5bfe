#include "formats/silo/variables.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/special_values.hpp"

namespace hiac::formats::silo {
namespace {

/// A variable of a block, on either kind of mesh.
struct Values {
  bool on_nodes = false;
  std::size_t tuples = 0;
  std::vector<std::vector<double>> components;
  std::string unit;
};

Values values_of(SiloFiles& files, const Block& block, const Place& place) {
  DBfile* file = files.open(place.file);
  const std::string subject = fmt::format("{}: variable '{}'", place.file, place.name);
  Values values;
  const auto take = [&](void** stored, int count, int type, int tuples, const char* unit) {
    values.tuples = static_cast<std::size_t>(std::max(tuples, 0));
    if (unit != nullptr) values.unit = unit;
    for (int c = 0; c < count; ++c)
      values.components.push_back(numbers(stored[c], type, values.tuples, subject));
  };
  if (block.structured) {
    const Owned<DBquadvar> variable(DBGetQuadvar(file, place.name.c_str()));
    if (!variable) throw InputError(subject, "cannot be read");
    take(variable->vals, variable->nvals, variable->datatype, variable->nels, variable->units);
    values.on_nodes = values.tuples == block.points && variable->align[0] == 0;
  } else {
    const Owned<DBucdvar> variable(DBGetUcdvar(file, place.name.c_str()));
    if (!variable) throw InputError(subject, "cannot be read");
    take(variable->vals, variable->nvals, variable->datatype, variable->nels, variable->units);
    values.on_nodes = variable->centering == DB_NODECENT;
  }
  if (values.tuples != (values.on_nodes ? block.points : block.cells))
    throw InputError(subject,
                     fmt::format("does not fit its mesh ({} values expected, {} found)",
                                 values.on_nodes ? block.points : block.cells, values.tuples));
  return values;
}

}  // namespace

std::optional<Variable> multi_block_variable(SiloFiles& files, const std::string& name,
                                             std::size_t blocks, std::vector<std::string>& notes) {
  const Owned<DBmultivar> multi(DBGetMultivar(files.open(files.path()), name.c_str()));
  if (!multi || multi->varnames == nullptr) {
    notes.push_back(fmt::format("left out the variable '{}', whose blocks are not named", name));
    return std::nullopt;
  }
  Variable variable{name, {}};
  std::size_t block = 0;
  for (int b = 0; b < multi->nvars; ++b) {
    const std::string part = multi->varnames[b] == nullptr ? "" : multi->varnames[b];
    if (part.empty() || part == "EMPTY") continue;
    if (block < blocks) variable.parts.emplace_back(block++, files.place_of(part));
  }
  return variable;
}

std::string mesh_of_variable(SiloFiles& files, const std::string& name) {
  DBfile* file = files.open(files.path());
  const bool structured = DBInqVarType(file, name.c_str()) == DB_QUADVAR;
  std::string mesh;
  if (structured) {
    const Owned<DBquadvar> variable(DBGetQuadvar(file, name.c_str()));
    if (variable && variable->meshname != nullptr) mesh = variable->meshname;
  } else {
    const Owned<DBucdvar> variable(DBGetUcdvar(file, name.c_str()));
    if (variable && variable->meshname != nullptr) mesh = variable->meshname;
  }
  return mesh;
}

ForeignField field_of(const std::shared_ptr<SiloFiles>& files,
                      const std::shared_ptr<const std::vector<Block>>& blocks,
                      const Variable& variable, const ForeignMesh& mesh) {
  const auto& [block, place] = variable.parts.front();
  const Values first = values_of(*files, (*blocks)[block], place);
  ForeignField field;
  field.name = variable.name;
  field.unit = first.unit;
  field.location = first.on_nodes ? FieldLocation::node : FieldLocation::cell;
  field.components = static_cast<std::uint32_t>(first.components.size());
  const std::size_t tuples = first.on_nodes ? mesh.point_count() : mesh.cell_count();
  field.values = [files, blocks, parts = variable.parts, tuples, on_nodes = first.on_nodes,
                  width = first.components.size()] {
    std::vector<double> all(tuples * width, kNaN);
    for (const auto& [b, where] : parts) {
      const Block& own = (*blocks)[b];
      const Values values = values_of(*files, own, where);
      if (values.components.size() != width || values.on_nodes != on_nodes)
        throw InputError(
            where.file,
            fmt::format("variable '{}' is of another kind than in other blocks", where.name));
      const std::size_t begin = on_nodes ? own.first_point : own.first_cell;
      for (std::size_t t = 0; t < values.tuples; ++t)
        for (std::size_t c = 0; c < width; ++c)
          all[(begin + t) * width + c] = values.components[c][t];
    }
    return all;
  };
  return field;
}

}  // namespace hiac::formats::silo

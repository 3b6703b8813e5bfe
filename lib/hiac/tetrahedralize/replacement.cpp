#include "hiac/tetrahedralize/replacement.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "hiac/base/error.hpp"
#include "hiac/mesh/parts/chosen_tuples.hpp"
#include "hiac/mesh/parts/used_nodes.hpp"

namespace hiac {

Replacement::Replacement(const ZooMesh& mesh)
    : mesh_(mesh), has_corner_fields_(std::ranges::any_of(mesh.fields, [](const Field& field) {
        return field.location == FieldLocation::corner;
      })) {}

NodeId Replacement::make_node(const CellPlace& place) {
  const std::size_t number = mesh_.node_count() + made_.size();
  if (number >= std::numeric_limits<NodeId>::max())
    throw InputError("mesh", "its cells need too many nodes (at most 2^32 - 1 expected)");
  made_.push_back(place);
  return static_cast<NodeId>(number);
}

void Replacement::finish_cell(CellId parent, CellKind kind) {
  if (parents_.size() == kNoCell)
    throw InputError("mesh", "its cells make too many tetrahedra (at most 2^32 - 1 expected)");
  parents_.push_back(parent);
  kinds_.push_back(kind);
  elems_.push_back(nodes_.size());
}

ZooMesh Replacement::finish() {
  const std::vector<NodeId> used = renumber_used_nodes(nodes_, mesh_.node_count() + made_.size());
  ZooMesh mesh;
  mesh.xyz = at_nodes({mesh_.xyz.view(), 3, FieldLocation::node}, used);
  for (const Field& field : mesh_.fields)
    mesh.fields.push_back(
        {field.name, field.unit, field.location, field.components, values_of(field, used)});
  mesh.metadata = mesh_.metadata;
  mesh.kinds = std::move(kinds_);
  mesh.elems = std::move(elems_);
  mesh.nodes = std::move(nodes_);
  return mesh;
}

SharedArray<double> Replacement::values_of(const Field& field,
                                           const std::vector<NodeId>& used) const {
  if (field.location == FieldLocation::cell)
    return chosen_tuples(field.values.view(), field.components, parents_);
  const NodeValues values{field.values.view(), field.components, field.location};
  return field.location == FieldLocation::node ? at_nodes(values, used) : at_corners(values);
}

SharedArray<double> Replacement::at_nodes(const NodeValues& values,
                                          const std::vector<NodeId>& used) const {
  // the nodes made come last
  const auto own = static_cast<std::size_t>(
      std::ranges::lower_bound(used, static_cast<std::uint64_t>(mesh_.node_count())) -
      used.begin());
  std::vector<double> result =
      chosen_tuples(values.values, values.width, std::span(used).first(own));
  result.resize(used.size() * values.width);
  for (std::size_t i = own; i < used.size(); ++i)
    evaluate(mesh_, values, made_[used[i] - mesh_.node_count()],
             std::span(result).subspan(i * values.width, values.width));
  return result;
}

SharedArray<double> Replacement::at_corners(const NodeValues& values) const {
  std::vector<double> result(corner_places_.size() * values.width);
  for (std::size_t i = 0; i < corner_places_.size(); ++i)
    evaluate(mesh_, values, corner_places_[i],
             std::span(result).subspan(i * values.width, values.width));
  return result;
}

}  // namespace hiac

#include "formats/common/mesh/mesh_rewrite.hpp"

#include <algorithm>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

/// How the values of fields are transformed.
struct Change {
  std::vector<Weights> made;
  std::vector<std::size_t> parents;
  std::vector<std::size_t> entry_ends;
  Weights entry_weights;
};

void add_mean(std::span<const std::pair<std::size_t, double>> weights, std::size_t width,
              const std::vector<double>& values, std::vector<double>& to) {
  if (weights.empty()) to.insert(to.end(), width, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < width && !weights.empty(); ++c) {
    // a single value stays as it is, a negative zero too
    if (weights.size() == 1) {
      to.push_back(values[weights.front().first * width + c]);
      continue;
    }
    double sum = 0;
    for (const auto& [place, weight] : weights) sum += weight * values[place * width + c];
    to.push_back(sum);
  }
}

std::vector<double> changed(const Change& change, FieldLocation location, std::size_t width,
                            std::vector<double>&& values) {
  if (location == FieldLocation::node) {
    for (const Weights& weights : change.made) add_mean(weights, width, values, values);
    return std::move(values);
  }
  std::vector<double> result;
  if (location == FieldLocation::cell) {
    result.reserve(change.parents.size() * width);
    for (const std::size_t parent : change.parents)
      for (std::size_t c = 0; c < width; ++c) result.push_back(values[parent * width + c]);
    return result;
  }
  std::size_t begin = 0;
  for (const std::size_t end : change.entry_ends) {
    add_mean(std::span(change.entry_weights).subspan(begin, end - begin), width, values, result);
    begin = end;
  }
  return result;
}

}  // namespace

MeshRewrite::MeshRewrite(ForeignMesh& mesh, std::string subject)
    : mesh_(mesh), subject_(std::move(subject)), index_(mesh.node_numbers) {
  starts_.reserve(mesh.cell_count() + 1);
  for (const std::uint16_t type : mesh.cell_types)
    starts_.push_back(starts_.back() + mesh.types[type].nodes);
  first_made_ = mesh.first_node + static_cast<std::int64_t>(mesh.point_count());
  for (const std::int64_t number : mesh.node_numbers)
    first_made_ = std::max(first_made_, number + 1);
  any_corner_field_ = std::any_of(
      mesh.fields.begin(), mesh.fields.end(),
      [](const ForeignField& field) { return field.location == FieldLocation::corner; });
}

std::span<const std::int64_t> MeshRewrite::nodes_of(std::size_t cell) const {
  return std::span(mesh_.cell_nodes).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
}

std::size_t MeshRewrite::place_of(std::int64_t number, std::size_t cell) const {
  std::size_t place = NumberIndex::kNone;
  if (!mesh_.node_numbers.empty()) {
    place = index_.find(number);
  } else if (number >= mesh_.first_node) {
    const auto at =
        static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(mesh_.first_node);
    if (at < mesh_.point_count()) place = at;
  }
  if (place == NumberIndex::kNone)
    throw InputError(subject_, fmt::format("cell {} {}: there is no node {}",
                                           mesh_.types[mesh_.cell_types[cell]].name, cell, number));
  return place;
}

std::int64_t MeshRewrite::point(Weights places, std::size_t anchor) {
  std::sort(places.begin(), places.end());
  std::vector<std::size_t> key{anchor};
  for (const auto& [place, weight] : places) key.push_back(place);
  const auto [known, fresh] = known_.try_emplace(std::move(key), made_.size());
  if (fresh) made_.push_back(std::move(places));
  return first_made_ + static_cast<std::int64_t>(known->second);
}

void MeshRewrite::keep() {
  const std::size_t cell = next_;
  replace();
  types_.push_back(mesh_.cell_types[cell]);
  const auto nodes = nodes_of(cell);
  nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
  parents_.push_back(cell);
  for (std::size_t e = starts_[cell]; any_corner_field_ && e < starts_[cell + 1]; ++e) {
    entry_weights_.emplace_back(e, 1.0);
    entry_ends_.push_back(entry_weights_.size());
  }
  const ForeignPolyhedra& old = mesh_.polyhedra;
  if (next_polyhedron_ == 0 || old.cells[next_polyhedron_ - 1] != cell) return;
  const std::size_t p = next_polyhedron_ - 1;
  polyhedra_.cells.push_back(types_.size() - 1);
  polyhedra_.faces.insert(
      polyhedra_.faces.end(),
      old.faces.begin() + static_cast<std::ptrdiff_t>(p == 0 ? 0 : old.ends[p - 1]),
      old.faces.begin() + static_cast<std::ptrdiff_t>(old.ends[p]));
  polyhedra_.ends.push_back(polyhedra_.faces.size());
}

void MeshRewrite::replace() {
  const ForeignPolyhedra& old = mesh_.polyhedra;
  if (next_polyhedron_ < old.cells.size() && old.cells[next_polyhedron_] == next_)
    ++next_polyhedron_;
  firsts_.push_back(types_.size());
  ++next_;
}

void MeshRewrite::add(std::uint16_t type, std::span<const std::int64_t> nodes,
                      std::span<const Weights> entries) {
  types_.push_back(type);
  nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
  parents_.push_back(next_ - 1);
  for (std::size_t n = 0; any_corner_field_ && n < nodes.size(); ++n) {
    if (!entries.empty())
      for (const auto& [place, weight] : entries[n])
        entry_weights_.emplace_back(starts_[next_ - 1] + place, weight);
    entry_ends_.push_back(entry_weights_.size());
  }
}

void MeshRewrite::extend_points() {
  const std::size_t points = mesh_.point_count();
  for (const Weights& weights : made_) add_mean(weights, 3, mesh_.xyz, mesh_.xyz);
  if (mesh_.node_numbers.empty() &&
      first_made_ == mesh_.first_node + static_cast<std::int64_t>(points))
    return;
  for (std::size_t i = 0; i < made_.size(); ++i)
    mesh_.node_numbers.push_back(first_made_ + static_cast<std::int64_t>(i));
}

void MeshRewrite::rewrite_fields() {
  const auto change = std::make_shared<const Change>(Change{
      std::move(made_), std::move(parents_), std::move(entry_ends_), std::move(entry_weights_)});
  const std::size_t points = mesh_.point_count() - change->made.size();
  const std::size_t cells = starts_.size() - 1;
  const std::size_t entries = starts_.back();
  for (ForeignField& field : mesh_.fields) {
    const std::size_t tuples = field.location == FieldLocation::node   ? points
                               : field.location == FieldLocation::cell ? cells
                                                                       : entries;
    field.values = [change, tuples, old = std::move(field.values), location = field.location,
                    width = std::size_t{field.components}] {
      std::vector<double> values = old();
      // the receiver of the values refuses what does not fit
      if (values.size() != tuples * width) return values;
      return changed(*change, location, width, std::move(values));
    };
  }
}

void MeshRewrite::finish() {
  firsts_.push_back(types_.size());
  for (ForeignBlock& block : mesh_.blocks)
    for (IndexRange& range : block.cells) range = {firsts_[range.begin], firsts_[range.end]};
  if (!mesh_.cell_numbers.empty()) {
    std::vector<std::int64_t> numbers;
    for (const std::size_t parent : parents_) numbers.push_back(mesh_.cell_numbers[parent]);
    mesh_.cell_numbers = std::move(numbers);
  }
  mesh_.cell_types = std::move(types_);
  mesh_.cell_nodes = std::move(nodes_);
  mesh_.polyhedra = std::move(polyhedra_);
  extend_points();
  rewrite_fields();
}

}  // namespace hiac::formats

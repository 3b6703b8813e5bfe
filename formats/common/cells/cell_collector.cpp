#include "formats/common/cells/cell_collector.hpp"

#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/common/io/large_reserve.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

std::string with_nodes(const std::string& name, std::size_t nodes) {
  return nodes == 0 ? name : fmt::format("{} of {} nodes", name, nodes);
}

std::string joined(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::string> parts;
  for (const auto& [name, count] : counts) parts.push_back(fmt::format("{} {}", count, name));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

CellCollector::CellCollector(const ReadOptions& options, std::string subject, TypeName type_name)
    : options_(options), subject_(std::move(subject)), type_name_(std::move(type_name)) {
  result_.elems.push_back(0);
}

void CellCollector::reserve(std::size_t cells, std::size_t entries) {
  result_.kinds.reserve(cells);
  reserve_large(result_.elems, cells + 1);
  reserve_large(result_.nodes, entries);
}

void CellCollector::add(std::size_t index, int type, std::span<const NodeId> nodes,
                        const CellConversion& conversion) {
  switch (conversion.fate) {
    case CellFate::converted:
      if (conversion.further_nodes) ++extra_nodes_[{type, nodes.size()}];
      convert(index, type, nodes, conversion.kind, conversion.permutation);
      return;
    case CellFate::no_volume:
      ++surfaces_[{type, 0}];
      return;
    case CellFate::wrong:
      throw InputError(subject_, fmt::format("cell {}: a {} cannot have {} nodes", index,
                                             type_name_(type), nodes.size()));
    case CellFate::unsupported:
      break;
  }
  if (options_.corners_of_unsupported && conversion.corners) {
    ++reduced_[{type, nodes.size()}];
    convert(index, type, nodes, *conversion.corners, conversion.permutation);
    return;
  }
  ++unsupported_[{type, nodes.size()}];
  any_reducible_ |= conversion.corners.has_value();
}

void CellCollector::convert(std::size_t index, int type, std::span<const NodeId> nodes,
                            CellKind kind, std::span<const std::uint8_t> permutation) {
  ordered_.resize(node_count(kind));
  places_.resize(ordered_.size());
  for (std::size_t n = 0; n < ordered_.size(); ++n) {
    places_[n] = permutation.empty() ? static_cast<std::uint8_t>(n) : permutation[n];
    ordered_[n] = nodes[places_[n]];
  }
  if (TrueKinds::has_repeated_corner(kind, ordered_)) return add_true_kind(index, type, kind);
  result_.nodes.insert(result_.nodes.end(), ordered_.begin(), ordered_.end());
  if (keep_places_) result_.places.insert(result_.places.end(), places_.begin(), places_.end());
  finish_cell(index, kind);
}

/// Whether a cell with a problem is of its true kind all the same; keeps the nodes left out then.
bool CellCollector::takes_true_kind(const TrueCell& found) {
  if (found.replaced.empty()) return false;
  if (!options_.approximate)
    for (const auto& [node, by] : found.replaced)
      if (!same_place_ || !same_place_(ordered_[node], ordered_[by])) return false;
  for (const auto& [node, by] : found.replaced)
    result_.replaced.emplace_back(ordered_[node], ordered_[by]);
  return true;
}

void CellCollector::add_true_kind(std::size_t index, int type, CellKind kind) {
  const TrueCell found = true_kinds_.find(kind, ordered_);
  if (!found.problem.empty() && !takes_true_kind(found)) {
    ++problems_[fmt::format("{} that {}", type_name_(type), found.problem)];
    if (first_problem_.empty())
      first_problem_ =
          fmt::format("; the first is cell {} with nodes {}", index, fmt::join(ordered_, " "));
    return;
  }
  ++true_cells_[fmt::format("{} to {}", kind_name(kind), kind_name(found.kind))];
  for (std::size_t n = 0; n < node_count(found.kind); ++n) {
    result_.nodes.push_back(ordered_[found.nodes[n]]);
    if (keep_places_) result_.places.push_back(places_[found.nodes[n]]);
  }
  finish_cell(index, found.kind);
}

void CellCollector::finish_cell(std::size_t index, CellKind kind) {
  if (result_.all_kept && index != result_.kinds.size()) start_kept();
  result_.kinds.push_back(kind);
  result_.elems.push_back(result_.nodes.size());
  if (!result_.all_kept) result_.kept.push_back(static_cast<CellId>(index));
}

/// Lists the cells kept so far; from the first cell left out on, every kept cell is listed.
void CellCollector::start_kept() {
  result_.all_kept = false;
  for (CellId i = 0; i < result_.kinds.size(); ++i) result_.kept.push_back(i);
}

ConvertedCells CellCollector::finish(std::size_t total, std::vector<std::string>& notes) {
  const bool any_unsupported = !unsupported_.empty() || !problems_.empty();
  if (any_unsupported && !options_.skip_unsupported)
    throw InputError(
        subject_,
        fmt::format("holds volume cells that cannot be converted: {}{}{} "
                    "(ReadOptions::skip_unsupported leaves them out{})",
                    listed_unsupported(), first_problem_, reason_.empty() ? "" : "; " + reason_,
                    any_reducible_ ? ", ReadOptions::corners_of_unsupported takes their corners"
                    : problems_.empty() || options_.approximate
                        ? ""
                        : ", ReadOptions::approximate converts those with repeated nodes"));
  write_notes(notes);
  if (result_.all_kept && result_.kinds.size() != total) start_kept();
  return std::move(result_);
}

std::string CellCollector::listed(const Counts& counts) const {
  std::map<std::string, std::size_t> named;
  for (const auto& [key, count] : counts)
    named[with_nodes(type_name_(key.first), key.second)] += count;
  return joined(named);
}

std::string CellCollector::listed_unsupported() const {
  if (problems_.empty()) return listed(unsupported_);
  return unsupported_.empty() ? joined(problems_)
                              : fmt::format("{}, {}", listed(unsupported_), joined(problems_));
}

void CellCollector::write_notes(std::vector<std::string>& notes) const {
  if (!surfaces_.empty())
    notes.push_back(fmt::format("dropped cells without volume: {}", listed(surfaces_)));
  if (!unsupported_.empty() || !problems_.empty())
    notes.push_back(fmt::format("skipped unsupported cells: {}", listed_unsupported()));
  if (!reduced_.empty())
    notes.push_back(fmt::format("kept the corners alone of: {}", listed(reduced_)));
  if (!extra_nodes_.empty())
    notes.push_back(fmt::format("took the first nodes of cells of linear types with more: {}",
                                listed(extra_nodes_)));
  if (!true_cells_.empty())
    notes.push_back(
        fmt::format("cells with repeated nodes became their true kind: {}", joined(true_cells_)));
}

std::string fate_of(const CellConversion& conversion, std::span<const NodeId> nodes,
                    TrueKinds& true_kinds) {
  if (conversion.fate == CellFate::no_volume) return "dropped (no volume)";
  if (conversion.fate == CellFate::unsupported && conversion.corners)
    return "reduced where that loses nothing";
  if (conversion.fate != CellFate::converted) return "unsupported";
  std::array<NodeId, 32> storage{};
  const auto ordered = std::span(storage).first(node_count(conversion.kind));
  for (std::size_t n = 0; n < ordered.size(); ++n)
    ordered[n] = nodes[conversion.permutation.empty() ? n : conversion.permutation[n]];
  if (!TrueKinds::has_repeated_corner(conversion.kind, ordered))
    return std::string(kind_name(conversion.kind));
  const TrueCell found = true_kinds.find(conversion.kind, ordered);
  return std::string(found.problem.empty() ? kind_name(found.kind) : "unsupported");
}

}  // namespace hiac::formats

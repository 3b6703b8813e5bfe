#include "formats/common/mesh/node_resolver.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

/// Node i of the kind is this node of the file's cell.
std::size_t place_of_node(const CellConversion& conversion, std::size_t i) {
  return conversion.permutation.empty() ? i : conversion.permutation[i];
}

bool is_left_out(std::int64_t number) { return number == kLeftOutNode; }

}  // namespace

NodeResolver::NodeResolver(const ForeignMesh& foreign, std::string subject)
    : foreign_(foreign), subject_(std::move(subject)), index_(foreign.node_numbers) {
  if (foreign.cell_count() >= kNoCell || foreign.point_count() >= kNoCell)
    throw InputError(subject_,
                     fmt::format("too large (at most {} cells and points expected, {} "
                                 "and {} found)",
                                 kNoCell - 1, foreign.cell_count(), foreign.point_count()));
  for (const auto& [later, first] : index_.repeated())
    if (!std::equal(&foreign.xyz[3 * later], &foreign.xyz[3 * later] + 3, &foreign.xyz[3 * first]))
      throw InputError(subject_, fmt::format("node {} is given twice, in two places",
                                             foreign.node_numbers[later]));
  for (const ForeignType& type : foreign.types) types_.push_back(type_of(type));
}

NodeResolver::Type NodeResolver::type_of(const ForeignType& foreign) {
  const CellConversion& from = foreign.conversion;
  Type type;
  if (from.fate == CellFate::converted) {
    for (std::size_t i = 0; i < corner_count(from.kind); ++i)
      type.required.push_back(static_cast<std::uint8_t>(place_of_node(from, i)));
    type.linear = from;
    type.linear.kind = kind_of(shape_of(from.kind), CellOrder::linear);
  } else if (from.corners) {
    for (std::size_t i = 0; i < node_count(*from.corners); ++i)
      type.required.push_back(static_cast<std::uint8_t>(place_of_node(from, i)));
  }
  return type;
}

std::string NodeResolver::name_of(std::size_t cell) const {
  return fmt::format("{} {}", foreign_.types[foreign_.cell_types[cell]].name,
                     foreign_.cell_numbers.empty() ? static_cast<std::int64_t>(cell) + 1
                                                   : foreign_.cell_numbers[cell]);
}

NodeId NodeResolver::place_of(std::int64_t number, std::size_t cell) const {
  std::size_t place = NumberIndex::kNone;
  if (!foreign_.node_numbers.empty()) {
    place = index_.find(number);
  } else if (number >= foreign_.first_node &&
             static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(foreign_.first_node) <
                 foreign_.point_count()) {
    place = static_cast<std::size_t>(number - foreign_.first_node);
  }
  if (place == NumberIndex::kNone)
    throw InputError(subject_, fmt::format("cell {}: there is no node {}", name_of(cell), number));
  return static_cast<NodeId>(place);
}

NodeResolver::Cell NodeResolver::resolve(std::size_t cell, std::size_t begin) {
  const std::size_t t = foreign_.cell_types[cell];
  const ForeignType& foreign = foreign_.types[t];
  const auto numbers = std::span(foreign_.cell_nodes).subspan(begin, foreign.nodes);
  nodes_.resize(numbers.size());
  if (foreign.conversion.fate == CellFate::no_volume) return {nodes_, &foreign.conversion};
  bool any_left_out = false;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    any_left_out |= is_left_out(numbers[i]);
    nodes_[i] = is_left_out(numbers[i]) ? 0 : place_of(numbers[i], cell);
  }
  if (!any_left_out) return {nodes_, &foreign.conversion};
  for (const std::uint8_t place : types_[t].required)
    if (is_left_out(numbers[place]))
      throw InputError(subject_, fmt::format("cell {}: corner {} is left out (only mid-edge nodes "
                                             "may be)",
                                             name_of(cell), place + 1));
  return {nodes_, fill_in(cell, foreign, types_[t], numbers)};
}

const CellConversion* NodeResolver::fill_in(std::size_t cell, const ForeignType& foreign,
                                            const Type& type,
                                            std::span<const std::int64_t> numbers) {
  const CellConversion& conversion = foreign.conversion;
  if (conversion.fate != CellFate::converted) return &conversion;
  const std::size_t corners = corner_count(conversion.kind);
  bool all = true;
  for (std::size_t i = corners; i < node_count(conversion.kind); ++i)
    all &= is_left_out(numbers[place_of_node(conversion, i)]);
  if (all) return &type.linear;
  if (order_of(conversion.kind) != CellOrder::quadratic)
    throw InputError(subject_, fmt::format("cell {}: nodes are left out (possible in quadratic "
                                           "cells alone)",
                                           name_of(cell)));
  const auto edges = topology_of(conversion.kind).edges;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::size_t place = place_of_node(conversion, corners + e);
    if (!is_left_out(numbers[place])) continue;
    nodes_[place] = middle_of(nodes_[place_of_node(conversion, edges[e][0])],
                              nodes_[place_of_node(conversion, edges[e][1])]);
  }
  return &conversion;
}

NodeId NodeResolver::middle_of(NodeId a, NodeId b) {
  if (a == b) return a;  // a collapsed edge's middle is its end
  const auto key = std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
  const auto [known, fresh] =
      middles_.try_emplace(key, static_cast<NodeId>(foreign_.point_count() + made_.size()));
  if (fresh) made_.emplace_back(a, b);
  return known->second;
}

std::pair<std::size_t, std::size_t> edge_ends(const CellConversion& conversion, std::size_t place) {
  const auto edges = topology_of(conversion.kind).edges;
  const std::size_t corners = corner_count(conversion.kind);
  std::size_t e = 0;
  while (place_of_node(conversion, corners + e) != place) ++e;
  return {place_of_node(conversion, edges[e][0]), place_of_node(conversion, edges[e][1])};
}

}  // namespace hiac::formats

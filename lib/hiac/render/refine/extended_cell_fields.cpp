#include "hiac/render/refine/extended_cell_fields.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "hiac/element/ray_rounding.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/bounds/rounding_counts.hpp"

namespace hiac {

using Real = long double;

void ExtendedCellFields::enter(CellId cell, const ExtendedCell& geometry) {
  cell_ = cell;
  const CellKind kind = frame_.mesh.kinds[cell];
  const auto nodes = relative_positions(frame_.mesh, cell, frame_.projector);
  gradient_.emplace(kind, nodes, frame_.straightness);
  steepness_ = CellMap(kind, nodes, frame_.straightness).steepness();
  reach_ = geometry.reach();
  bent_ = geometry.bent();
  inside_ = {};
  inside_.aside = kExtended.unit * (kWorldRounding * reach_ + kMapRounding * geometry.size());
  inside_.at_ends = inside_.aside + bent_;
  inside_.along = kPlaneDepthRounding * kExtended.unit * reach_;
}

std::array<double, 8> ExtendedCellFields::node_values(const FrameField& field) const {
  const auto nodes = frame_.mesh.cell_nodes(cell_);
  std::array<double, 8> values{};
  for (std::size_t k = 0; k < nodes.size(); ++k)
    values[k] = field.values[field.index(cell_, frame_.mesh.elems[cell_] + k, nodes[k])];
  return values;
}

ExtendedCellField ExtendedCellFields::known(const CellField& nodes, const FrameField& field,
                                            double level) const {
  const std::array<double, 8> values = node_values(field);
  const std::size_t count = frame_.mesh.cell_nodes(cell_).size();
  ExtendedCellField known{};
  for (std::size_t k = 0; k < count; ++k)
    known.field.values[k] = static_cast<Real>(values[k]) - level;
  const auto [least, most] = std::ranges::minmax(std::span(known.field.values).first(count));
  known.field.least = least;
  known.field.most = most;
  if (least == most) return known;
  const ValueRange range{nodes.least, nodes.most};
  const double difference = range.most - range.least;
  const double largest = std::max(std::abs(range.least), std::abs(range.most));
  const double rounding = kExtended.unit * (kRayValueRounding * largest +
                                            kRayPointRounding * reach_ * steepness_ * difference);
  const double negligible = std::max(nodes.allowed, rounding);
  known.field.negligible = negligible;
  const double gradient = (*gradient_)(nodes);
  known.error = field_error(range, gradient, inside_, kAlongRayRounding, kExtended) +
                std::min(difference, 2 * negligible);
  if (bent_ > 0) known.at_faces = std::min(difference, gradient * 2 * bent_);
  return known;
}

}  // namespace hiac

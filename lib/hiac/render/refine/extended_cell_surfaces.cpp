#include "hiac/render/refine/extended_cell_surfaces.hpp"

#include <algorithm>
#include <optional>

#include "hiac/element/face_interpolant.hpp"
#include "hiac/render/bounds/rounding_counts.hpp"
#include "hiac/render/cells/cuts_along_ray.hpp"
#include "hiac/render/cells/sign_changes.hpp"

namespace hiac {
namespace {

using Real = long double;
using Vec = ExtendedVector;

// Whether an isosurface's field is below its value where the ray crosses a face.
bool below_at_face(const IsosurfaceCut& cut, CellKind kind, std::size_t face,
                   std::span<const NodeId> nodes, std::span<const double> offsets, Real offset) {
  if ((cut.closed_faces & (1U << face)) != 0) return true;
  bool mixed = false;
  const double sign = face_offsets(kind, face, nodes, offsets).sign(mixed);
  return mixed ? offset < 0 : sign < 0;
}

}  // namespace

// Fills places_ with the positions, as fractions of the stretch, at which pieces_ change sign, and
// `moved` with the error of each.
void ExtendedCellSurfaces::find_places(const IsosurfaceCut& cut, const CellField& offsets,
                                       const ExtendedCellField& known,
                                       const ExtendedStretch& stretch, std::vector<Real>& moved) {
  const CellKind kind = frame_.mesh.kinds[fields_.cell()];
  const auto nodes = frame_.mesh.cell_nodes(fields_.cell());
  const auto below = [&](std::uint8_t face, Real offset) {
    return below_at_face(cut, kind, face, nodes, offsets.values, offset);
  };
  places_.clear();
  std::optional<bool> first;
  if (!stretch.front_clipped)
    first = below(stretch.front_face, pieces_.empty() ? 0 : evaluate(pieces_.front().fields[0], 0));
  SignChanges<Real> changes(first, places_);
  for (const ExtendedCell::Piece& piece : pieces_)
    changes.follow(piece.fields[0], piece.begin, piece.end, known.field.negligible, roots_);
  if (!stretch.back_clipped)
    changes.certain(
        below(stretch.back_face, pieces_.empty() ? 0 : evaluate(pieces_.back().fields[0], 1)), 1,
        1);
  moved.assign(places_.size(), 0);
  if (pieces_.empty() && known.field.least < known.field.most) doubtful_ = true;
  // whether the number of places stays the same if offsets are off by `error`, and how far they
  // move
  const Real error = known.error + 2 * known.field.negligible;
  std::vector<Real> none, shifted;
  bool as_many = as_many_when_shifted(pieces_, error, places_, moved, shifted, roots_);
  if (known.at_faces > 0)
    as_many &=
        as_many_when_shifted(pieces_, error + known.at_faces, places_, none, shifted, roots_);
  if (!as_many) doubtful_ = true;
}

bool ExtendedCellSurfaces::add(const ExtendedCell& geometry, const ExtendedRay& ray,
                               const ExtendedStretch& stretch, const IsosurfaceCut& cut) {
  const FrameIsosurface& surface = frame_.isosurfaces.surfaces[cut.surface];
  const FrameField& field = frame_.isosurfaces.fields[surface.field];
  const CellField offsets = cell_field(frame_.mesh, fields_.cell(), field, surface.value);
  const ExtendedCellField offset = fields_.known(offsets, field, surface.value);
  pieces_.clear();
  if (stretch.front < stretch.back &&
      !geometry.along(ray, stretch.front, stretch.back, {&offset.field, 1}, pieces_))
    return false;
  std::vector<Real> moved;
  find_places(cut, offsets, offset, stretch, moved);
  const Real depth = stretch.back - stretch.front;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    ExtendedCrossing crossed{&surface,
                             stretch.front + places_[i] * depth,
                             static_cast<double>(moved[i] * depth),
                             {},
                             {}};
    if (!shade(geometry, ray, stretch, offset, crossed)) return false;
    crossed_.push_back(crossed);
  }
  return true;
}

// Shades a crossing with the normal there; the error of the shade includes the normal's change over
// the interval in which the crossing may lie. Returns false if a point's reference coordinates are
// not found.
bool ExtendedCellSurfaces::shade(const ExtendedCell& geometry, const ExtendedRay& ray,
                                 const ExtendedStretch& stretch, const ExtendedCellField& known,
                                 ExtendedCrossing& crossed) const {
  const auto normal_at = [&](Real t, Vec& normal, double& rounding) {
    ExtendedCell::Derivatives d;
    if (!geometry.derivatives(ray.at(t), known.field.values, d)) return false;
    normal = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec area = cross(d.columns[(k + 1) % 3], d.columns[(k + 2) % 3]);
      for (std::size_t c = 0; c < 3; ++c) normal[c] += d.gradient[k] * area[c];
    }
    normal = length(normal) > 0 ? unit(normal) : Vec{0, 0, 1};
    rounding =
        kAngleRounding * kExtended.unit *
        gradient_condition({rounded(d.columns[0]), rounded(d.columns[1]), rounded(d.columns[2])},
                           rounded(d.gradient));
    return true;
  };
  Vec normal;
  double angle = 0;
  if (!normal_at(crossed.t, normal, angle)) return false;
  const Real reach = crossed.moved + fields_.inside().aside;
  for (const Real t :
       {std::max(stretch.front, crossed.t - reach), std::min(stretch.back, crossed.t + reach)}) {
    Vec other;
    double other_angle = 0;
    if (!normal_at(t, other, other_angle)) return false;
    const Vec opposite{-other[0], -other[1], -other[2]};
    const Real apart = std::min(length(minus(other, normal)), length(minus(opposite, normal)));
    angle = std::max(angle, other_angle) + 2 * static_cast<double>(apart);
  }
  const Vec along = ray.along();
  const auto& lights = frame_.isosurfaces.lights;
  crossed.light = extended_surface(*crossed.surface, lights, normal, along);
  crossed.shade_error =
      shade_bound(*crossed.surface, lights, rounded(normal), rounded(along), angle, kExtended);
  return true;
}

bool ExtendedCellSurfaces::find(const ExtendedCell& geometry, const ExtendedRay& ray,
                                const ExtendedStretch& stretch) {
  crossed_.clear();
  doubtful_ = false;
  for (const IsosurfaceCut& cut : frame_.isosurfaces.in(fields_.cell()))
    if (!add(geometry, ray, stretch, cut)) return false;
  std::ranges::stable_sort(crossed_, {}, &ExtendedCrossing::t);
  if (order_doubtful(crossed_)) doubtful_ = true;
  return true;
}

}  // namespace hiac

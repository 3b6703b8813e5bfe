#include "hiac/render/cells/cuts_along_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/base/rounding.hpp"
#include "hiac/element/gradient/gradient_bound.hpp"
#include "hiac/element/gradient/gradient_direction.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/render/bounds/rounding_counts.hpp"
#include "hiac/render/cells/face_normals.hpp"
#include "hiac/render/cells/sign_changes.hpp"

namespace hiac {
namespace {

// Relative to the largest offset in a cell: rounding may change the sign of smaller offsets.
constexpr double kDoubt = 1e-9;

// The error of a normal is this times the condition of the gradient.
constexpr double kAngleUnit = kAngleRounding * kUnit;

}  // namespace

bool CutsAlongRay::enter(CellId cell, const RayDisplacement& displacement) {
  cuts_.clear();
  displacement_ = displacement;
  const auto in_cell = frame_.isosurfaces.in(cell);
  if (in_cell.empty()) return false;
  const ZooMesh& mesh = frame_.mesh;
  kind_ = mesh.kinds[cell];
  const auto nodes = mesh.cell_nodes(cell);
  nodes_ = relative_positions(mesh, cell, frame_.projector);
  std::optional<GradientBound> gradient;
  if (frame_.with_error) gradient.emplace(kind_, nodes_, frame_.straightness);
  for (const IsosurfaceCut& in : in_cell) {
    Cut& cut = cuts_.emplace_back();
    cut.surface = &frame_.isosurfaces.surfaces[in.surface];
    cut.closed_faces = in.closed_faces;
    cut.offsets =
        cell_field(mesh, cell, frame_.isosurfaces.fields[cut.surface->field], cut.surface->value);
    if (gradient)
      cut.error = field_error({cut.offsets.least, cut.offsets.most}, (*gradient)(cut.offsets),
                              displacement, kAlongRayRounding);
    for (std::size_t f = 0; f < face_count(kind_); ++f)
      cut.faces[f] = face_offsets(kind_, f, nodes, cut.offsets.values);
  }
  return true;
}

bool CutsAlongRay::below_at_face(const Cut& cut, const CellCrossing& crossing, std::size_t face,
                                 double t, double offset) const {
  // neighbours do not agree on the face: each cell uses its own polynomial
  if (cut.offsets.polynomial) return offset < 0;
  if ((cut.closed_faces & (1U << face)) != 0) return true;
  bool mixed = false;
  const double sign = cut.faces[face].sign(mixed);
  if (!mixed) return sign < 0;
  if (std::abs(offset) > kDoubt * std::max(-cut.offsets.least, cut.offsets.most)) return offset < 0;
  return face_value(frame_.mesh, frame_.projector, cut.faces[face], pixel_center(crossing.x),
                    pixel_center(crossing.y), t) < 0;
}

// Computes how far places_ move if the offsets are wrong by `error`, and marks the result doubtful
// if their number may change.
void CutsAlongRay::add_doubts(const RayStretch& stretch, const Cut& cut, double error) {
  moved_.assign(places_.size(), 0);
  if (!as_many_when_shifted(pieces_, error, places_, moved_, shifted_, roots_)) doubtful_ = true;
  for (double& moved : moved_) moved *= stretch.back - stretch.front;
  if (pieces_.empty() && cut.offsets.least < cut.offsets.most) doubtful_ = true;
}

void CutsAlongRay::interpolate(const CellMap& map, CellSegments& segments) {
  for (Cut& cut : cuts_) {
    if (cut.offsets.polynomial) continue;
    const CellPolynomials polynomials(kind_, nodes_, map, {&cut.offsets, 1});
    interpolate_cell_segments(frame_, polynomials, segments, cut.pieces);
  }
}

// Fills places_ with the positions, as fractions of the stretch, at which the ray crosses the
// surface.
void CutsAlongRay::add_places(const CellMap& map, const CellCrossing& crossing,
                              const RayStretch& stretch, std::optional<std::size_t> segment,
                              const Cut& cut) {
  places_.clear();
  pieces_.clear();
  const FieldAlongRay field(kind_, map, {&cut.offsets, 1});
  if (segment && !cut.offsets.polynomial) {
    const auto known = cut.pieces.of(*segment);
    pieces_.assign(known.begin(), known.end());
  }
  if (pieces_.empty() && stretch.front < stretch.back) field.along(stretch, pieces_);
  const auto end_value = [&](const FieldAlongRay::Piece& piece, double t) {
    return evaluate(piece.fields[0], t);
  };
  std::optional<bool> below;  // unknown where the stretch is clipped
  if (stretch.front == crossing.front)
    below = below_at_face(cut, crossing, crossing.front_face, crossing.front,
                          pieces_.empty() ? 0 : end_value(pieces_.front(), 0));
  const double rounding = 2 * field.rounding(stretch, cut.offsets);
  SignChanges<double> changes(below, places_);
  for (const FieldAlongRay::Piece& piece : pieces_)
    changes.follow(piece.fields[0], piece.begin, piece.end, rounding, roots_);
  if (stretch.back == crossing.back)
    changes.certain(below_at_face(cut, crossing, crossing.back_face, crossing.back,
                                  pieces_.empty() ? 0 : end_value(pieces_.back(), 1)),
                    1, 1);
  if (frame_.with_error) add_doubts(stretch, cut, cut.error + 2 * rounding);
}

// The surface's normal in the camera's frame; `rounding` receives the error of its direction.
std::array<double, 3> CutsAlongRay::normal_at(const CellMap& map, const RayStretch& stretch,
                                              const Cut& cut, double t, double& rounding) const {
  if (cut.offsets.polynomial) {
    const auto along = cut.offsets.polynomial->gradient(minus(stretch.at(t), nodes_[0]));
    return frame_.projector.camera_vector(largest(along) > 0 ? unit(along) : Vector{0, 0, 1});
  }
  const CellMap::Point xi = map.reference(stretch.at(t), stretch.guess(map));
  std::array<std::array<double, 3>, CellMap::kMostNodes> shape;
  shape_gradients<double>(kind_, xi, shape);
  std::array<std::array<double, 3>, 3> columns{};
  std::array<double, 3> gradient{};
  for (std::size_t k = 0; k < node_count(kind_); ++k)
    for (std::size_t a = 0; a < 3; ++a) {
      gradient[a] += shape[k][a] * cut.offsets.values[k];
      for (std::size_t c = 0; c < 3; ++c)
        columns[a][c] += shape[k][a] * (nodes_[k][c] - nodes_[0][c]);
    }
  if (frame_.with_error) rounding = kAngleUnit * gradient_condition(columns, gradient);
  return frame_.projector.camera_vector(gradient_direction(columns, gradient));
}

IsosurfaceCrossing CutsAlongRay::crossing_at(const CellMap& map, const CellCrossing& crossing,
                                             const RayStretch& stretch, const Cut& cut, double u,
                                             double moved) const {
  const Projector& projector = frame_.projector;
  const auto ray = ray_through(projector, pixel_center(crossing.x), pixel_center(crossing.y));
  double angle = 0;
  IsosurfaceCrossing found;
  found.surface = cut.surface;
  found.t = u >= 1 ? stretch.back : stretch.front + u * (stretch.back - stretch.front);
  const auto normal = normal_at(map, stretch, cut, found.t, angle);
  found.shade = shade_isosurface(*cut.surface, frame_.isosurfaces.lights, normal, ray);
  if (!frame_.with_error) return found;
  found.moved = moved;
  for (const double t : {std::max(stretch.front, found.t - moved - displacement_.aside),
                         std::min(stretch.back, found.t + moved + displacement_.aside)}) {
    double other_angle = 0;
    const auto other = normal_at(map, stretch, cut, t, other_angle);
    // a normal may point to either side
    const double apart =
        std::hypot(other[0] - normal[0], other[1] - normal[1], other[2] - normal[2]);
    const double against =
        std::hypot(other[0] + normal[0], other[1] + normal[1], other[2] + normal[2]);
    angle = std::max(angle, other_angle) + 2 * std::min(apart, against);
  }
  found.shade_error = shade_bound(*cut.surface, frame_.isosurfaces.lights, normal, ray, angle);
  return found;
}

void CutsAlongRay::find(const CellMap& map, const CellCrossing& crossing, const RayStretch& stretch,
                        std::optional<std::size_t> segment,
                        std::vector<IsosurfaceCrossing>& found) {
  found.clear();
  doubtful_ = false;
  for (const Cut& cut : cuts_) {
    add_places(map, crossing, stretch, segment, cut);
    for (std::size_t i = 0; i < places_.size(); ++i)
      found.push_back(
          crossing_at(map, crossing, stretch, cut, places_[i], frame_.with_error ? moved_[i] : 0));
  }
  std::ranges::stable_sort(found, {}, &IsosurfaceCrossing::t);
  if (frame_.with_error && order_doubtful(found)) doubtful_ = true;
}

}  // namespace hiac

#include "hiac/preview/regions/slabs.hpp"

#include <algorithm>

#include "hiac/geometry/vector.hpp"

namespace hiac::preview {
namespace {

// The face of a tetrahedron, or what is left of it, on which one corner has no share.
void face_without(const Polyhedron& polyhedron, std::size_t corner,
                  std::vector<std::uint16_t>& polygon) {
  for (std::size_t f = 0; f < polyhedron.face_count(); ++f) {
    const auto face = polyhedron.face(f);
    if (std::ranges::all_of(face,
                            [&](std::uint16_t v) { return polyhedron.shares[v][corner] == 0; }))
      polygon.assign(face.begin(), face.end());
  }
}

}  // namespace

LinearField linear_field(std::span<const std::array<double, 3>, 4> corners,
                         const std::array<double, 4>& values) {
  const Vector a = minus(corners[1], corners[0]), b = minus(corners[2], corners[0]),
               c = minus(corners[3], corners[0]);
  const Vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double volume = dot(a, bc);
  if (volume == 0) return {{0, 0, 0}, values[0]};
  LinearField field{};
  for (std::size_t k = 0; k < 3; ++k)
    field.gradient[k] = ((values[1] - values[0]) * bc[k] + (values[2] - values[0]) * ca[k] +
                         (values[3] - values[0]) * ab[k]) /
                        volume;
  field.at_origin = values[0] - dot(field.gradient, corners[0]);
  return field;
}

void Slicer::cut(const Polyhedron& whole, const PlaneFamily& family, Stage& stage) {
  const std::size_t levels = family.levels.size();
  stage.parts.resize(std::max(stage.parts.size(), levels + 1));
  stage.polygons.resize(std::max(stage.polygons.size(), levels));
  std::vector<double> values;
  for (const auto& share : whole.shares) {
    double value = 0;
    for (std::size_t k = 0; k < 4; ++k) value += share[k] * family.values[k];
    values.push_back(value);
  }
  const double most = std::ranges::max(family.values);
  stage.rest = whole;
  for (std::size_t n = 0; n < levels; ++n) {
    if (!cutter_.cut(stage.rest, values, family.levels[n], stage.parts[n], stage.above)) ++uncut_;
    stage.polygons[n] = cutter_.polygon;
    if (family.levels[n] == most && std::ranges::count(family.values, most) == 3) {
      // all of it is below; the surface is its face
      const auto apex = std::ranges::find_if(family.values, [&](double v) { return v < most; });
      face_without(stage.parts[n], static_cast<std::size_t>(apex - family.values.begin()),
                   stage.polygons[n]);
    }
    std::swap(stage.rest, stage.above);
    values = cutter_.values_above;
  }
  std::swap(stage.parts[levels], stage.rest);
}

void Slicer::visit_part(const Stage& stage, std::size_t family, std::size_t part) {
  if (stage.parts[part].size() == 0) return;
  part_[family] = part;
  visit_family(stage.parts[part], family + 1);
}

void Slicer::visit_polygon(const Stage& stage, std::size_t family, std::size_t level) {
  if (!stage.polygons[level].empty())
    visitor_->polygon(stage.parts[level], stage.polygons[level], family, level);
}

void Slicer::visit_family(const Polyhedron& whole, std::size_t family) {
  if (family == families_.size()) {
    visitor_->slab(whole, part_);
    return;
  }
  const std::size_t levels = families_[family].levels.size();
  if (levels == 0) {
    part_[family] = 0;
    visit_family(whole, family + 1);
    return;
  }
  Stage& stage = *stages_[family];
  cut(whole, families_[family], stage);
  for (std::size_t n = 0; n < stage.eye_part; ++n) {
    visit_part(stage, family, n);
    visit_polygon(stage, family, n);
  }
  for (std::size_t n = levels; n > stage.eye_part; --n) {
    visit_part(stage, family, n);
    visit_polygon(stage, family, n - 1);
  }
  visit_part(stage, family, stage.eye_part);
}

void Slicer::visit(const Polyhedron& whole, std::span<const std::array<double, 3>, 4> camera,
                   bool perspective, std::span<const PlaneFamily> families,
                   const SlabVisitor& visitor) {
  families_ = families;
  visitor_ = &visitor;
  part_.assign(families.size(), 0);
  while (stages_.size() < families.size()) stages_.push_back(std::make_unique<Stage>());
  for (std::size_t f = 0; f < families.size(); ++f) {
    const LinearField field = linear_field(camera, families[f].values);
    const auto& levels = families[f].levels;
    // the eye: at the origin or, in parallel projection, as far in front as one likes
    stages_[f]->eye_part =
        perspective ? static_cast<std::size_t>(std::ranges::lower_bound(levels, field.at_origin) -
                                               levels.begin())
                    : (field.gradient[2] > 0 ? 0 : levels.size());
  }
  visit_family(whole, 0);
}

}  // namespace hiac::preview

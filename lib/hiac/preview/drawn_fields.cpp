#include "hiac/preview/drawn_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/preview/exact_shaders.hpp"

namespace hiac::preview {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Optical depth of the mesh's diagonal at the largest extinction: what is above that is opaque in a
// part of it that no pixel shows, and products of densities stay numbers in single precision.
constexpr double kThickestMesh = 1e12;

double diagonal(const ZooMesh& mesh) {
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity},
      high{-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = 0; i < mesh.xyz.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], mesh.xyz[i]);
    high[i % 3] = std::max(high[i % 3], mesh.xyz[i]);
  }
  return mesh.node_count() == 0 ? 0
                                : std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

// The number of a field in a scene's list, which it joins.
std::size_t number_of(DrawnScene& drawn, const std::string& name) {
  for (std::size_t f = 0; f < drawn.fields.size(); ++f)
    if (drawn.fields[f].name == name) return f;
  drawn.fields.push_back({.name = name, .values = {}});
  return drawn.fields.size() - 1;
}

// The scalars of a field that something depends on: breakpoints and isovalues.
struct Marks {
  double least = kInfinity, most = -kInfinity;
  void include(double scalar) {
    least = std::min(least, scalar);
    most = std::max(most, scalar);
  }
};

void scale(DrawnField& field, std::span<const double> values, Marks marks) {
  if (!(marks.least < marks.most))
    for (const double value : values)
      if (std::isfinite(value)) marks.include(value);
  if (marks.least <= marks.most) {
    field.middle = marks.least / 2 + marks.most / 2;
    const double half = marks.most / 2 - marks.least / 2;
    if (half > 0) field.half = half;
  }
  field.values.resize(values.size());
  parallel_for(values.size(), std::size_t{1} << 14, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) field.values[i] = field.scaled(values[i]);
  });
}

}  // namespace

DrawnScene drawn_scene(const ZooMesh& mesh, const Scene& scene) {
  DrawnScene drawn;
  if (scene.isosurfaces.size() > kMostSurfaces)
    throw UsageError(fmt::format("isosurface: previews draw at most {} (found {})", kMostSurfaces,
                                 scene.isosurfaces.size()));
  drawn.lights = scene.lights;
  drawn.isosurfaces = make_isosurfaces(mesh, scene, Projector(scene.camera, scene.image));
  const double longest = diagonal(mesh);
  drawn.optics = make_optics_tables(scene.volume, Integration::exact,
                                    kThickestMesh / std::max(longest, 1 / kThickestMesh));
  const auto& color = scene.volume.color;
  const auto& extinction = scene.volume.extinction;
  if (extinction || color)
    drawn.extinction = number_of(drawn, extinction ? extinction->field : color->field);
  drawn.color = drawn.optics.same_field ? drawn.extinction : number_of(drawn, color->field);
  for (const Isosurface& surface : scene.isosurfaces)
    drawn.surfaces.push_back(number_of(drawn, surface.field));
  if (drawn.fields.empty()) {  // nothing but a background
    drawn.fields.push_back({.name = "", .location = FieldLocation::cell, .values = {}});
    drawn.fields[0].values.resize(mesh.cell_count());
    return drawn;
  }
  for (std::size_t f = 0; f < drawn.fields.size(); ++f) {
    const Field field = scalar_field(mesh, drawn.fields[f].name);
    Marks marks;
    if (f == drawn.extinction)
      for (const double b : drawn.optics.extinction_function.breakpoints()) marks.include(b);
    if (f == drawn.color)
      for (const double b : drawn.optics.color_function.breakpoints()) marks.include(b);
    for (std::size_t s = 0; s < drawn.surfaces.size(); ++s)
      if (drawn.surfaces[s] == f) marks.include(scene.isosurfaces[s].value);
    drawn.fields[f].location = field.location;
    scale(drawn.fields[f], field.values.view(), marks);
  }
  return drawn;
}

}  // namespace hiac::preview

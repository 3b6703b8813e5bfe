#include "hiac/preview/drawn_fields.hpp"

#include <algorithm>

#include "hiac/base/error.hpp"
#include "hiac/base/finite_range.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/geometry/box.hpp"

namespace hiac::preview {
namespace {

// Optical depth of the mesh's diagonal at the largest extinction: what is above that is opaque in a
// part of it that no pixel shows, and products of densities stay numbers in single precision.
constexpr double kThickestMesh = 1e12;

// The number of a field in a scene's list, which it joins.
std::size_t number_of(DrawnScene& drawn, const std::string& name) {
  for (std::size_t f = 0; f < drawn.fields.size(); ++f)
    if (drawn.fields[f].name == name) return f;
  drawn.fields.push_back({.name = name, .values = {}});
  return drawn.fields.size() - 1;
}

// `marks`: the range of what tells the field's scalars apart, breakpoints and isovalues.
void scale(DrawnField& field, std::span<const double> values, FiniteRange marks) {
  if (!(marks.low < marks.high))
    for (const double value : values) marks.include(value);
  if (!marks.empty()) {
    field.middle = marks.low / 2 + marks.high / 2;
    const double half = marks.high / 2 - marks.low / 2;
    if (half > 0) field.half = half;
  }
  field.values.resize(values.size());
  parallel_for(values.size(), std::size_t{1} << 14, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) field.values[i] = field.scaled(values[i]);
  });
}

void add_surfaces(DrawnScene& drawn, const Scene& scene) {
  for (std::size_t s = 0; s < scene.isosurfaces.size(); ++s) {
    const std::size_t field = number_of(drawn, scene.isosurfaces[s].field);
    auto at = std::ranges::find(drawn.surface_fields, field, &SurfaceField::field);
    if (at == drawn.surface_fields.end()) at = drawn.surface_fields.insert(at, {field, {}});
    at->surfaces.push_back(s);
    drawn.surface_field_of.push_back(static_cast<std::size_t>(at - drawn.surface_fields.begin()));
  }
  for (SurfaceField& of_field : drawn.surface_fields)
    std::ranges::stable_sort(of_field.surfaces, {},
                             [&](std::size_t s) { return scene.isosurfaces[s].value; });
}

}  // namespace

DrawnScene drawn_scene(const ZooMesh& mesh, const Scene& scene) {
  DrawnScene drawn;
  drawn.lights = scene.lights;
  drawn.isosurfaces = make_isosurfaces(mesh, scene, Projector(scene.camera, scene.image));
  const double longest = box_of_nodes(mesh).diagonal();
  drawn.optics = make_optics_tables(scene.volume, Integration::exact,
                                    kThickestMesh / std::max(longest, 1 / kThickestMesh));
  const auto& color = scene.volume.color;
  const auto& extinction = scene.volume.extinction;
  if (extinction || color)
    drawn.extinction = number_of(drawn, extinction ? extinction->field : color->field);
  drawn.color = drawn.optics.same_field ? drawn.extinction : number_of(drawn, color->field);
  add_surfaces(drawn, scene);
  if (drawn.fields.empty()) {  // nothing but a background
    drawn.fields.push_back({.name = "", .location = FieldLocation::cell, .values = {}});
    drawn.fields[0].values.resize(mesh.cell_count());
    return drawn;
  }
  for (std::size_t f = 0; f < drawn.fields.size(); ++f) {
    const Field field = scalar_field(mesh, drawn.fields[f].name);
    FiniteRange marks;
    if (f == drawn.extinction)
      for (const double b : drawn.optics.extinction_function.breakpoints()) marks.include(b);
    if (f == drawn.color)
      for (const double b : drawn.optics.color_function.breakpoints()) marks.include(b);
    for (const SurfaceField& of_field : drawn.surface_fields)
      for (const std::size_t s : of_field.surfaces)
        if (of_field.field == f) marks.include(scene.isosurfaces[s].value);
    drawn.fields[f].location = field.location;
    scale(drawn.fields[f], field.values.view(), marks);
  }
  drawn.surface_values.resize(scene.isosurfaces.size());
  for (const SurfaceField& of_field : drawn.surface_fields)
    for (const std::size_t s : of_field.surfaces)
      drawn.surface_values[s] = drawn.fields[of_field.field].scaled(scene.isosurfaces[s].value);
  return drawn;
}

}  // namespace hiac::preview

#include "hiac/frame/frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>

#include "hiac/base/parallel.hpp"
#include "hiac/frame/tolerance_shares.hpp"

namespace hiac {
namespace {

// The largest optical depth of the longest ray in the mesh. Extinction is limited accordingly; an
// opaque region then begins up to 1e-15 of the mesh's depth later.
constexpr double kThickestMesh = 1e30;

// Segments may begin this much before the end of the segment in front, relative to the depth of the
// mesh: faces computed in different ways differ by rounding.
constexpr double kWitnessTolerance = 1e-9;

double depth_of_mesh(const ZooMesh& mesh, const Projector& projector) {
  if (mesh.node_count() == 0) return 0;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::mutex joining;
  parallel_for(mesh.node_count(), std::size_t{1} << 14, [&](IndexRange range) {
    double near = std::numeric_limits<double>::infinity(), far = -near;
    for (std::size_t node = range.begin; node < range.end; ++node) {
      const double t = projector.parameter(mesh.position(static_cast<NodeId>(node)));
      near = std::min(near, t);
      far = std::max(far, t);
    }
    const std::scoped_lock lock(joining);
    least = std::min(least, near);
    most = std::max(most, far);
  });
  return most - least;
}

template <std::size_t N>
FrameField frame_field(const ZooMesh& mesh, const std::string& name, const TransferTable<N>& table,
                       bool polynomial) {
  Field field = scalar_field(mesh, name);
  FrameField result{{field.values, field.location, polynomial}, {}};
  result.intervals = classify_values(result.values.view(), table);
  return result;
}

double largest_magnitude(const FrameField& field) {
  const auto values = field.values.view();
  double largest = 0;
  std::mutex mutex;
  parallel_for(values.size(), std::size_t{1} << 16, [&](IndexRange range) {
    double here = 0;
    for (std::size_t i = range.begin; i < range.end; ++i)
      here = std::max(here, std::abs(values[i]));
    const std::lock_guard lock(mutex);
    largest = std::max(largest, here);
  });
  return largest;
}

FrameField zero_field(const ZooMesh& mesh) {
  FrameField zero{{std::vector<double>(mesh.cell_count(), 0.0), FieldLocation::cell, false}, {}};
  zero.intervals.assign(mesh.cell_count(), {0, 0});
  return zero;
}

}  // namespace

Frame::Frame(const ZooMesh& of_mesh, const Scene& scene, const Projector& of_scene, Details details)
    : mesh(of_mesh),
      projector(of_scene),
      nodes(project_nodes(mesh, projector)),
      kernel_cells(hiac::kernel_cells(mesh, nodes, scene.render.planarity)),
      isosurfaces(make_isosurfaces(mesh, scene, projector)),
      skin(make_skin(mesh, scene, projector)),
      with_details(details != Details::none),
      with_error(details == Details::bounded),
      depth(depth_of_mesh(mesh, projector)),
      tolerance(scene.render.tolerance),
      straightness(scene.render.planarity) {
  witness_tolerance = kWitnessTolerance * depth;
  const double longest =
      depth * std::max(projector.ray_scale(0, 0), projector.ray_scale(scene.image.width, 0));
  // of a mesh of depth 0 only surfaces are visible
  const double most_extinction = kThickestMesh / std::max(longest, 1 / kThickestMesh);
  optics = make_optics_tables(scene.volume, scene.render.integration, most_extinction);
  const bool polynomial = scene.render.interpolation == Interpolation::polynomial;
  const auto& of_color = scene.volume.color;
  const auto& of_extinction = scene.volume.extinction;
  if (of_extinction)
    extinction = frame_field(mesh, of_extinction->field, optics.extinction, polynomial);
  else if (of_color)
    extinction = frame_field(mesh, of_color->field, optics.extinction, polynomial);
  else
    extinction = zero_field(mesh);
  if (!optics.same_field) color = frame_field(mesh, of_color->field, optics.color, polynomial);
  optics.steep =
      is_steep(optics, largest_magnitude(color_field()), largest_magnitude(extinction), longest);
  // What lies behind a transparency T adds at most T times the largest light to a pixel and T to
  // its alpha, and hides T times the background. With emission, rays are not terminated early:
  // light grows with a ray's length.
  double of_surfaces = std::max(isosurfaces.largest_light, skin.largest_light);
  if (scene.edges) of_surfaces = std::max(of_surfaces, std::ranges::max(scene.edges->color));
  largest_light = std::max(optics.largest_color, of_surfaces);
  if (optics.emission) largest_light = optics.largest_color * longest + of_surfaces;
  const double behind =
      std::max(std::ranges::max(scene.background.color), std::ranges::max(scene.background.color2));
  least_transparency =
      optics.emission ? 0
                      : kEndShare * scene.render.tolerance / std::max({1.0, largest_light, behind});
}

}  // namespace hiac

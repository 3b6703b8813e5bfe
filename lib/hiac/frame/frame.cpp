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

// Optical depth of the longest ray in the mesh, with the largest extinction of all: where a
// function would be above that it is not, and what is drawn as opaque begins 1e-15 of the mesh's
// depth later.
constexpr double kThickestMesh = 1e30;

// Segments may begin this much before the one in front of them ended, relative to the depth of the
// mesh: faces computed by different routes differ by rounding.
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

Frame make_frame(const ZooMesh& mesh, const Scene& scene, const Projector& projector) {
  const double depth = depth_of_mesh(mesh, projector);
  const double longest =
      depth * std::max(projector.ray_scale(0, 0), projector.ray_scale(scene.image.width, 0));
  // of a mesh without depth nothing is seen but surfaces
  const double most_extinction = kThickestMesh / std::max(longest, 1 / kThickestMesh);
  Frame frame{.mesh = mesh,
              .projector = projector,
              .nodes = project_nodes(mesh, projector),
              .kernel_cells = {},
              .optics = make_optics_tables(scene.volume, scene.render.integration, most_extinction),
              .color = {},
              .extinction = {},
              .isosurfaces = make_isosurfaces(mesh, scene, projector),
              .splatted_cells = {}};
  frame.kernel_cells = kernel_cells(mesh, frame.nodes, scene.render.planarity);
  const bool polynomial = scene.render.interpolation == Interpolation::polynomial;
  const auto& color = scene.volume.color;
  const auto& extinction = scene.volume.extinction;
  if (extinction)
    frame.extinction = frame_field(mesh, extinction->field, frame.optics.extinction, polynomial);
  else if (color)
    frame.extinction = frame_field(mesh, color->field, frame.optics.extinction, polynomial);
  else
    frame.extinction = zero_field(mesh);
  if (!frame.optics.same_field)
    frame.color = frame_field(mesh, color->field, frame.optics.color, polynomial);
  frame.tolerance = scene.render.tolerance;
  frame.straightness = scene.render.planarity;
  frame.depth = depth;
  frame.optics.steep = is_steep(frame.optics, largest_magnitude(frame.color_field()),
                                largest_magnitude(frame.extinction), longest);
  frame.witness_tolerance = kWitnessTolerance * frame.depth;
  // What lies behind a transparency T adds at most T times the largest light to a pixel and T to
  // its alpha, and hides T times the background. With emission rays are not ended: light grows with
  // a ray's length.
  frame.largest_light = std::max(frame.optics.largest_color, frame.isosurfaces.largest_light);
  if (frame.optics.emission)
    frame.largest_light = frame.optics.largest_color * longest + frame.isosurfaces.largest_light;
  const double behind =
      std::max(std::ranges::max(scene.background.color), std::ranges::max(scene.background.color2));
  frame.least_transparency =
      frame.optics.emission
          ? 0
          : kEndShare * scene.render.tolerance / std::max({1.0, frame.largest_light, behind});
  return frame;
}

}  // namespace hiac

#include "hiac/frame/frame_constants.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

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

void add_nodes(const Frame& frame, MeshExtremes& extremes) {
  std::mutex joining;
  parallel_for(frame.mesh.node_count(), std::size_t{1} << 14, [&](IndexRange range) {
    MeshExtremes here;
    for (std::size_t node = range.begin; node < range.end; ++node) {
      const double t = frame.projector.parameter(frame.mesh.position(static_cast<NodeId>(node)));
      here.nearest = std::min(here.nearest, t);
      here.farthest = std::max(here.farthest, t);
    }
    const std::scoped_lock lock(joining);
    extremes.add(here);
  });
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

}  // namespace

void MeshExtremes::add(const MeshExtremes& other) {
  nearest = std::min(nearest, other.nearest);
  farthest = std::max(farthest, other.farthest);
  largest_color = std::max(largest_color, other.largest_color);
  largest_extinction = std::max(largest_extinction, other.largest_extinction);
}

MeshExtremes extremes_of(const Frame& frame) {
  MeshExtremes extremes;
  add_nodes(frame, extremes);
  extremes.largest_extinction = largest_magnitude(frame.extinction);
  extremes.largest_color =
      frame.optics.same_field ? extremes.largest_extinction : largest_magnitude(frame.color);
  return extremes;
}

void set_constants(Frame& frame, const Scene& scene, const MeshExtremes& extremes) {
  frame.depth = extremes.depth();
  frame.witness_tolerance = kWitnessTolerance * frame.depth;
  double slant = 1;  // the largest ray_scale of all rays
  for (const double x : {0.0, static_cast<double>(scene.image.width)})
    for (const double y : {0.0, static_cast<double>(scene.image.height)})
      slant = std::max(slant, frame.projector.ray_scale(x, y));
  const double longest = frame.depth * slant;
  // of a mesh of depth 0 only surfaces are visible
  const double most_extinction = kThickestMesh / std::max(longest, 1 / kThickestMesh);
  frame.optics = make_optics_tables(scene.volume, scene.render.integration, most_extinction);
  OpticsTables& optics = frame.optics;
  if (scene.volume.extinction || scene.volume.color)
    frame.extinction.intervals = classify_values(frame.extinction.values.view(), optics.extinction);
  else
    frame.extinction.intervals.assign(frame.mesh.cell_count(), {0, 0});
  if (!optics.same_field)
    frame.color.intervals = classify_values(frame.color.values.view(), optics.color);
  optics.steep = is_steep(optics, extremes.largest_color, extremes.largest_extinction, longest);
  // What lies behind a transparency T adds at most T times the largest light to a pixel and T to
  // its alpha, and hides T times the background. With emission, rays are not terminated early:
  // light grows with a ray's length.
  double of_surfaces = std::max(frame.isosurfaces.largest_light, frame.skin.largest_light);
  if (scene.edges) of_surfaces = std::max(of_surfaces, std::ranges::max(scene.edges->color));
  frame.largest_light = std::max(optics.largest_color, of_surfaces);
  if (optics.emission) frame.largest_light = optics.largest_color * longest + of_surfaces;
  const double behind =
      std::max(std::ranges::max(scene.background.color), std::ranges::max(scene.background.color2));
  frame.least_transparency = optics.emission ? 0
                                             : kEndShare * scene.render.tolerance /
                                                   std::max({1.0, frame.largest_light, behind});
}

}  // namespace hiac

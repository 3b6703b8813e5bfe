#include "hiac/preview/methods/region_filler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>

#include "hiac/base/parallel.hpp"
#include "hiac/preview/methods/cell_triangles.hpp"

namespace hiac::preview {
namespace {

// Cells a thread takes at a time.
constexpr std::size_t kRegionFillerGrain = 512;
// Coordinates beyond which cells are clipped at the picture's border, pixels: floats know others to
// a thousandth of a pixel.
constexpr double kReach = 16384;

// How many cells ahead their nodes' numbers, and what is at the nodes, are fetched.
constexpr std::size_t kCellsAhead = 12, kNodesAhead = 6;

// A cell of the mesh is a tetrahedron: its nodes begin at four times its number.
void fetch_cell(const Frame& frame, CellId cell) {
  __builtin_prefetch(&frame.mesh.nodes[std::size_t{4} * cell]);
  __builtin_prefetch(&frame.mesh.elems[cell]);
}

void fetch_nodes(const Frame& frame, CellId cell) {
  for (std::size_t k = 0; k < 4; ++k) {
    const NodeId node = frame.mesh.nodes[std::size_t{4} * cell + k];
    __builtin_prefetch(&frame.nodes[node]);
    if (frame.extinction.location != FieldLocation::node) continue;
    __builtin_prefetch(&frame.extinction.values[node]);
    __builtin_prefetch(&frame.extinction.intervals[node]);
  }
}

double depth_of(const Projector& projector, double t) {
  return projector.perspective() ? -1 / t : t;
}

double reach_of(const Projector& projector) {
  const auto [width, height] = projector.size();
  return std::max(kReach, static_cast<double>(std::max(width, height)));
}

// Parallel projection.
bool lies_within(const Frame& frame) {
  const double reach = reach_of(frame.projector);
  return std::ranges::all_of(frame.nodes, [&](const ProjectedNode& node) {
    return std::max(std::abs(node.x), std::abs(node.y)) <= reach &&
           node.depth >= frame.projector.near() && node.depth <= frame.projector.far();
  });
}

// Whether single precision knows the field of a ray well enough for extinction and colour.
bool knows_field(const Frame& frame) {
  // of optical depths over a whole ray, and of colours
  constexpr double kMostError = 1e-5;
  const auto [least, most] = std::ranges::minmax(frame.extinction.values);
  const auto steepest = [](const std::vector<double>& slopes) {
    double most_of = 0;
    for (const double slope : slopes) most_of = std::max(most_of, std::abs(slope));
    return most_of;
  };
  const OpticsTables& optics = frame.optics;
  double slope = steepest(optics.extinction.slope[0]) * frame.depth;
  for (const auto& channel : optics.color.slope) slope = std::max(slope, steepest(channel));
  return slope * (most - least) * 0x1p-24 <= kMostError;
}

}  // namespace

RecordShape record_shape(const Frame& frame, Method method) {
  const OpticsTables& optics = frame.optics;
  if (frame.projector.perspective())
    return method == Method::interpolated_opacity ? kFlat : kPerspective;
  const bool by_rays = method == Method::mean_color && optics.same_field && !optics.unsliced &&
                       frame.isosurfaces.surfaces.empty() && lies_within(frame) &&
                       knows_field(frame);
  return by_rays ? kChord : kFlat;
}

void RegionCounts::add(const RegionCounts& other) {
  cells += other.cells;
  whole += other.whole;
  slabs += other.slabs;
  regions += other.regions;
  surfaces += other.surfaces;
  vertices += other.vertices;
  reverted += other.reverted;
  uncut += other.uncut;
}

RegionFiller::RegionFiller(const Frame& frame, Method method, RecordShape shape,
                           const PixelRect& part)
    : frame_(frame),
      method_(method),
      part_(part),
      shape_(shape),
      color_(method, frame.optics.emission ? Glow::emission : Glow::chromaticity),
      near_(frame.projector.near()),
      far_(frame.projector.far()),
      width_(frame.projector.size().width),
      height_(frame.projector.size().height),
      reach_(reach_of(frame.projector)) {
  for (const CellKind kind : frame.mesh.kinds.view())
    if (kind != CellKind::tetrahedron4)
      throw std::invalid_argument("homogeneous regions are made of linear tetrahedra alone");
  if (frame.projector.perspective()) near_ = std::max(near_, kNearest * frame.depth);
  near_depth_ = depth_of(frame.projector, near_);
  far_depth_ = depth_of(frame.projector, far_);
}

RegionFiller::~RegionFiller() = default;

void RegionFiller::fill(std::span<const CellId> back_to_front, TriangleBuffer& triangles,
                        RegionCounts& counts) {
  CellTriangles cells(*this, triangles, counts);
  const std::size_t count = back_to_front.size();
  for (std::size_t k = 0; k < count; ++k) {
    // in a visibility order cells and nodes lie anywhere in memory
    if (k + kNodesAhead < count) fetch_nodes(frame_, back_to_front[k + kNodesAhead]);
    if (k + kCellsAhead < count) fetch_cell(frame_, back_to_front[k + kCellsAhead]);
    cells.add(back_to_front[k]);
  }
  cells.finish();
}

void RegionFiller::fill(std::span<const CellId> back_to_front, std::vector<TriangleBuffer>& buffers,
                        RegionCounts& counts) {
  const std::size_t parts = (back_to_front.size() + kRegionFillerGrain - 1) / kRegionFillerGrain;
  while (buffers.size() < parts) buffers.emplace_back(shape_, part_);
  for (TriangleBuffer& buffer : buffers) buffer.clear();
  std::mutex joining;
  parallel_for(back_to_front.size(), kRegionFillerGrain, [&](IndexRange range) {
    RegionCounts here;
    // a range may be several grains long
    for (std::size_t first = range.begin; first < range.end; first += kRegionFillerGrain)
      fill(back_to_front.subspan(first, std::min(kRegionFillerGrain, range.end - first)),
           buffers[first / kRegionFillerGrain], here);
    const std::scoped_lock lock(joining);
    counts.add(here);
  });
}

}  // namespace hiac::preview

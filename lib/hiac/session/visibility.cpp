#include "hiac/session/visibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "hiac/base/parallel.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/geometry/interval.hpp"
#include "hiac/mesh/interpolant_range.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Vec = std::array<double, 3>;

// The values of fields

/// Adds the values that a field's interpolant may have in one cell.
void include_cell(Interval& extent, const ZooMesh& mesh, const Field& field, CellId cell) {
  const auto values = field.values.view();
  if (field.location == FieldLocation::cell) return extent.include(values[cell]);
  const auto nodes = mesh.cell_nodes(cell);
  const auto value_at = [&](std::size_t i) {
    return field.location == FieldLocation::node ? values[nodes[i]] : values[mesh.elems[cell] + i];
  };
  if (order_of(mesh.kinds[cell]) == CellOrder::linear) {  // it has its extremes at nodes
    for (std::size_t i = 0; i < nodes.size(); ++i) extent.include(value_at(i));
    return;
  }
  std::array<double, kMaxNodesPerCell> at;
  for (std::size_t i = 0; i < nodes.size(); ++i) at[i] = value_at(i);
  const ValueRange range = interpolant_range(mesh.kinds[cell], std::span(at).first(nodes.size()));
  extent.include(Interval{range.least, range.most});
}

/// Bounds of the values that a field has in the mesh, between nodes too.
Interval extent_in_mesh(const ZooMesh& mesh, const Field& field) {
  constexpr std::size_t kGrain = 4096;
  std::vector<Interval> parts((mesh.cell_count() + kGrain - 1) / kGrain);
  parallel_for(mesh.cell_count(), kGrain, [&](IndexRange cells) {
    Interval& part = parts[cells.begin / kGrain];
    for (std::size_t cell = cells.begin; cell < cells.end; ++cell)
      include_cell(part, mesh, field, static_cast<CellId>(cell));
  });
  Interval whole;
  for (const Interval& part : parts) whole.include(part);
  return whole;
}

/// Bounds of the values of fields as a scene draws them; each field is looked through once.
class Extents {
 public:
  Extents(const ZooMesh& mesh, Interpolation interpolation)
      : mesh_(mesh), interpolation_(interpolation) {}

  const Interval& of(const std::string& field) {
    const auto [known, is_new] = known_.try_emplace(field);
    Interval& extent = known->second;
    if (!is_new) return extent;
    extent = extent_in_mesh(mesh_, scalar_field(mesh_, field));
    // polynomials in world coordinates overshoot in their own ways: no bounds of theirs are known
    // here
    if (interpolation_ == Interpolation::polynomial) extent.widen(extent.high - extent.low);
    return extent;
  }

 private:
  const ZooMesh& mesh_;
  Interpolation interpolation_;
  std::map<std::string, Interval> known_;
};

std::string text_of(const Interval& extent) {
  return fmt::format("from {:g} to {:g}", extent.low, extent.high);
}

// Transfer functions

template <std::size_t N>
bool varies(const TransferFunction<N>& transfer) {
  return std::ranges::any_of(transfer.points, [&](const auto& point) {
    return point.value != transfer.points.front().value;
  });
}

/// The line on a function that is constant where its field has values; none where it is not.
template <std::size_t N>
std::optional<std::string> missed(const std::string& key, const TransferFunction<N>& transfer,
                                  const Interval& extent) {
  const Interval points{transfer.points.front().scalar, transfer.points.back().scalar};
  const bool meets = extent.high >= points.low && extent.low <= points.high;
  if (meets || extent.empty() || !varies(transfer)) return std::nullopt;
  return fmt::format(
      "{0}: the points go {1}, the values of '{2}' {3}: they do not meet, and everything has one "
      "value ({0}.range = \"auto\" with points on 0 to 1 follows the field)",
      key, text_of(points), transfer.field, text_of(extent));
}

/// The largest extinction over values of the field: at an end, or at a point between.
double largest_over(const ExtinctionTransfer& transfer, const Interval& extent) {
  const auto function = transfer.function();
  double largest = std::max(function(extent.low)[0], function(extent.high)[0]);
  for (const auto& point : transfer.points)
    if (point.scalar >= extent.low && point.scalar <= extent.high)
      largest = std::max(largest, point.value[0]);
  return largest;
}

bool glows_alone(const Volume& volume) {
  if (volume.glow != Glow::emission || !volume.color) return false;
  return std::ranges::any_of(volume.color->points,
                             [](const auto& point) { return point.value != Color{}; });
}

bool draws_boundary(const Scene& scene) { return scene.skin || scene.edges; }

void look_at_volume(Extents& extents, const Scene& scene, std::vector<std::string>& found) {
  const Volume& volume = scene.volume;
  if (volume.color) {
    const Interval& extent = extents.of(volume.color->field);
    if (const auto line = missed("volume.color", *volume.color, extent)) found.push_back(*line);
  }
  if (!volume.extinction) {
    if (scene.isosurfaces.empty() && !draws_boundary(scene) && !glows_alone(volume))
      found.emplace_back(
          "nothing is drawn: there is neither extinction nor a surface (add [volume.extinction], "
          "an [[isosurface]], a [skin] or [edges])");
    return;
  }
  const ExtinctionTransfer& extinction = *volume.extinction;
  const Interval& extent = extents.of(extinction.field);
  if (extent.empty()) return;
  const auto line = missed("volume.extinction", extinction, extent);
  if (line) found.push_back(*line);
  const bool seen = largest_over(extinction, extent) > 0 || glows_alone(volume);
  if (!seen && !line && scene.isosurfaces.empty() && !scene.skin)
    found.push_back(fmt::format(
        "volume.extinction: zero for all values of '{}' ({}): the medium is not seen (points with "
        "an extinction above 0 there make it visible)",
        extinction.field, text_of(extent)));
}

void look_at_surfaces(Extents& extents, const Scene& scene, std::vector<std::string>& found) {
  for (std::size_t i = 0; i < scene.isosurfaces.size(); ++i) {
    const Isosurface& surface = scene.isosurfaces[i];
    const Interval& extent = extents.of(surface.field);
    if (extent.empty()) continue;
    if (surface.value < extent.low || surface.value > extent.high)
      found.push_back(
          fmt::format("isosurface.{}: '{}' has values {}, never {:g}: there is no such surface "
                      "(isosurface.{}.value = {:g} lies in the middle)",
                      i, surface.field, text_of(extent), surface.value, i,
                      0.5 * extent.low + 0.5 * extent.high));
  }
}

void look_at_skin(Extents& extents, const Scene& scene, std::vector<std::string>& found) {
  if (!scene.skin || !scene.skin->color_by) return;
  const ColorTransfer& color = *scene.skin->color_by;
  if (const auto line = missed("skin.color", color, extents.of(color.field)))
    found.push_back(*line);
}

// The camera

/// Where the mesh is, seen from the eye.
struct Sight {
  double nearest = kInfinity, farthest = -kInfinity;  ///< along the view direction
  Vec low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
};

Sight sight_of(const ZooMesh& mesh, const Camera& camera) {
  const Vec direction = view_direction(camera);
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  Sight sight;
  for (const NodeId node : mesh.nodes) {
    const auto p = mesh.position(node);
    double depth = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      depth += (p[a] - camera.eye[a]) * (direction[a] / length);
      sight.low[a] = std::min(sight.low[a], p[a]);
      sight.high[a] = std::max(sight.high[a], p[a]);
    }
    sight.nearest = std::min(sight.nearest, depth);
    sight.farthest = std::max(sight.farthest, depth);
  }
  return sight;
}

std::string why_no_pixel(const ZooMesh& mesh, const Scene& scene, bool is_part) {
  if (mesh.cell_count() == 0) return "no cell is seen: the mesh has none";
  const Camera& camera = scene.camera;
  const Sight sight = sight_of(mesh, camera);
  std::array<std::string, 3> middle;
  for (std::size_t a = 0; a < 3; ++a)
    middle[a] = fmt::format("{:g}", 0.5 * sight.low[a] + 0.5 * sight.high[a]);
  const std::string look =
      fmt::format("camera.look_at = [{}] looks at the middle of the mesh", fmt::join(middle, ", "));
  if (camera.projection == Projection::perspective && sight.farthest <= 0)
    return fmt::format(
        "no cell is seen: the camera looks away, all of the mesh is behind the eye "
        "({})",
        look);
  if (camera.clip && (sight.farthest < (*camera.clip)[0] || sight.nearest > (*camera.clip)[1]))
    return fmt::format(
        "no cell is seen: camera.clip = [{:g}, {:g}] misses the mesh, which lies {:g} to {:g} from "
        "the eye along the view direction",
        (*camera.clip)[0], (*camera.clip)[1], sight.nearest, sight.farthest);
  if (is_part) return "no cell is seen in this part of the picture (another part shows some)";
  return fmt::format(
      "no cell is seen: the camera looks past the mesh, or from so far that it is "
      "smaller than a pixel ({})",
      look);
}

/// Half a step of an 8-bit channel: what is more transparent changes no pixel.
constexpr double kInvisible = 0.5 / 255;

}  // namespace

std::vector<std::string> invisible_parts(const ZooMesh& mesh, const Scene& scene) {
  std::vector<std::string> found;
  if (mesh.cell_count() == 0) return found;
  Extents extents(mesh, scene.render.interpolation);
  look_at_volume(extents, scene, found);
  look_at_surfaces(extents, scene, found);
  look_at_skin(extents, scene, found);
  return found;
}

std::optional<std::string> reason_of_empty(const ZooMesh& mesh, const Scene& scene,
                                           const DrawnFacts& drawn) {
  if (drawn.covered_pixels == 0) return why_no_pixel(mesh, scene, drawn.is_part);
  const bool medium_alone = scene.volume.extinction && scene.isosurfaces.empty() && !scene.skin;
  const double opacity = -std::expm1(-drawn.largest_optical_depth);
  if (!medium_alone || glows_alone(scene.volume) || opacity >= kInvisible || opacity <= 0)
    return std::nullopt;
  return fmt::format(
      "the medium is too thin to be seen: its optical depth is at most {:.2g} (extinctions {:.2g} "
      "times as large reach 1)",
      drawn.largest_optical_depth, 1 / drawn.largest_optical_depth);
}

}  // namespace hiac

#include "hiac/preview/methods/cell_triangles.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/geometry/vector.hpp"
#include "hiac/preview/methods/lit_surface.hpp"
#include "hiac/preview/methods/transfer_pieces.hpp"

namespace hiac::preview {
namespace {

// Clipped cells keep this much beside the picture, pixels.
constexpr double kMargin = 16;
// |n.v| of isosurfaces seen edge-on, whose polygons have no area.
constexpr double kLeastFacing = 1e-6;
// The number of a tetrahedron's face opposite a corner (topology_of).
constexpr std::array<unsigned, 4> kOppositeFace{1, 2, 0, 3};

// The corner around which a region is cut into triangles: where the slab is thickest, as in Shirley
// and Tuchman's tetrahedra. It is as thick along a whole side where that is an edge of the slab in
// one plane of its field and over the other plane; of such corners the leftmost is taken.
std::size_t thickest_corner(std::span<const RayThrough> rays,
                            std::span<const std::uint32_t> corners) {
  constexpr double kAsThick = 1 - 1e-6;
  const auto thickness = [&](std::uint32_t corner) {
    return rays[corner].back.depth - rays[corner].front.depth;
  };
  double most = 0;
  for (const std::uint32_t corner : corners) most = std::max(most, thickness(corner));
  std::size_t best = corners.size();
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (thickness(corners[k]) >= kAsThick * most &&
        (best == corners.size() || rays[corners[k]].at.x < rays[corners[best]].at.x))
      best = k;
  return best % corners.size();
}

}  // namespace

CellTriangles::CellTriangles(const RegionFiller& filler, TriangleBuffer& triangles,
                             RegionCounts& counts)
    : filler_(filler),
      frame_(filler.frame_),
      triangles_(triangles),
      counts_(counts),
      perspective_(frame_.projector.perspective()) {}

void CellTriangles::add(CellId id) {
  Cell cell;
  if (!gather(id, cell)) return;
  ++counts_.cells;
  if (filler_.shape_ == kChord) {
    add_chords(cell);
    return;
  }
  if (cell.unclipped && frame_.isosurfaces.in(id).empty() && add_whole(cell)) return;
  add_sliced(cell);
}

// False when the cell lies beside the part.
bool CellTriangles::gather(CellId id, Cell& cell) const {
  const std::uint64_t entry = frame_.mesh.elems[id];
  const PixelRect& part = filler_.part_;
  double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
  double nearest = INFINITY, farthest = -INFINITY;
  bool projected = true;
  cell.id = id;
  for (std::size_t k = 0; k < 4; ++k) {
    const NodeId node = cell.nodes[k] = frame_.mesh.nodes[entry + k];
    const ProjectedNode& at = frame_.nodes[node];
    cell.points[k] = {at.x, at.y};
    cell.depths[k] = at.depth;
    projected &= !std::isnan(at.depth);
    left = std::min(left, at.x);
    right = std::max(right, at.x);
    top = std::min(top, at.y);
    bottom = std::max(bottom, at.y);
    nearest = std::min(nearest, at.depth);
    farthest = std::max(farthest, at.depth);
    const FrameField &extinction = frame_.extinction, &color = frame_.color_field();
    cell.extinction[k] = extinction.values[extinction.index(id, entry + k, node)];
    cell.color[k] = color.values[color.index(id, entry + k, node)];
  }
  if (!projected) {
    cell.unclipped = false;
    return true;
  }
  if (right < part.x - 1.0 || left > part.x + part.width + 1.0 || bottom < part.y - 1.0 ||
      top > part.y + part.height + 1.0 || nearest > filler_.far_depth_ ||
      farthest < filler_.near_depth_)
    return false;
  cell.unclipped = nearest >= filler_.near_depth_ && farthest <= filler_.far_depth_ &&
                   left >= -filler_.reach_ && right <= filler_.reach_ && top >= -filler_.reach_ &&
                   bottom <= filler_.reach_;
  return true;
}

CellTriangles::Attributes CellTriangles::attributes(double depth, double tau,
                                                    const std::array<double, 3>& color) const {
  const double w = perspective_ ? -depth : 1;
  return {w, std::max(tau, 0.0) * w, {color[0] * w, color[1] * w, color[2] * w}};
}

// A tetrahedron in which the transfer functions do not bend; false where they do.
bool CellTriangles::add_whole(const Cell& cell) {
  const OpticsTables& optics = frame_.optics;
  const std::uint64_t entry = frame_.mesh.elems[cell.id];
  std::array<Attributes, 4> corners;
  if (optics.unsliced) {
    for (std::size_t k = 0; k < 4; ++k)
      corners[k] = attributes(cell.depths[k], optics.extinction_function(cell.extinction[k])[0],
                              optics.color_function(cell.color[k]));
  } else {
    const IntervalRange tau = common_intervals(frame_.extinction, cell.id, entry, cell.nodes);
    if (tau.least > tau.most) return false;
    const IntervalRange color =
        optics.same_field ? tau : common_intervals(frame_.color, cell.id, entry, cell.nodes);
    if (color.least > color.most) return false;
    if (optics.no_extinction[tau.most] != 0 &&
        (!optics.emission || optics.no_color[color.most] != 0))
      return true;
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<double, 3> rgb;
      for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = channel(optics.color, c, color.most, cell.color[k]);
      corners[k] = attributes(cell.depths[k],
                              channel(optics.extinction, 0, tau.most, cell.extinction[k]), rgb);
    }
  }
  ++counts_.whole;
  add_tetrahedron(cell.points, cell.depths, corners);
  return true;
}

// ---- slabs ----

bool CellTriangles::make_polyhedron(const Cell& cell) {
  polyhedron_.clear();
  for (std::size_t k = 0; k < 4; ++k) {
    camera_[k] = frame_.projector.camera_coordinates(frame_.mesh.position(cell.nodes[k]));
    polyhedron_.camera.push_back(camera_[k]);
    polyhedron_.shares.push_back({});
    polyhedron_.shares.back()[k] = 1;
    polyhedron_.points.push_back(cell.points[k]);
    polyhedron_.depths.push_back(cell.depths[k]);
  }
  polyhedron_.corners = {0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 2, 1};
  polyhedron_.first = {0, 3, 6, 9, 12};
  if (!cell.unclipped) clip_all();
  return polyhedron_.size() > 0;
}

// Keeps what is in front of a plane, or on it.
void CellTriangles::clip(const std::array<double, 4>& plane) {
  plane_values_.clear();
  for (const auto& p : polyhedron_.camera)
    plane_values_.push_back(plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3]);
  if (!cutter_.cut(polyhedron_, plane_values_, 0, below_, above_)) ++counts_.uncut;
  std::swap(polyhedron_, above_);
}

void CellTriangles::clip_all() {
  const Projector& projector = frame_.projector;
  if (std::isfinite(filler_.near_)) clip({0, 0, 1, -filler_.near_});
  if (std::isfinite(filler_.far_)) clip({0, 0, -1, filler_.far_});
  const auto axes = projector.axes();
  const double s = projector.pixels_per_unit();
  const double left = axes.center_x + kMargin, right = filler_.width_ + kMargin - axes.center_x;
  const double top = axes.center_y + kMargin, bottom = filler_.height_ + kMargin - axes.center_y;
  const auto side = [&](double x, double y, double pixels) {
    clip(perspective_ ? std::array<double, 4>{x, y, pixels, 0}
                      : std::array<double, 4>{x, y, 0, pixels});
  };
  side(s, 0, left);
  side(-s, 0, right);
  side(0, -s, top);
  side(0, s, bottom);
}

void CellTriangles::project(Polyhedron& polyhedron) const {
  const auto axes = frame_.projector.axes();
  const double s = frame_.projector.pixels_per_unit();
  for (std::size_t v = 0; v < polyhedron.size(); ++v) {
    if (!std::isnan(polyhedron.depths[v])) continue;
    const auto& [x, y, t] = polyhedron.camera[v];
    const double scale = perspective_ ? s / t : s;
    polyhedron.points[v] = {axes.center_x + scale * x, axes.center_y - scale * y};
    polyhedron.depths[v] = perspective_ ? -1 / t : t;
  }
}

void CellTriangles::add_breakpoints(const std::array<double, 4>& values,
                                    std::span<const double> upper, std::size_t least_interval) {
  PlaneFamily family{values, {}};
  const double most = std::ranges::max(values);
  for (std::size_t k = least_interval; k + 1 < upper.size() && upper[k] < most; ++k)
    family.levels.push_back(upper[k]);
  families_.push_back(std::move(family));
}

// Of isosurfaces, a family a field; then of the extinction and, where it has a field of its own,
// the colour.
void CellTriangles::find_families(const Cell& cell) {
  const Isosurfaces& all = frame_.isosurfaces;
  const std::uint64_t entry = frame_.mesh.elems[cell.id];
  families_.clear();
  surfaces_.clear();
  std::vector<std::size_t> fields;
  for (const IsosurfaceCut& cut : all.in(cell.id)) {
    const FrameIsosurface& surface = all.surfaces[cut.surface];
    std::size_t f = 0;
    while (f < fields.size() && fields[f] != surface.field) ++f;
    if (f == fields.size()) {
      const FrameField& field = all.fields[surface.field];
      PlaneFamily family;
      for (std::size_t k = 0; k < 4; ++k)
        family.values[k] = field.values[field.index(cell.id, entry + k, cell.nodes[k])];
      fields.push_back(surface.field);
      families_.push_back(family);
      surfaces_.emplace_back();
    }
    // on the largest value: the face opposite the one corner below, unless that is closed
    PlaneFamily& family = families_[f];
    const auto most = std::ranges::max_element(family.values);
    if (surface.value == *most) {
      const auto apex = std::ranges::min_element(family.values) - family.values.begin();
      if (std::ranges::count(family.values, *most) != 3 ||
          ((cut.closed_faces >> kOppositeFace[static_cast<std::size_t>(apex)]) & 1U) != 0)
        continue;
    }
    const auto at = std::ranges::lower_bound(family.levels, surface.value);
    const auto level = at - family.levels.begin();
    if (at == family.levels.end() || *at != surface.value) {
      family.levels.insert(at, surface.value);
      surfaces_[f].insert(surfaces_[f].begin() + level, std::vector<std::uint32_t>{});
    }
    surfaces_[f][static_cast<std::size_t>(level)].push_back(cut.surface);
  }
  const OpticsTables& optics = frame_.optics;
  const auto interval = [](const std::array<double, 4>& values, const auto& table) {
    return classify_value(std::ranges::min(values), table).high;
  };
  extinction_interval_ = interval(cell.extinction, optics.extinction);
  color_interval_ = optics.same_field ? extinction_interval_ : interval(cell.color, optics.color);
  const std::size_t none = optics.extinction.upper.size() + optics.color.upper.size();
  add_breakpoints(cell.extinction, optics.extinction.upper,
                  optics.unsliced ? none : extinction_interval_);
  if (!optics.same_field)
    add_breakpoints(cell.color, optics.color.upper, optics.unsliced ? none : color_interval_);
}

void CellTriangles::add_sliced(const Cell& cell) {
  if (!make_polyhedron(cell)) return;
  find_families(cell);
  const SlabVisitor visitor{[&](const Polyhedron& slab, std::span<const std::size_t> part) {
                              add_slab(cell, slab, part);
                            },
                            [&](const Polyhedron& owner, std::span<const std::uint16_t> polygon,
                                std::size_t family, std::size_t level) {
                              if (family < surfaces_.size())
                                add_polygon(owner, polygon, family, level);
                            }};
  slicer_.visit(polyhedron_, camera_, perspective_, families_, visitor);
}

void CellTriangles::add_slab(const Cell& cell, const Polyhedron& slab,
                             std::span<const std::size_t> part) {
  const OpticsTables& optics = frame_.optics;
  const std::size_t first = surfaces_.size();
  const std::size_t of_tau = extinction_interval_ + part[first];
  const std::size_t of_color = optics.same_field ? of_tau : color_interval_ + part[first + 1];
  if (!optics.unsliced && optics.no_extinction[of_tau] != 0 &&
      (!optics.emission || optics.no_color[of_color] != 0))
    return;
  ++counts_.slabs;
  slab_ = slab;
  project(slab_);
  vertex_attributes_.clear();
  for (std::size_t v = 0; v < slab_.size(); ++v) {
    double s_tau = 0, s_color = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      s_tau += slab_.shares[v][k] * cell.extinction[k];
      s_color += slab_.shares[v][k] * cell.color[k];
    }
    std::array<double, 3> rgb;
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = channel(optics.color, c, of_color, s_color);
    vertex_attributes_.push_back(
        optics.unsliced
            ? attributes(slab_.depths[v], optics.extinction_function(s_tau)[0],
                         optics.color_function(s_color))
            : attributes(slab_.depths[v], channel(optics.extinction, 0, of_tau, s_tau), rgb));
  }
  if (slab_.size() == 4 && slab_.face_count() == 4)
    add_tetrahedron(std::span(slab_.points).first<4>(), std::span(slab_.depths).first<4>(),
                    std::span(vertex_attributes_).first<4>());
  else
    add_regions(slab_);
}

// ---- isosurfaces ----

void CellTriangles::add_polygon(const Polyhedron& owner, std::span<const std::uint16_t> polygon,
                                std::size_t family, std::size_t level) {
  const Vector gradient = linear_field(camera_, families_[family].values).gradient;
  if (largest(gradient) == 0) return;
  const Vector normal = unit(gradient);
  // at one depth the first of the scene is in front
  const auto& surfaces = surfaces_[family][level];
  for (std::size_t n = surfaces.size(); n-- > 0;) add_surface(owner, polygon, surfaces[n], normal);
}

void CellTriangles::add_surface(const Polyhedron& owner, std::span<const std::uint16_t> polygon,
                                std::uint32_t surface, const Vector& normal) {
  ++counts_.surfaces;
  slab_ = owner;
  project(slab_);
  corners_.clear();
  const Isosurfaces& all = frame_.isosurfaces;
  for (const std::uint16_t v : polygon) {
    const Vector ray = perspective_ ? unit(slab_.camera[v]) : Vector{0, 0, 1};
    const LitSurface lit = lit_surface(all.surfaces[surface], all.lights, normal, ray);
    corners_.push_back(surface_corner(slab_.points[v], lit, dot(normal, ray)));
  }
  for (std::size_t k = 1; k + 1 < corners_.size(); ++k)
    triangles_.add(corners_[0], corners_[k], corners_[k + 1]);
}

// In perspective |n.v| times the length of the ray to t = 1 is affine on the screen: as one of the
// two 1 / t it makes the optical depth, the face-on one over |n.v|, right at each pixel.
TriangleBuffer::Corner CellTriangles::surface_corner(const ScreenPoint& at, const LitSurface& lit,
                                                     double facing) const {
  TriangleBuffer::Corner corner{at.x, at.y, {}};
  const bool emission = frame_.optics.emission;
  double weight = 1;  // of the colour
  if (filler_.method_ == Method::interpolated_opacity) {
    const double alpha = -std::expm1(-lit.optical_depth);
    corner.values[0] = static_cast<float>(alpha);
    if (emission) weight = alpha;
  } else if (filler_.shape_ == kFlat) {
    corner.values = {1, static_cast<float>(lit.optical_depth)};
    if (emission) weight = lit.optical_depth;
  } else {
    const double w =
        std::max(std::abs(facing) * frame_.projector.ray_scale(at.x, at.y), kLeastFacing);
    const auto depth = static_cast<float>(lit.face_on_depth);
    corner.values = {1, static_cast<float>(w), 1, 0, 2 * depth};
    weight = (w + 1) / 2 * (emission ? lit.face_on_depth : 1);
  }
  for (std::size_t c = 0; c < 3; ++c)
    corner.values[filler_.shape_.values - 3 + c] = static_cast<float>(weight * lit.color[c]);
  return corner;
}

// ---- regions ----

void CellTriangles::add_tetrahedron(std::span<const ScreenPoint, 4> points,
                                    std::span<const double, 4> depths,
                                    std::span<const Attributes, 4> corners) {
  const ProjectedTetrahedron shape = project_tetrahedron(points, depths);
  if (shape.count == 0) return;
  counts_.regions += shape.count;
  Attributes front{}, back{};
  for (std::size_t k = 0; k < 4; ++k) {
    const Attributes& c = corners[k];
    front.w += shape.front[k] * c.w;
    back.w += shape.back[k] * c.w;
    front.tau_w += shape.front[k] * c.tau_w;
    back.tau_w += shape.back[k] * c.tau_w;
    for (std::size_t i = 0; i < 3; ++i) {
      front.color_w[i] += shape.front[k] * c.color_w[i];
      back.color_w[i] += shape.back[k] * c.color_w[i];
    }
  }
  const TriangleBuffer::Corner thick =
      corner(shape.at, front, back, shape.back_depth - shape.front_depth);
  std::array<TriangleBuffer::Corner, 4> rim;
  for (std::size_t k = 0; k < 4; ++k) rim[k] = corner(points[k], corners[k], corners[k], 0);
  for (unsigned n = 0; n < shape.outlines; ++n) {
    const auto [a, b, c] = shape.outline[n];
    triangles_.add(rim[a], rim[b], rim[c], thick);
  }
}

CellTriangles::Attributes CellTriangles::mean(std::span<const Attributes> corners,
                                              const SurfacePoint& point) {
  Attributes result{};
  for (std::size_t n = 0; n < 3; ++n) {
    const Attributes& c = corners[point.vertices[n]];
    const double weight = point.weights[n];
    result.w += weight * c.w;
    result.tau_w += weight * c.tau_w;
    for (std::size_t i = 0; i < 3; ++i) result.color_w[i] += weight * c.color_w[i];
  }
  return result;
}

void CellTriangles::add_regions(const Polyhedron& slab) {
  edges_of(slab, edges_);
  subdivision_.build(slab.points, edges_);
  sheets_.find(slab, edges_, subdivision_, rays_);
  corners_.clear();
  for (const RayThrough& ray : rays_)
    corners_.push_back(corner(ray.at, mean(vertex_attributes_, ray.front),
                              mean(vertex_attributes_, ray.back),
                              ray.back.depth - ray.front.depth));
  for (const Subdivision::Region& region : subdivision_.regions()) {
    ++counts_.regions;
    const auto polygon = subdivision_.corners().subspan(region.first, region.count);
    const std::size_t thickest = thickest_corner(rays_, polygon);
    const auto at = [&](std::size_t k) -> const TriangleBuffer::Corner& {
      return corners_[polygon[(thickest + k) % polygon.size()]];
    };
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) triangles_.add(at(0), at(k), at(k + 1));
  }
}

TriangleBuffer::Corner CellTriangles::corner(const ScreenPoint& at, const Attributes& front,
                                             const Attributes& back, double thickness) {
  const double scale = perspective_ ? frame_.projector.ray_scale(at.x, at.y) : 1;
  const double length = std::max(thickness, 0.0) * scale / (front.w * back.w);
  const auto end = [](const Attributes& a) {
    const double t = 1 / a.w;
    return RayEnd{a.tau_w * t, {a.color_w[0] * t, a.color_w[1] * t, a.color_w[2] * t}};
  };
  const RayEnd first = end(front), last = end(back);
  std::array<double, 3> color = first.color;
  if (&front != &back) {
    bool reverted = false;
    color = filler_.color_.at(length, first, last, reverted);
    ++counts_.vertices;
    counts_.reverted += reverted ? 1 : 0;
  }
  TriangleBuffer::Corner corner{at.x, at.y, {}};
  const double tau = (first.tau + last.tau) / 2;
  double weight = 1;
  if (filler_.method_ == Method::interpolated_opacity) {
    corner.values[0] = static_cast<float>(-std::expm1(-length * tau));
    if (frame_.optics.emission) weight = length * opacity_ratio(length * tau);
  } else if (!perspective_) {
    corner.values = {static_cast<float>(length), static_cast<float>(tau)};
  } else {
    corner.values = {static_cast<float>(std::max(thickness, 0.0)), static_cast<float>(front.w),
                     static_cast<float>(back.w), static_cast<float>(front.tau_w),
                     static_cast<float>(back.tau_w)};
    weight = (front.w + back.w) / 2;
  }
  for (std::size_t c = 0; c < 3; ++c)
    corner.values[filler_.shape_.values - 3 + c] = static_cast<float>(weight * color[c]);
  return corner;
}

}  // namespace hiac::preview

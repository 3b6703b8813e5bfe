#include "hiac/render/splatting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "hiac/base/gauss_legendre.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/element/cell_field.hpp"
#include "hiac/element/cell_surface.hpp"
#include "hiac/frame/screen_rounding.hpp"
#include "hiac/geometry/inverse_map.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/optics/linear_piece.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/quadratic_bspline.hpp"

namespace hiac {
namespace {

// Pixel centres farther than this from the picture's first are not counted: farther away, projected
// coordinates lose too many digits, and parallel views are unbounded.
constexpr int kFarthestCount = 262144;

// An upper bound of how far left of an edge a pixel centre may be that on_crossing counts as lying
// on it.
constexpr double kLeftOfEdge = kBesideCrossing;

int first_counted(double coordinate) {
  return first_center(coordinate, -kFarthestCount, kFarthestCount);
}

// Six times the volume of the tetrahedron with these edges from one corner.
double box_volume(const Vector& a, const Vector& b, const Vector& c) {
  return std::abs(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]));
}

struct Gravity {
  double volume;
  Vector center;
};

// Exact for convex cells with planar faces: tetrahedra between a point inside and their faces.
Gravity gravity_of(const ZooMesh& mesh, CellId cell) {
  const auto nodes = mesh.cell_nodes(cell);
  const std::size_t corners = corner_count(mesh.kinds[cell]);
  const auto origin = mesh.position(nodes[0]);
  std::array<Vector, CellSurface::kMostCorners> at;  // from the first corner
  Vector inside{};
  for (std::size_t k = 0; k < corners; ++k) {
    at[k] = minus(mesh.position(nodes[k]), origin);
    for (std::size_t a = 0; a < 3; ++a) inside[a] += at[k][a] / static_cast<double>(corners);
  }
  double sum = 0;
  Vector moment{};  // from the point inside
  for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces)
    for (std::size_t k = 1; k + 1 < face.corner_count; ++k) {
      const Vector a = minus(at[face.corners[0]], inside);
      const Vector b = minus(at[face.corners[k]], inside);
      const Vector c = minus(at[face.corners[k + 1]], inside);
      const double volume = box_volume(a, b, c);
      sum += volume;
      for (std::size_t i = 0; i < 3; ++i) moment[i] += volume * (a[i] + b[i] + c[i]) / 4;
    }
  Gravity gravity{sum / 6, {}};
  for (std::size_t i = 0; i < 3; ++i)
    gravity.center[i] = origin[i] + inside[i] + (sum > 0 ? moment[i] / sum : 0);
  return gravity;
}

// Of a reference cell as the image of the unit cube (interpolant_range.hpp): a point, and the
// map's determinant there.
struct CollapsedPoint {
  Vector reference;
  double determinant;
};

CollapsedPoint collapsed_point(CellShape shape, const Vector& cube) {
  const auto& [u, v, w] = cube;
  switch (shape) {
    case CellShape::tetrahedron:
      return {{u * (1 - v) * (1 - w), v * (1 - w), w}, (1 - v) * (1 - w) * (1 - w)};
    case CellShape::pyramid:
      return {{u * (1 - w), v * (1 - w), w}, (1 - w) * (1 - w)};
    case CellShape::prism:
      return {{u * (1 - v), v, w}, 1 - v};
    case CellShape::wedge:
      return {{u * (2 - v - w), v, w}, 2 - v - w};
    case CellShape::brick:
      break;
  }
  return {cube, 1};
}

// Exact for curved cells: integrals over the cube, of polynomials of degree 11 at most.
Gravity gravity_of_curved(const ZooMesh& mesh, CellId cell) {
  const CellKind kind = mesh.kinds[cell];
  const auto nodes = mesh.cell_nodes(cell);
  const auto origin = mesh.position(nodes[0]);
  const GaussRule rule = gauss_legendre(6);
  double volume = 0;
  Vector moment{};
  std::array<double, kMaxNodesPerCell> shape;
  std::array<Vector, kMaxNodesPerCell> gradient;
  for (std::size_t at = 0; at < 216; ++at) {
    const std::array<std::size_t, 3> k{at % 6, at / 6 % 6, at / 36};
    Vector cube;
    double weight = 1;
    for (std::size_t c = 0; c < 3; ++c) {
      cube[c] = 0.5 * (1 + rule.nodes[k[c]]);
      weight *= 0.5 * rule.weights[k[c]];
    }
    const CollapsedPoint point = collapsed_point(shape_of(kind), cube);
    shape_functions<double>(kind, point.reference, shape);
    shape_gradients<double>(kind, point.reference, gradient);
    Vector here{};
    std::array<Vector, 3> columns{};
    for (std::size_t n = 1; n < nodes.size(); ++n) {
      const Vector node = minus(mesh.position(nodes[n]), origin);
      for (std::size_t c = 0; c < 3; ++c) {
        here[c] += shape[n] * node[c];
        for (std::size_t a = 0; a < 3; ++a) columns[a][c] += gradient[n][a] * node[c];
      }
    }
    weight *= point.determinant * box_volume(columns[0], columns[1], columns[2]);
    volume += weight;
    for (std::size_t c = 0; c < 3; ++c) moment[c] += weight * here[c];
  }
  Gravity gravity{volume, {}};
  for (std::size_t c = 0; c < 3; ++c)
    gravity.center[c] = origin[c] + (volume > 0 ? moment[c] / volume : 0);
  return gravity;
}

// Decides which cells are splatted.
class SplatChoice {
 public:
  SplatChoice(const Frame& frame, ImageSize size, std::uint32_t splat_below)
      : frame_(frame), width_(size.width), height_(size.height), splat_below_(splat_below) {}

  bool operator()(CellId cell) {
    if (!frame_.isosurfaces.in(cell).empty() || frame_.skin.on(cell) != 0) return false;
    const ScreenBounds b = screen_bounds(frame_, cell);
    if (!b.in_front || b.nearest < frame_.projector.near() || b.farthest > frame_.projector.far())
      return false;
    const bool may_be_seen = b.x1 > -kBsplineReach && b.x0 < width_ + kBsplineReach &&
                             b.y1 > -kBsplineReach && b.y0 < height_ + kBsplineReach;
    return may_be_seen &&
           !covers_enough(cell, {first_counted(b.x0 - kLeftOfEdge), first_counted(b.y0),
                                 first_counted(b.x1), first_counted(b.y1)});
  }

 private:
  // `box`: the pixels whose centres may be covered.
  [[nodiscard]] bool covers_enough(CellId cell, const TileRect& box) {
    const std::int64_t in_box = static_cast<std::int64_t>(box.x1 - box.x0) * (box.y1 - box.y0);
    if (in_box < splat_below_) return false;
    const CellSurface surface = cell_surface(frame_.mesh.kinds[cell], frame_.mesh.cell_nodes(cell));
    std::optional<CurvedFaces> curved;
    if (frame_.is_curved(cell)) curved.emplace(frame_, cell, surface);
    std::int64_t covered = 0;
    for (int y = box.y0; y < box.y1 && covered < splat_below_; ++y) {
      crossings_.clear();
      scan_projected_cell(frame_, surface, curved ? &*curved : nullptr, {box.x0, y, box.x1, y + 1},
                          crossings_);
      // a ray in a face may cross it several times
      for (std::size_t k = 0; k < crossings_.size(); ++k)
        if (k == 0 || crossings_[k].x != crossings_[k - 1].x) ++covered;
    }
    return covered >= splat_below_;
  }

  const Frame& frame_;
  double width_, height_;
  std::int64_t splat_below_;
  std::vector<CellCrossing> crossings_;
};

// The interpolant at a point of the cell.
double value_at(const Frame& frame, const FrameField& field, CellId cell, const Vector& point) {
  const CellKind kind = frame.mesh.kinds[cell];
  const CellField nodes = cell_field(frame.mesh, cell, field);
  if (nodes.least == nodes.most) return nodes.least;
  if (nodes.polynomial)
    return nodes.polynomial->at(minus(point, frame.mesh.position(frame.mesh.cell_nodes(cell)[0])));
  const CellMap map(kind, cell_positions(frame.mesh, cell), frame.straightness);
  std::array<double, kMaxNodesPerCell> shape;
  shape_functions<double>(kind, map.reference(point, map.middle()), shape);
  double value = 0;
  for (std::size_t k = 0; k < node_count(kind); ++k) value += shape[k] * nodes.values[k];
  return std::min(std::max(nodes.least, value), nodes.most);
}

// The first of the three columns or rows of pixels that the kernel reaches.
int first_reached(double coordinate) { return static_cast<int>(std::floor(coordinate)) - 1; }

}  // namespace

SplattedCells::SplattedCells(const Frame& frame, ImageSize size, std::uint32_t splat_below) {
  if (splat_below == 0) return;
  is_splatted_.assign(frame.mesh.cell_count(), 0);
  parallel_for(is_splatted_.size(), std::size_t{1} << 14, [&](IndexRange range) {
    SplatChoice choice(frame, size, splat_below);
    for (std::size_t cell = range.begin; cell < range.end; ++cell)
      is_splatted_[cell] = choice(static_cast<CellId>(cell)) ? 1 : 0;
  });
}

std::uint64_t SplattedCells::count() const {
  return static_cast<std::uint64_t>(std::ranges::count(is_splatted_, 1));
}

BoundsOfCell splat_bounds(const Frame& frame, const SplattedCells& splatted) {
  if (splatted.none()) return {};
  return [&](CellId cell) -> std::optional<ScreenBounds> {
    if (!splatted.holds(cell)) return std::nullopt;
    const Splat splat = splat_of(frame, cell);
    // cells that the view clips are not splatted
    return ScreenBounds{splat.x - kBsplineReach,
                        splat.y - kBsplineReach,
                        splat.x + kBsplineReach,
                        splat.y + kBsplineReach,
                        frame.projector.near(),
                        frame.projector.far(),
                        true};
  };
}

Splat splat_of(const Frame& frame, CellId cell) {
  const Projector& projector = frame.projector;
  const Gravity gravity =
      frame.is_curved(cell) ? gravity_of_curved(frame.mesh, cell) : gravity_of(frame.mesh, cell);
  ProjectedNode center;
  projector.project(gravity.center, center);
  const double t = projector.parameter(gravity.center);
  // perspective: a point moves by t / pixels_per_unit across the view for each pixel, and a ray by
  // ray_scale along itself for each unit of t (section 5.1)
  const double pixels = projector.pixels_per_unit() / (projector.perspective() ? t : 1);
  return {center.x, center.y, t,
          gravity.volume * pixels * pixels * projector.ray_scale(center.x, center.y),
          gravity.center};
}

TileSplats::TileSplats(const Frame& frame, const SplattedCells& splatted,
                       std::span<const CellId> order, std::span<const std::uint32_t> ranks,
                       const TileRect& tile)
    : frame_(frame), tile_(tile) {
  if (splatted.none()) return;
  for (const std::uint32_t rank : ranks)
    if (splatted.holds(order[rank])) add(order[rank]);
  if (splats_.empty()) return;
  std::ranges::sort(splats_, [](const Glowing& a, const Glowing& b) {
    return a.t != b.t ? a.t < b.t : a.cell < b.cell;
  });
  deal_out();
}

void TileSplats::add(CellId cell) {
  const OpticsTables& optics = frame_.optics;
  const Splat splat = splat_of(frame_, cell);
  if (!(splat.length > 0)) return;
  const double value = value_at(frame_, frame_.extinction, cell, splat.point);
  const double extinction = optics.extinction_function(value)[0];
  const Color color = optics.color_function(
      optics.same_field ? value : value_at(frame_, frame_.color_field(), cell, splat.point));
  if (extinction == 0 && !optics.emission) return;
  splats_.push_back({splat.x, splat.y, splat.t, splat.length, extinction, color, cell});
}

// Calls visit(pixel) for the tile's pixels that the kernel reaches.
template <typename Visit>
void TileSplats::for_each_pixel(const Glowing& splat, const Visit& visit) const {
  const int left = first_reached(splat.x), top = first_reached(splat.y);
  for (int y = std::max(top, tile_.y0); y < std::min(top + 3, tile_.y1); ++y)
    for (int x = std::max(left, tile_.x0); x < std::min(left + 3, tile_.x1); ++x)
      visit(tile_.index(x, y));
}

// Counting sort by pixel.
void TileSplats::deal_out() {
  end_.assign(kTilePlane, 0);
  for (const Glowing& splat : splats_)
    for_each_pixel(splat, [&](std::size_t pixel) { ++end_[pixel]; });
  std::size_t sum = 0;
  for (std::size_t& end : end_) {
    sum += end;
    end = sum - end;
  }
  next_ = end_;
  of_pixel_.resize(sum);
  for (std::uint32_t k = 0; k < splats_.size(); ++k)
    for_each_pixel(splats_[k], [&](std::size_t pixel) { of_pixel_[end_[pixel]++] = k; });
}

void TileSplats::append(std::size_t at, double before, const TileBuffer& buffer,
                        SegmentList& list) {
  // A splat has no end that segments behind it would have to respect.
  constexpr double kNoEnd = std::numeric_limits<double>::lowest();
  const bool emission = frame_.optics.emission;
  const double x = pixel_center(tile_.column(at)), y = pixel_center(tile_.row(at));
  const bool seen = buffer.transparency[at] > frame_.least_transparency;
  for (; next_[at] < end_[at] && splats_[of_pixel_[next_[at]]].t < before; ++next_[at]) {
    if (!seen) continue;
    const Glowing& splat = splats_[of_pixel_[next_[at]]];
    const double length =
        splat.length * quadratic_bspline(x - splat.x) * quadratic_bspline(y - splat.y);
    const double depth = splat.extinction * length;
    const LinearPieceWeights weights =
        emission ? linear_piece_emission(depth, depth) : linear_piece_weights(depth, depth);
    const double light = (weights.front + weights.back) * (emission ? length : 1);
    list.segments.push_back(
        {at,
         splat.t,
         kNoEnd,
         {{light * splat.color[0], light * splat.color[1], light * splat.color[2]},
          weights.transparency}});
    if (!frame_.with_details) continue;
    SegmentDetails details;
    details.front = details.back = details.first = details.mean = splat.t;
    details.light = light * *std::ranges::max_element(splat.color);
    details.transparency = weights.transparency;
    list.details.push_back(details);
  }
}

void TileSplats::append_before(const TileBuffer& buffer, SegmentList& list) {
  if (empty()) return;
  std::vector<double> farthest(next_.size(), -std::numeric_limits<double>::infinity());
  for (const ListedSegment& s : list.segments)
    farthest[s.pixel] = std::max(farthest[s.pixel], s.front);
  for (std::size_t at = 0; at < farthest.size(); ++at) append(at, farthest[at], buffer, list);
}

void TileSplats::append_rest(const TileBuffer& buffer, SegmentList& list) {
  for (std::size_t at = 0; at < next_.size(); ++at)
    append(at, std::numeric_limits<double>::infinity(), buffer, list);
}

}  // namespace hiac

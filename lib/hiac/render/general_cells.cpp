#include "hiac/render/general_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "hiac/optics/piece_rule.hpp"
#include "hiac/optics/polynomial_piece.hpp"
#include "hiac/render/cell_scan.hpp"
#include "hiac/render/cell_surface.hpp"
#include "hiac/render/cuts_along_ray.hpp"
#include "hiac/render/field_along_ray.hpp"

namespace hiac {
namespace {

// Of the tolerance, for what becomes of fields that are not polynomials; integration has the rest.
constexpr double kFieldShare = 0.25, kIntegrationShare = 0.5;

// Behind an opaque surface nothing is seen; a tolerance divided by this is a number still.
constexpr double kLeastVisible = 1e-100;

// Intervals of a transfer table, inclusive.
struct IntervalRange {
  std::size_t low, high;
};

bool all_zero(const std::vector<std::uint8_t>& zero, IntervalRange range) {
  return std::all_of(zero.begin() + static_cast<std::ptrdiff_t>(range.low),
                     zero.begin() + static_cast<std::ptrdiff_t>(range.high) + 1,
                     [](std::uint8_t z) { return z != 0; });
}

// The steepest slope of a transfer function on some intervals; infinite where it jumps there.
template <std::size_t N>
double steepest_slope(const TransferTable<N>& table, IntervalRange range) {
  double steepest = 0;
  for (std::size_t c = 0; c < N; ++c)
    for (std::size_t k = range.low; k <= range.high; ++k) {
      steepest = std::max(steepest, std::abs(table.slope[c][k]));
      if (k == range.low) continue;
      const auto at_breakpoint = [&](std::size_t piece) {
        return table.value[c][piece] +
               table.slope[c][piece] * (table.lower[k] - table.anchor[piece]);
      };
      const double before = at_breakpoint(k - 1), after = at_breakpoint(k);
      const double rounding =
          8 * std::numeric_limits<double>::epsilon() * (std::abs(before) + std::abs(after));
      if (std::abs(after - before) > rounding) return std::numeric_limits<double>::infinity();
    }
  return steepest;
}

// One field in one cell.
struct CellScalars {
  CornerField corners;
  IntervalRange intervals;

  [[nodiscard]] bool constant() const { return corners.least == corners.most; }
};

class GeneralCellRenderer {
 public:
  GeneralCellRenderer(const Frame& frame, const TileRect& tile, TileBuffer& buffer,
                      SegmentList* group, TileCounts& counts)
      : frame_(frame),
        optics_(frame.optics),
        tile_(tile),
        buffer_(buffer),
        group_(group),
        counts_(counts),
        glow_(optics_.emission ? Glow::emission : Glow::chromaticity),
        cuts_(frame) {
    for (const int x : {tile.x0, tile.x1})
      for (const int y : {tile.y0, tile.y1})
        longest_unit_ = std::max(longest_unit_, frame.projector.ray_scale(x, y));
  }

  void render(CellId cell) {
    load(cell);
    is_empty_ = empty_space();
    is_cut_ = cuts_.enter(cell);
    if (is_empty_ && !is_cut_) return;
    const CellKind kind = frame_.mesh.kinds[cell];
    const auto nodes = frame_.mesh.cell_nodes(cell);
    find_crossings(kind, nodes);
    if (crossings_.empty()) return;
    std::array<CellMap::Point, CellMap::kMostCorners> corners;
    for (std::size_t k = 0; k < corner_count(kind); ++k) {
      const auto p = frame_.mesh.position(nodes[k]);
      corners[k] = {p[0], p[1], p[2]};
    }
    const CellMap map(kind, corners);
    const std::array<CornerField, 2> fields{extinction_.corners, color_.corners};
    const FieldAlongRay field(kind, map, std::span(fields).first(optics_.same_field ? 1 : 2));
    is_uniform_ = uniform_optics();
    for (const CellCrossing& crossing : crossings_) render(crossing, map, field);
  }

 private:
  void load(CellId cell) {
    extinction_ = load_field(frame_.extinction, cell);
    color_ = optics_.same_field ? extinction_ : load_field(frame_.color, cell);
    set_allowed_errors();
  }

  [[nodiscard]] CellScalars load_field(const FrameField& field, CellId cell) const {
    const auto nodes = frame_.mesh.cell_nodes(cell);
    CellScalars scalars{{}, {std::numeric_limits<std::size_t>::max(), 0}};
    CornerField& corners = scalars.corners;
    corners.least = std::numeric_limits<double>::infinity();
    corners.most = -corners.least;
    for (std::size_t k = 0; k < corner_count(frame_.mesh.kinds[cell]); ++k) {
      const std::size_t at = field.index(cell, frame_.mesh.elems[cell] + k, nodes[k]);
      corners.values[k] = field.values[at];
      corners.least = std::min(corners.least, corners.values[k]);
      corners.most = std::max(corners.most, corners.values[k]);
      scalars.intervals.low = std::min<std::size_t>(scalars.intervals.low, field.intervals[at].low);
      scalars.intervals.high =
          std::max<std::size_t>(scalars.intervals.high, field.intervals[at].high);
    }
    return scalars;
  }

  // An error e of a field changes the optical depth of a whole ray by e times slope times length at
  // most; that changes alpha by as much, and radiance by twice the largest colour (chromaticity) or
  // the light of a whole ray (emission) times that. The colour's own error is weighted by at most
  // 1, or the length.
  void set_allowed_errors() {
    const double share = kFieldShare * frame_.tolerance;
    const double length = frame_.depth * longest_unit_;
    const double light = std::max(optics_.largest_color * (optics_.emission ? length : 2),
                                  2 * frame_.isosurfaces.largest_light);
    const double extinction =
        steepest_slope(optics_.extinction, extinction_.intervals) * length * std::max(1.0, light);
    const double color =
        steepest_slope(optics_.color, color_.intervals) * (optics_.emission ? length : 1);
    extinction_.corners.allowed = share / extinction;
    color_.corners.allowed = share / color;
    if (optics_.same_field) extinction_.corners.allowed = share / (extinction + color);
  }

  // Where nothing absorbs, chromaticity has nothing to colour.
  [[nodiscard]] bool empty_space() const {
    return all_zero(optics_.no_extinction, extinction_.intervals) &&
           (!optics_.emission || all_zero(optics_.no_color, color_.intervals));
  }

  // Whether colour and extinction have one value in the whole cell.
  [[nodiscard]] bool uniform_optics() const {
    const auto flat = [](const auto& table, const CellScalars& scalars) {
      if (scalars.constant()) return true;
      const auto [low, high] = scalars.intervals;
      return low == high && std::ranges::all_of(table.slope, [k = low](const auto& slope) {
               return slope[k] == 0;
             });
    };
    return flat(optics_.extinction, extinction_) && flat(optics_.color, color_);
  }

  void find_crossings(CellKind kind, std::span<const NodeId> nodes) {
    crossings_.clear();
    const CellSurface surface = cell_surface(kind, nodes);
    const bool projected =
        std::none_of(surface.nodes.begin(),
                     surface.nodes.begin() + static_cast<std::ptrdiff_t>(surface.corner_count),
                     [&](NodeId node) { return std::isnan(frame_.nodes[node].depth); });
    const auto scan = projected ? scan_projected_cell : scan_cell_beside_eye;
    scan(frame_, surface, tile_, crossings_);
  }

  void render(const CellCrossing& crossing, const CellMap& map, const FieldAlongRay& field) {
    const std::size_t at = static_cast<std::size_t>(crossing.y - tile_.y0) * kTileStride +
                           static_cast<std::size_t>(crossing.x - tile_.x0);
    if (buffer_.transparency[at] <= frame_.least_transparency) return;
    const double x = crossing.x + 0.5, y = crossing.y + 0.5;
    const RayStretch stretch{frame_.projector.origin(x, y), frame_.projector.direction(x, y),
                             std::max(crossing.front, frame_.projector.near()),
                             std::min(crossing.back, frame_.projector.far())};
    // where surfaces cross a cell without depth, they are seen all the same
    if (is_cut_ ? stretch.front > stretch.back : !(stretch.front < stretch.back)) return;
    ++counts_.segments;
    const double visible = group_ != nullptr ? 1 : buffer_.transparency[at];
    const double scale = buffer_.ray_scale[at];
    const PlainRadiance radiance =
        is_cut_ ? between_surfaces(crossing, map, stretch, scale, field, visible)
                : radiance_of(stretch, scale, field, visible);
    if (group_ != nullptr)
      group_->append(static_cast<std::uint32_t>(at), stretch.front, stretch.back, radiance.rgb[0],
                     radiance.rgb[1], radiance.rgb[2], radiance.transparency);
    else
      composite(at, stretch, radiance);
  }

  // `scale`: world length per unit of the ray parameter; `visible`: the transparency in front.
  [[nodiscard]] PlainRadiance radiance_of(const RayStretch& stretch, double scale,
                                          const FieldAlongRay& field, double visible) {
    const double length = (stretch.back - stretch.front) * scale;
    return is_uniform_ ? uniform_radiance(length) : integrated(stretch, length, field, visible);
  }

  // From surface to surface.
  [[nodiscard]] PlainRadiance between_surfaces(const CellCrossing& crossing, const CellMap& map,
                                               const RayStretch& stretch, double scale,
                                               const FieldAlongRay& field, double visible) {
    cuts_.find(map, crossing, stretch, surfaces_);
    PlainRadiance sum;
    const auto add_volume = [&](double front, double back) {
      if (is_empty_ || !(front < back)) return;
      const PlainRadiance r =
          radiance_of({stretch.origin, stretch.direction, front, back}, scale, field,
                      std::max(visible * sum.transparency, kLeastVisible));
      sum.add_behind(r);
    };
    double front = stretch.front;
    for (const IsosurfaceCrossing& surface : surfaces_) {
      add_volume(front, surface.t);
      sum.add_behind({surface.shade.rgb, surface.shade.transparency});
      front = std::max(front, surface.t);
    }
    add_volume(front, stretch.back);
    return sum;
  }

  [[nodiscard]] PlainRadiance uniform_radiance(double length) const {
    const double depth = optics_.extinction_function(extinction_.corners.least)[0] * length;
    const auto color = optics_.color_function(color_.corners.least);
    const LinearPieceWeights weights = linear_piece_by_rule(optics_.rule, glow_, depth, depth);
    const double weight = (weights.front + weights.back) * (optics_.emission ? length : 1);
    return {{weight * color[0], weight * color[1], weight * color[2]}, weights.transparency};
  }

  // Every segment may use a part of the tolerance in proportion to its length.
  [[nodiscard]] PlainRadiance integrated(const RayStretch& stretch, double length,
                                         const FieldAlongRay& field, double visible) {
    const double part = (stretch.back - stretch.front) / frame_.depth;
    const double tolerance = kIntegrationShare * frame_.tolerance * part / visible;
    field.along(stretch, pieces_);
    if (optics_.unsliced) return unsliced(length);
    PlainRadiance radiance;
    for (const FieldAlongRay::Piece& piece : pieces_) {
      const double share = piece.end - piece.begin;
      const PolynomialSegment segment{piece.fields[optics_.same_field ? 0 : 1], piece.fields[0],
                                      share * length};
      if (optics_.rule != PieceRule::exact) {
        radiance.add_behind(integrate_segment_by_rule(optics_.rule, segment, optics_.color_function,
                                                      optics_.extinction_function, glow_));
        continue;
      }
      const SegmentRadiance r =
          integrate_segment(segment, optics_.color_function, optics_.extinction_function, glow_,
                            std::max(share * tolerance, std::numeric_limits<double>::min()));
      radiance.add_behind({r.rgb, r.transparency});
    }
    return radiance;
  }

  // From the ends of what lies in pieces_.
  [[nodiscard]] PlainRadiance unsliced(double length) const {
    const std::size_t color = optics_.same_field ? 0 : 1;
    const auto &front = pieces_.front().fields, &back = pieces_.back().fields;
    return integrate_unsliced(optics_.rule, length,
                              optics_.color_function(evaluate(front[color], 0)),
                              optics_.color_function(evaluate(back[color], 1)),
                              optics_.extinction_function(evaluate(front[0], 0))[0],
                              optics_.extinction_function(evaluate(back[0], 1))[0], glow_);
  }

  void composite(std::size_t at, const RayStretch& stretch, const PlainRadiance& radiance) {
    double& last = buffer_.last[at];
    // a segment shorter than the tolerance may be rounding, and lie anywhere
    const double tolerance = frame_.witness_tolerance;
    if (stretch.front < last - tolerance && stretch.back - stretch.front > tolerance)
      ++counts_.violations;
    last = std::max(last, stretch.back);
    double& transparency = buffer_.transparency[at];
    buffer_.red[at] += transparency * radiance.rgb[0];
    buffer_.green[at] += transparency * radiance.rgb[1];
    buffer_.blue[at] += transparency * radiance.rgb[2];
    transparency *= radiance.transparency;
  }

  const Frame& frame_;
  const OpticsTables& optics_;
  const TileRect& tile_;
  TileBuffer& buffer_;
  SegmentList* group_;
  TileCounts& counts_;
  Glow glow_;
  double longest_unit_ = 0;  // world length per unit of the ray parameter, at most
  // of the cell at hand
  CellScalars extinction_{}, color_{};
  CutsAlongRay cuts_;
  bool is_empty_ = false;    // neither absorbs nor shines
  bool is_cut_ = false;      // by surfaces
  bool is_uniform_ = false;  // colour and extinction have one value
  std::vector<CellCrossing> crossings_;
  std::vector<FieldAlongRay::Piece> pieces_;
  std::vector<IsosurfaceCrossing> surfaces_;
};

}  // namespace

void render_general_cells(const Frame& frame, std::span<const CellId> cells, const TileRect& tile,
                          TileBuffer& buffer, SegmentList* group, TileCounts& counts) {
  GeneralCellRenderer renderer(frame, tile, buffer, group, counts);
  for (const CellId cell : cells) renderer.render(cell);
}

}  // namespace hiac

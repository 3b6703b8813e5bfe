#include "hiac/render/cells/general_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "hiac/base/cancellation.hpp"
#include "hiac/element/field_along_ray.hpp"
#include "hiac/frame/tolerance_shares.hpp"
#include "hiac/optics/piece_rule.hpp"
#include "hiac/optics/polynomial_piece.hpp"
#include "hiac/render/bounds/cell_errors.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/cells/cell_scalars.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/cells/cell_segments.hpp"
#include "hiac/render/cells/cuts_along_ray.hpp"
#include "hiac/render/integrate/cell_integrals.hpp"

namespace hiac {
namespace {

// Behind an opaque surface nothing is seen; a tolerance divided by this is a number still.
constexpr double kLeastVisible = 1e-100;

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
        longest_unit_(longest_unit(frame.projector, tile)),
        cuts_(frame),
        errors_(frame, frame.depth * longest_unit_) {}

  void render(CellId cell) {
    load(cell);
    is_empty_ = is_empty_space(optics_, color_.intervals, extinction_.intervals);
    const RayDisplacement displacement =
        frame_.with_error ? ray_displacement(frame_, cell) : RayDisplacement{};
    is_cut_ = cuts_.enter(cell, displacement);
    if (is_empty_ && !is_cut_) return;
    kind_ = frame_.mesh.kinds[cell];
    curved_ = frame_.is_curved(cell);
    is_uniform_ = uniform_optics();
    const bool together = optics_.rule == PieceRule::exact && !is_uniform_ && !is_empty_ &&
                          !extinction_.nodes.polynomial && !color_.nodes.polynomial;
    scan(cell, together && !curved_ && !is_cut_);
    if (crossings_.empty() && runs_.count == 0) return;
    nodes_ = relative_positions(frame_.mesh, cell, frame_.projector);
    const CellMap map(kind_, nodes_, frame_.straightness);
    const std::array<CellField, 2> fields{extinction_.nodes, color_.nodes};
    const FieldAlongRay field(kind_, map, std::span(fields).first(optics_.same_field ? 1 : 2));
    if (frame_.with_error) errors_.enter(cell, nodes_, color_, extinction_, displacement);
    if (is_cut_)
      render_cut_together(map, field, std::span(fields).first(optics_.same_field ? 1 : 2),
                          together);
    else if (together)
      render_together(map, field, std::span(fields).first(optics_.same_field ? 1 : 2));
    else
      for (const CellCrossing& crossing : crossings_) render(crossing, field, {});
  }

 private:
  static double longest_unit(const Projector& projector, const TileRect& tile) {
    double longest = 0;
    for (const int x : {tile.x0, tile.x1})
      for (const int y : {tile.y0, tile.y1}) longest = std::max(longest, projector.ray_scale(x, y));
    return longest;
  }

  void load(CellId cell) {
    extinction_ = cell_scalars(frame_.mesh, cell, frame_.extinction, optics_.extinction);
    color_ = optics_.same_field ? extinction_
                                : cell_scalars(frame_.mesh, cell, frame_.color, optics_.color);
    shares_ = tolerance_shares(order_of(frame_.mesh.kinds[cell]));
    set_allowed_errors(frame_, frame_.depth * longest_unit_, shares_.field * frame_.tolerance,
                       color_, extinction_);
  }

  // Into runs_ what can be `by_runs`, the rest into crossings_.
  void scan(CellId cell, bool by_runs) {
    crossings_.clear();
    runs_.clear();
    if (by_runs) {
      const CellSurface surface = cell_surface(kind_, frame_.mesh.cell_nodes(cell));
      if (is_projectable(frame_, surface))
        return scan_projected_runs(frame_, surface, tile_, runs_, crossings_);
    }
    scan_cell(frame_, cell, tile_, crossings_);
  }

  // Whether colour and extinction have one value in the whole cell.
  [[nodiscard]] bool uniform_optics() const {
    return is_flat(optics_.extinction, extinction_) && is_flat(optics_.color, color_);
  }

  [[nodiscard]] std::size_t index_of(const CellCrossing& crossing) const {
    return static_cast<std::size_t>(crossing.y - tile_.y0) * kTileStride +
           static_cast<std::size_t>(crossing.x - tile_.x0);
  }

  [[nodiscard]] RayStretch stretch_of(const CellCrossing& crossing) const {
    const double x = crossing.x + 0.5, y = crossing.y + 0.5;
    return {frame_.projector.relative_origin(x, y), frame_.projector.direction(x, y),
            std::max(crossing.front, frame_.projector.near()),
            std::min(crossing.back, frame_.projector.far()), place_of(crossing)};
  }

  // Of a segment, as a part of the tolerance in proportion to its length.
  [[nodiscard]] double allowed_error(double front, double back, double visible) const {
    return shares_.integration * frame_.tolerance * ((back - front) / frame_.depth) / visible;
  }

  // Segments of the cell many at a time.
  void render_together(const CellMap& map, const FieldAlongRay& field,
                       std::span<const CellField> fields) {
    segments_.start(runs_.count + crossings_.size(), curved_);
    collect_runs(frame_, runs_, tile_, buffer_, allowed_error(0, 1, 1), group_ == nullptr,
                 segments_);
    const std::size_t of_runs = segments_.count;
    collect_segments(map);
    if (segments_.count == 0) return;
    integrate_together(map, fields);
    const bool one_by_one = group_ != nullptr || frame_.with_details;
    if (!one_by_one) counts_.violations += composite_segments(frame_, segments_, of_runs, buffer_);
    for (std::size_t k = 0; k < of_runs; ++k)
      if (one_by_one || segments_.done[k] == 0)
        render_or_add(k, plain_crossing(k), field);
      else
        ++counts_.segments;
    for (std::size_t k = of_runs; k < segments_.count; ++k)
      render_or_add(k, crossings_[kept_[k - of_runs]], field);
  }

  void integrate_together(const CellMap& map, std::span<const CellField> fields) {
    const CellPolynomials polynomials(kind_, nodes_, map, fields);
    integrate_cell_segments(frame_, polynomials,
                            {color_.intervals.low, color_.intervals.high, extinction_.intervals.low,
                             extinction_.intervals.high},
                            segments_);
  }

  // The surfaces that cross a segment, and what is in front of, between and behind them.
  struct CutSegment {
    std::size_t crossing;                   // of crossings_
    std::size_t first_surface, count;       // of all_surfaces_
    bool doubtful;                          // CutsAlongRay::doubtful
    std::optional<std::size_t> first_part;  // of segments_, which has those that have depth
  };

  // The same where surfaces cross the cell. `with_parts`: the volume between them, too, can be
  // integrated together.
  void render_cut_together(const CellMap& map, const FieldAlongRay& field,
                           std::span<const CellField> fields, bool with_parts) {
    segments_.start(crossings_.size(), curved_);
    collect_segments(map);
    cuts_.interpolate(map, segments_);
    find_surfaces(map);
    if (with_parts) {
      segments_.start(cut_segments_.size() + all_surfaces_.size(), curved_);
      for (CutSegment& cut : cut_segments_) {
        const CellCrossing& crossing = crossings_[cut.crossing];
        cut.first_part = segments_.count;
        for_parts(stretch_of(crossing), surfaces_of(cut),
                  [&](double front, double back) { append_segment(crossing, map, front, back); });
      }
      integrate_together(map, fields);
    }
    for (const CutSegment& cut : cut_segments_)
      render(crossings_[cut.crossing], field, {.cut = &cut});
  }

  // Those that cut the crossings, of which segments_ has some.
  void find_surfaces(const CellMap& map) {
    cut_segments_.clear();
    all_surfaces_.clear();
    std::size_t k = 0;
    for (std::size_t i = 0; i < crossings_.size(); ++i) {
      std::optional<std::size_t> segment;
      if (k < kept_.size() && kept_[k] == i) segment = k++;
      const RayStretch stretch = stretch_of(crossings_[i]);
      if (!is_seen(index_of(crossings_[i])) || stretch.front > stretch.back) continue;
      cuts_.find(map, crossings_[i], stretch, segment, surfaces_);
      bool doubtful = cuts_.doubtful();
      if (segment && frame_.with_error) doubtful = !check_surfaces(map, crossings_[i], stretch);
      cut_segments_.push_back({i, all_surfaces_.size(), surfaces_.size(), doubtful, {}});
      all_surfaces_.insert(all_surfaces_.end(), surfaces_.begin(), surfaces_.end());
    }
  }

  // Gives surfaces_, found of fields of which no bound is known, the bounds of what is found of
  // this ray alone: how far they are apart counts besides. False where they may be others.
  bool check_surfaces(const CellMap& map, const CellCrossing& crossing, const RayStretch& stretch) {
    cuts_.find(map, crossing, stretch, {}, alone_);
    if (cuts_.doubtful() || alone_.size() != surfaces_.size()) return false;
    for (std::size_t i = 0; i < alone_.size(); ++i) {
      const IsosurfaceCrossing& alone = alone_[i];
      IsosurfaceCrossing& together = surfaces_[i];
      if (alone.surface != together.surface) return false;
      together.moved = alone.moved + std::abs(together.t - alone.t);
      together.shade_error = alone.shade_error;
      double apart = 0;
      for (std::size_t c = 0; c < 3; ++c)
        apart = std::max(apart, std::abs(together.shade.rgb[c] - alone.shade.rgb[c]));
      together.shade_error.radiance += apart;
      together.shade_error.transparency +=
          std::abs(together.shade.transparency - alone.shade.transparency);
    }
    return true;
  }

  [[nodiscard]] std::span<const IsosurfaceCrossing> surfaces_of(const CutSegment& cut) const {
    return std::span(all_surfaces_).subspan(cut.first_surface, cut.count);
  }

  [[nodiscard]] bool is_seen(std::size_t at) const {
    return buffer_.transparency[at] > frame_.least_transparency;
  }

  // Calls volume(front, back) for the parts of a stretch between surfaces that have depth, and
  // surface(crossing) for those, front to back.
  template <class Volume, class Surface = void (*)(const IsosurfaceCrossing&)>
  static void for_parts(
      const RayStretch& stretch, std::span<const IsosurfaceCrossing> surfaces, Volume&& volume,
      Surface&& surface = [](const IsosurfaceCrossing&) {}) {
    double front = stretch.front;
    for (const IsosurfaceCrossing& s : surfaces) {
      if (front < s.t) volume(front, s.t);
      surface(s);
      front = std::max(front, s.t);
    }
    if (front < stretch.back) volume(front, stretch.back);
  }

  [[nodiscard]] PlainRadiance integrated_together(std::size_t k) const {
    return {{segments_.red[k], segments_.green[k], segments_.blue[k]}, segments_.transparency[k]};
  }

  // Segment k, whatever of it is done.
  void render_or_add(std::size_t k, const CellCrossing& crossing, const FieldAlongRay& field) {
    const PlainRadiance radiance = integrated_together(k);
    if (segments_.done[k] != 0 && !frame_.with_details)
      add_seen(segments_.at[k], segments_.front[k], segments_.back[k], radiance);
    else
      render(crossing, field, {.radiance = segments_.done[k] != 0 ? &radiance : nullptr});
  }

  // Of a segment of runs_, whose faces nobody asks for: beyond the view where that clips it.
  [[nodiscard]] CellCrossing plain_crossing(std::size_t k) const {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const double front = segments_.front[k], back = segments_.back[k];
    CellCrossing crossing{};
    crossing.x = static_cast<int>(segments_.x[k]);
    crossing.y = static_cast<int>(segments_.y[k]);
    crossing.front = front == frame_.projector.near() ? -kFar : front;
    crossing.back = back == frame_.projector.far() ? kFar : back;
    crossing.front_reference = crossing.back_reference = {kNone, kNone, kNone};
    crossing.front_doubt = crossing.back_doubt = kNone;
    return crossing;
  }

  // Those of crossings_.
  void collect_segments(const CellMap& map) {
    kept_.clear();
    const double near = frame_.projector.near(), far = frame_.projector.far();
    for (std::size_t i = 0; i < crossings_.size(); ++i) {
      const CellCrossing& crossing = crossings_[i];
      const double front = std::max(crossing.front, near), back = std::min(crossing.back, far);
      if (!is_seen(index_of(crossing)) || !(front < back)) continue;
      kept_.push_back(i);
      append_segment(crossing, map, front, back);
    }
  }

  // A part of a crossing, for segments_.
  void append_segment(const CellCrossing& crossing, const CellMap& map, double front, double back) {
    const std::size_t k = segments_.count++, at = index_of(crossing);
    const double seen = group_ != nullptr ? 1 : buffer_.transparency[at];
    segments_.at[k] = static_cast<std::uint32_t>(at);
    segments_.x[k] = crossing.x + 0.5;
    segments_.y[k] = crossing.y + 0.5;
    segments_.front[k] = front;
    segments_.back[k] = back;
    segments_.length[k] = (back - front) * buffer_.ray_scale[at];
    segments_.allowed[k] = allowed_error(0, 1, 1) * (back - front) / seen;
    if (curved_) set_known(crossing, map, k);
  }

  void set_known(const CellCrossing& crossing, const CellMap& map, std::size_t k) {
    const auto reference = place_of(crossing);
    const auto known =
        collapsed(shape_of(kind_), std::isnan(reference[0]) ? map.middle() : reference);
    segments_.known_u[k] = known[0];
    segments_.known_v[k] = known[1];
    segments_.known_w[k] = known[2];
  }

  void add_seen(std::size_t at, double front, double back, const PlainRadiance& radiance) {
    if (!is_seen(at)) return;
    ++counts_.segments;
    add_to_pixel(at, front, back, radiance);
  }

  void add_to_pixel(std::size_t at, double front, double back, const PlainRadiance& radiance) {
    if (group_ != nullptr)
      group_->append(static_cast<std::uint32_t>(at), front, back, radiance.rgb[0], radiance.rgb[1],
                     radiance.rgb[2], radiance.transparency);
    else
      composite(at, front, back, radiance);
  }

  // What was found of a segment together with others, if anything: its radiance, or that of its
  // parts between surfaces.
  struct Together {
    const PlainRadiance* radiance = nullptr;
    const CutSegment* cut = nullptr;
  };

  void render(const CellCrossing& crossing, const FieldAlongRay& field, const Together& together) {
    const std::size_t at = index_of(crossing);
    if (!is_seen(at)) return;
    const RayStretch stretch = stretch_of(crossing);
    // where surfaces cross a cell without depth, they are seen all the same
    if (is_cut_ ? stretch.front > stretch.back : !(stretch.front < stretch.back)) return;
    ++counts_.segments;
    const double visible = group_ != nullptr ? 1 : buffer_.transparency[at];
    const double scale = buffer_.ray_scale[at];
    details_ = {.front = stretch.front, .back = stretch.back, .first = stretch.front};
    weight_ = weighted_depth_ = 0;
    PlainRadiance radiance;
    if (together.cut != nullptr) {
      const auto surfaces = surfaces_of(*together.cut);
      surfaces_.assign(surfaces.begin(), surfaces.end());
      are_doubtful_ = together.cut->doubtful;
      radiance = between_surfaces(stretch, scale, field, visible, together.cut->first_part);
    } else if (together.radiance == nullptr || frame_.with_error) {
      radiance = radiance_of(stretch, scale, field, visible);
      add_quadrature(1, radiance);
    }
    if (together.radiance != nullptr) radiance = checked(1, *together.radiance, radiance);
    if (frame_.with_details) describe(at, crossing, field, stretch, scale, radiance);
    add_to_pixel(at, stretch.front, stretch.back, radiance);
  }

  // What was found together with other segments, of which no bound is known, with the bounds of
  // what was found of this segment alone: how far they are apart counts besides. Both are seen
  // through `visible` of the segment.
  [[nodiscard]] PlainRadiance checked(double visible, const PlainRadiance& together,
                                      const PlainRadiance& alone) {
    if (!frame_.with_error) return together;
    double apart = 0;
    for (std::size_t c = 0; c < 3; ++c)
      apart = std::max(apart, std::abs(together.rgb[c] - alone.rgb[c]));
    details_.radiance_error += visible * apart;
    details_.transparency_error += visible * std::abs(together.transparency - alone.transparency);
    return together;
  }

  // `scale`: world length per unit of the ray parameter; `visible`: the transparency in front.
  [[nodiscard]] PlainRadiance radiance_of(const RayStretch& stretch, double scale,
                                          const FieldAlongRay& field, double visible) {
    quadrature_ = {};
    const double length = (stretch.back - stretch.front) * scale;
    return is_uniform_ ? uniform_radiance(length) : integrated(stretch, length, field, visible);
  }

  // From surface to surface, of surfaces_. `part`: the first one's number among segments_.
  [[nodiscard]] PlainRadiance between_surfaces(const RayStretch& stretch, double scale,
                                               const FieldAlongRay& field, double visible,
                                               std::optional<std::size_t> part) {
    PlainRadiance sum;
    const auto volume = [&](double front, double back) {
      if (is_empty_) return;
      const double before = sum.transparency;
      const bool is_known = part && segments_.done[*part] != 0;
      PlainRadiance r;
      if (!is_known || frame_.with_error) {
        r = radiance_of({stretch.origin, stretch.direction, front, back, stretch.known}, scale,
                        field, std::max(visible * before, kLeastVisible));
        add_quadrature(before, r);
      }
      sum.add_behind(is_known ? checked(before, integrated_together(*part), r) : r);
      if (part) ++*part;
      add_depth(0.5 * (front + back), before - sum.transparency);
    };
    const auto surface = [&](const IsosurfaceCrossing& s) {
      const double before = sum.transparency;
      sum.add_behind({s.shade.rgb, s.shade.transparency});
      add_depth(s.t, before - sum.transparency);
    };
    for_parts(stretch, surfaces_, volume, surface);
    return sum;
  }

  [[nodiscard]] PlainRadiance uniform_radiance(double length) const {
    const double depth = optics_.extinction_function(extinction_.nodes.least)[0] * length;
    const auto color = optics_.color_function(color_.nodes.least);
    const LinearPieceWeights weights = linear_piece_by_rule(optics_.rule, glow_, depth, depth);
    const double weight = (weights.front + weights.back) * (optics_.emission ? length : 1);
    return {{weight * color[0], weight * color[1], weight * color[2]}, weights.transparency};
  }

  [[nodiscard]] PlainRadiance integrated(const RayStretch& stretch, double length,
                                         const FieldAlongRay& field, double visible) {
    const double tolerance = allowed_error(stretch.front, stretch.back, visible);
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
      quadrature_.radiance += r.error + quadrature_.transparency * std::ranges::max(r.rgb);
      quadrature_.transparency += r.transparency_error;
    }
    return radiance;
  }

  // Notes the bound of the last quadrature, of a part that is seen through `visible` of the
  // segment.
  void add_quadrature(double visible, const PlainRadiance& part) {
    details_.radiance_error +=
        visible * quadrature_.radiance + details_.transparency_error * std::ranges::max(part.rgb);
    details_.transparency_error += visible * quadrature_.transparency;
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

  // Notes at what depth a part of the segment's opacity is.
  void add_depth(double t, double opacity) {
    weight_ += opacity;
    weighted_depth_ += opacity * t;
  }

  // Completes details_ and tells the pixel, or the group.
  void describe(std::size_t at, const CellCrossing& crossing, const FieldAlongRay& field,
                const RayStretch& stretch, double scale, const PlainRadiance& radiance) {
    details_.light = std::ranges::max(radiance.rgb);
    details_.transparency = radiance.transparency;
    details_.mean = weight_ > 0 ? weighted_depth_ / weight_ : 0.5 * (stretch.front + stretch.back);
    if (is_empty_ && !surfaces_.empty()) details_.first = surfaces_.front().t;
    if (frame_.with_error) {
      std::optional<CellErrors::Cut> cut;
      if (is_cut_) cut = {surfaces_, are_doubtful_};
      errors_.add(crossing, stretch, scale, field, cut, details_);
    }
    if (group_ != nullptr) return group_->details.push_back(details_);
    details_.out_of_order = out_of_order(at, stretch.front, stretch.back);
    buffer_.describe(at, details_);
  }

  // A segment shorter than the tolerance may be rounding, and lie anywhere.
  [[nodiscard]] bool out_of_order(std::size_t at, double front, double back) const {
    const double tolerance = frame_.witness_tolerance;
    return front < buffer_.last[at] - tolerance && back - front > tolerance;
  }

  void composite(std::size_t at, double front, double back, const PlainRadiance& radiance) {
    double& last = buffer_.last[at];
    if (out_of_order(at, front, back)) ++counts_.violations;
    last = std::max(last, back);
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
  double longest_unit_;  // world length per unit of the ray parameter, at most
  // of the cell at hand
  CellScalars extinction_{}, color_{};
  CutsAlongRay cuts_;
  ToleranceShares shares_{};
  CellKind kind_{};
  bool curved_ = false;        // it has curved faces
  bool is_empty_ = false;      // neither absorbs nor shines
  bool is_cut_ = false;        // by surfaces
  bool is_uniform_ = false;    // colour and extinction have one value
  bool are_doubtful_ = false;  // CutsAlongRay::doubtful of the segment at hand
  CrossingRuns runs_;
  std::vector<CellCrossing> crossings_;
  CellSegments segments_;          // of runs_, and then of crossings_
  std::vector<std::size_t> kept_;  // of crossings_, those that segments_ has
  std::vector<CutSegment> cut_segments_;
  std::vector<IsosurfaceCrossing> all_surfaces_;  // of these
  std::vector<FieldAlongRay::Piece> pieces_;
  std::vector<IsosurfaceCrossing> surfaces_;                 // of the segment at hand
  std::vector<IsosurfaceCrossing> alone_;                    // scratch
  std::array<CellMap::Point, CellMap::kMostNodes> nodes_{};  // relative (projection.hpp)
  // where details are asked for
  CellErrors errors_;
  SegmentDetails details_;  // of the segment at hand
  ErrorBound quadrature_;   // of its part that was integrated last
  double weight_ = 0, weighted_depth_ = 0;
};

}  // namespace

void render_general_cells(const Frame& frame, std::span<const CellId> cells, const TileRect& tile,
                          TileBuffer& buffer, SegmentList* group, TileCounts& counts) {
  GeneralCellRenderer renderer(frame, tile, buffer, group, counts);
  for (const CellId cell : cells) {
    check_cancelled();
    renderer.render(cell);
  }
}

}  // namespace hiac

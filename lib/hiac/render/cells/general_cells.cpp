#include "hiac/render/cells/general_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "hiac/base/cancellation.hpp"
#include "hiac/element/field_along_ray.hpp"
#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/bounds/cell_errors.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/cells/cell_segments.hpp"
#include "hiac/render/cells/cuts_along_ray.hpp"
#include "hiac/render/cells/planar_crossing.hpp"
#include "hiac/render/cells/volume_along_ray.hpp"
#include "hiac/render/integrate/cell_integrals.hpp"
#include "hiac/render/pixels/compositor.hpp"

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
        volume_(frame, tile),
        cuts_(frame),
        errors_(frame, volume_.longest()) {}

  void render(CellId cell) {
    volume_.enter(cell);
    is_empty_ = volume_.is_empty();
    const RayDisplacement displacement =
        frame_.with_error ? ray_displacement(frame_, cell) : RayDisplacement{};
    is_cut_ = cuts_.enter(cell, displacement);
    if (is_empty_ && !is_cut_) return;
    kind_ = frame_.mesh.kinds[cell];
    curved_ = frame_.is_curved(cell);
    const bool together = optics_.rule == PieceRule::exact && !volume_.is_uniform() && !is_empty_ &&
                          !volume_.extinction().nodes.polynomial &&
                          !volume_.color().nodes.polynomial;
    scan(cell, together && !curved_ && !is_cut_);
    if (crossings_.empty() && runs_.count == 0) return;
    nodes_ = relative_positions(frame_.mesh, cell, frame_.projector);
    const CellMap map(kind_, nodes_, frame_.straightness);
    const FieldAlongRay field(kind_, map, volume_.fields());
    if (frame_.with_error)
      errors_.enter(cell, nodes_, volume_.color(), volume_.extinction(), displacement);
    if (is_cut_)
      render_cut_together(map, field, together);
    else if (together)
      render_together(map, field);
    else
      for (const CellCrossing& crossing : crossings_) render(crossing, field, {});
  }

 private:
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

  // Segments of the cell many at a time.
  void render_together(const CellMap& map, const FieldAlongRay& field) {
    segments_.start(runs_.count + crossings_.size(), curved_);
    collect_runs(frame_, runs_, tile_, buffer_, volume_.allowed_error(0, 1, 1), group_ == nullptr,
                 segments_);
    const std::size_t of_runs = segments_.count;
    collect_segments(map);
    if (segments_.count == 0) return;
    integrate_together(map);
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

  void integrate_together(const CellMap& map) {
    const CellPolynomials polynomials(kind_, nodes_, map, volume_.fields());
    const IntervalRange color = volume_.color().intervals;
    const IntervalRange extinction = volume_.extinction().intervals;
    integrate_cell_segments(frame_, polynomials,
                            {color.low, color.high, extinction.low, extinction.high}, segments_);
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
  void render_cut_together(const CellMap& map, const FieldAlongRay& field, bool with_parts) {
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
      integrate_together(map);
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
    segments_.allowed[k] = volume_.allowed_error(0, 1, 1) * (back - front) / seen;
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
      composite(at, front, back, radiance, frame_.witness_tolerance, buffer_, counts_);
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
      radiance = volume_.radiance(stretch, scale, field, visible);
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
        r = volume_.radiance({stretch.origin, stretch.direction, front, back, stretch.known}, scale,
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

  // Notes the bound of the last quadrature, of a part that is seen through `visible` of the
  // segment.
  void add_quadrature(double visible, const PlainRadiance& part) {
    details_.radiance_error += visible * volume_.quadrature().radiance +
                               details_.transparency_error * std::ranges::max(part.rgb);
    details_.transparency_error += visible * volume_.quadrature().transparency;
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
    details_.out_of_order =
        out_of_order(stretch.front, stretch.back, buffer_.last[at], frame_.witness_tolerance);
    buffer_.describe(at, details_);
  }

  // Segment k of segments_, of runs_.
  [[nodiscard]] CellCrossing plain_crossing(std::size_t k) const {
    return planar_crossing(frame_.projector, static_cast<int>(segments_.x[k]),
                           static_cast<int>(segments_.y[k]), segments_.front[k], segments_.back[k]);
  }

  const Frame& frame_;
  const OpticsTables& optics_;
  const TileRect& tile_;
  TileBuffer& buffer_;
  SegmentList* group_;
  TileCounts& counts_;
  // of the cell at hand
  VolumeAlongRay volume_;
  CutsAlongRay cuts_;
  CellKind kind_{};
  bool curved_ = false;        // it has curved faces
  bool is_empty_ = false;      // neither absorbs nor shines
  bool is_cut_ = false;        // by surfaces
  bool are_doubtful_ = false;  // CutsAlongRay::doubtful of the segment at hand
  CrossingRuns runs_;
  std::vector<CellCrossing> crossings_;
  CellSegments segments_;          // of runs_, and then of crossings_
  std::vector<std::size_t> kept_;  // of crossings_, those that segments_ has
  std::vector<CutSegment> cut_segments_;
  std::vector<IsosurfaceCrossing> all_surfaces_;             // of these
  std::vector<IsosurfaceCrossing> surfaces_;                 // of the segment at hand
  std::vector<IsosurfaceCrossing> alone_;                    // scratch
  std::array<CellMap::Point, CellMap::kMostNodes> nodes_{};  // relative (projection.hpp)
  // where details are asked for
  CellErrors errors_;
  SegmentDetails details_;  // of the segment at hand
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

#include "hiac/render/cells/general_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "hiac/base/cancellation.hpp"
#include "hiac/element/field_along_ray.hpp"
#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/bounds/cell_errors.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/cells/cell_batch.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/cells/cuts_along_ray.hpp"
#include "hiac/render/cells/planar_crossing.hpp"
#include "hiac/render/cells/segment_notes.hpp"
#include "hiac/render/cells/volume_along_ray.hpp"
#include "hiac/render/pixels/compositor.hpp"

namespace hiac {
namespace {

// Lower bound of the transparency in front: behind an opaque surface it is 0, and a tolerance
// divided by this bound is still finite.
constexpr double kLeastVisible = 1e-100;

class GeneralCellRenderer {
 public:
  explicit GeneralCellRenderer(const TileTarget& to)
      : to_(to),
        frame_(to.frame),
        volume_(frame_, to.tile),
        cuts_(frame_),
        batch_(to, volume_),
        errors_(frame_, volume_.longest()) {}

  void render(CellId cell) {
    volume_.enter(cell);
    is_empty_ = volume_.is_empty();
    const RayDisplacement displacement =
        frame_.with_error ? ray_displacement(frame_, cell) : RayDisplacement{};
    is_cut_ = cuts_.enter(cell, displacement);
    if (is_empty_ && !is_cut_) return;
    const CellKind kind = frame_.mesh.kinds[cell];
    const bool curved = frame_.is_curved(cell);
    const bool together = frame_.optics.rule == PieceRule::exact && !volume_.is_uniform() &&
                          !is_empty_ && !volume_.extinction().nodes.polynomial &&
                          !volume_.color().nodes.polynomial;
    scan(cell, together && !curved && !is_cut_);
    if (crossings_.empty() && runs_.count == 0) return;
    nodes_ = relative_positions(frame_.mesh, cell, frame_.projector);
    const CellMap map(kind, nodes_, frame_.straightness);
    const FieldAlongRay field(kind, map, volume_.fields());
    batch_.enter(kind, curved, nodes_, map);
    if (frame_.with_error)
      errors_.enter(cell, nodes_, volume_.color(), volume_.extinction(), displacement);
    if (is_cut_)
      render_cut_together(map, field, together);
    else if (together)
      render_together(field);
    else
      for (const CellCrossing& crossing : crossings_) render(crossing, field, {});
  }

 private:
  // Scans a cell: crossings go to runs_ where possible if `by_runs`, the rest to crossings_.
  void scan(CellId cell, bool by_runs) {
    crossings_.clear();
    runs_.clear();
    if (by_runs) {
      const CellSurface surface =
          cell_surface(frame_.mesh.kinds[cell], frame_.mesh.cell_nodes(cell));
      if (is_projectable(frame_, surface))
        return scan_projected_runs(frame_, surface, to_.tile, runs_, crossings_);
    }
    scan_cell(frame_, cell, to_.tile, crossings_);
  }

  [[nodiscard]] std::size_t index_of(const CellCrossing& crossing) const {
    return to_.tile.index(crossing.x, crossing.y);
  }

  // Renders the segments of the cell many at a time.
  void render_together(const FieldAlongRay& field) {
    batch_.start(runs_.count + crossings_.size());
    batch_.append_runs(runs_);
    const std::size_t of_runs = batch_.segments().count;
    batch_.append_crossings(crossings_);
    if (batch_.segments().count == 0) return;
    batch_.integrate();
    const bool one_by_one = to_.group != nullptr || to_.runs != nullptr || frame_.with_details;
    if (!one_by_one)
      to_.counts.violations += composite_segments(frame_, batch_.segments(), of_runs, to_.buffer);
    for (std::size_t k = 0; k < of_runs; ++k)
      if (one_by_one || !batch_.is_done(k))
        render_or_add(k, plain_crossing(k), field);
      else
        ++to_.counts.segments;
    for (std::size_t k = of_runs; k < batch_.segments().count; ++k)
      render_or_add(k, crossings_[batch_.kept()[k - of_runs]], field);
  }

  // The surfaces that cross a segment, and the parts of the segment in front of, between and behind
  // them.
  struct CutSegment {
    std::size_t crossing;                   // index into crossings_
    std::size_t first_surface, count;       // range of all_surfaces_
    bool doubtful;                          // CutsAlongRay::doubtful
    std::optional<std::size_t> first_part;  // index into batch_, which has the parts of length > 0
  };

  // Does the same where surfaces cross the cell. `with_parts`: the volume between the surfaces can
  // be integrated together as well.
  void render_cut_together(const CellMap& map, const FieldAlongRay& field, bool with_parts) {
    batch_.start(crossings_.size());
    batch_.append_crossings(crossings_);
    cuts_.interpolate(map, batch_.segments());
    find_surfaces(map);
    if (with_parts) {
      batch_.start(cut_segments_.size() + all_surfaces_.size());
      for (CutSegment& cut : cut_segments_) {
        const CellCrossing& crossing = crossings_[cut.crossing];
        cut.first_part = batch_.segments().count;
        for_parts(stretch_of(frame_.projector, crossing), surfaces_of(cut),
                  [&](double front, double back) { batch_.append(crossing, front, back); });
      }
      batch_.integrate();
    }
    for (const CutSegment& cut : cut_segments_)
      render(crossings_[cut.crossing], field, {.cut = &cut});
  }

  // Finds the surfaces on all crossings; batch_ holds some of these crossings.
  void find_surfaces(const CellMap& map) {
    cut_segments_.clear();
    all_surfaces_.clear();
    std::size_t k = 0;
    for (std::size_t i = 0; i < crossings_.size(); ++i) {
      std::optional<std::size_t> segment;
      if (k < batch_.kept().size() && batch_.kept()[k] == i) segment = k++;
      const RayStretch stretch = stretch_of(frame_.projector, crossings_[i]);
      if (!to_.is_seen(index_of(crossings_[i])) || stretch.front > stretch.back) continue;
      cuts_.find(map, crossings_[i], stretch, segment, surfaces_);
      bool doubtful = cuts_.doubtful();
      if (segment && frame_.with_error) doubtful = !check_surfaces(map, crossings_[i], stretch);
      cut_segments_.push_back({i, all_surfaces_.size(), surfaces_.size(), doubtful, {}});
      all_surfaces_.insert(all_surfaces_.end(), surfaces_.begin(), surfaces_.end());
    }
  }

  // Gives surfaces_, which come from interpolants without error bounds, the bounds of the surfaces
  // found for this ray alone, increased by the distance between the two results. Returns false if
  // the two results may be different surfaces.
  bool check_surfaces(const CellMap& map, const CellCrossing& crossing, const RayStretch& stretch) {
    cuts_.find(map, crossing, stretch, {}, alone_);
    if (cuts_.doubtful() || alone_.size() != surfaces_.size()) return false;
    for (std::size_t i = 0; i < alone_.size(); ++i) {
      const IsosurfaceCrossing& alone = alone_[i];
      IsosurfaceCrossing& together = surfaces_[i];
      if (alone.surface != together.surface) return false;
      together.moved = alone.moved + std::abs(together.t - alone.t);
      together.shade_error = alone.shade_error;
      const ErrorBound bound = apart(together.shade.rgb, together.shade.transparency,
                                     alone.shade.rgb, alone.shade.transparency);
      together.shade_error.radiance += bound.radiance;
      together.shade_error.transparency += bound.transparency;
    }
    return true;
  }

  [[nodiscard]] std::span<const IsosurfaceCrossing> surfaces_of(const CutSegment& cut) const {
    return std::span(all_surfaces_).subspan(cut.first_surface, cut.count);
  }

  // Calls, front to back, volume(front, back) for the parts of length > 0 of a stretch between
  // surfaces, and surface(crossing) for the surfaces.
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

  // Composites segment k of batch_ if it is done and no details are requested; otherwise renders it
  // by itself.
  void render_or_add(std::size_t k, const CellCrossing& crossing, const FieldAlongRay& field) {
    const PlainRadiance radiance = batch_.radiance(k);
    const CellSegments& s = batch_.segments();
    if (!batch_.is_done(k) || frame_.with_details)
      return render(crossing, field, {.radiance = batch_.is_done(k) ? &radiance : nullptr});
    if (!to_.is_seen(s.at[k])) return;
    ++to_.counts.segments;
    composite(to_, s.at[k], s.front[k], s.back[k], radiance);
  }

  // The results of a segment that was processed together with others, if any: its radiance, or that
  // of its parts between surfaces.
  struct Together {
    const PlainRadiance* radiance = nullptr;
    const CutSegment* cut = nullptr;
  };

  void render(const CellCrossing& crossing, const FieldAlongRay& field, const Together& together) {
    const std::size_t at = index_of(crossing);
    if (!to_.is_seen(at)) return;
    const RayStretch stretch = stretch_of(frame_.projector, crossing);
    // surfaces that cross a stretch of length 0 are visible nevertheless
    if (is_cut_ ? stretch.front > stretch.back : !(stretch.front < stretch.back)) return;
    ++to_.counts.segments;
    const double visible = to_.visible(at), scale = to_.buffer.ray_scale[at];
    notes_.begin(stretch.front, stretch.back);
    PlainRadiance radiance;
    if (together.cut != nullptr) {
      const auto surfaces = surfaces_of(*together.cut);
      surfaces_.assign(surfaces.begin(), surfaces.end());
      are_doubtful_ = together.cut->doubtful;
      radiance = between_surfaces(stretch, scale, field, visible, together.cut->first_part);
    } else if (together.radiance == nullptr || frame_.with_error) {
      radiance = volume_.radiance(stretch, scale, field, visible);
      notes_.add_quadrature(1, volume_.quadrature(), radiance);
    }
    if (together.radiance != nullptr) {
      if (frame_.with_error) notes_.add_apart(1, *together.radiance, radiance);
      radiance = *together.radiance;
    }
    if (frame_.with_details) describe_segment(at, crossing, field, stretch, scale, radiance);
    composite(to_, at, stretch.front, stretch.back, radiance);
  }

  // The radiance of a stretch with surfaces_ and the volume between them. `part`: index of the
  // first part in batch_.
  [[nodiscard]] PlainRadiance between_surfaces(const RayStretch& stretch, double scale,
                                               const FieldAlongRay& field, double visible,
                                               std::optional<std::size_t> part) {
    PlainRadiance sum;
    const auto volume = [&](double front, double back) {
      if (is_empty_) return;
      const double before = sum.transparency;
      const bool is_known = part && batch_.is_done(*part);
      PlainRadiance r;
      if (!is_known || frame_.with_error) {
        r = volume_.radiance({stretch.origin, stretch.direction, front, back, stretch.known}, scale,
                             field, std::max(visible * before, kLeastVisible));
        notes_.add_quadrature(before, volume_.quadrature(), r);
      }
      if (is_known) {
        if (frame_.with_error) notes_.add_apart(before, batch_.radiance(*part), r);
        r = batch_.radiance(*part);
      }
      sum.add_behind(r);
      if (part) ++*part;
      notes_.add_depth(0.5 * (front + back), before - sum.transparency);
    };
    const auto surface = [&](const IsosurfaceCrossing& s) {
      const double before = sum.transparency;
      sum.add_behind({s.shade.rgb, s.shade.transparency});
      notes_.add_depth(s.t, before - sum.transparency);
    };
    for_parts(stretch, surfaces_, volume, surface);
    return sum;
  }

  // Adds the details of the current segment to its pixel or group.
  void describe_segment(std::size_t at, const CellCrossing& crossing, const FieldAlongRay& field,
                        const RayStretch& stretch, double scale, const PlainRadiance& radiance) {
    SegmentDetails details = notes_.finish(radiance);
    if (is_empty_ && !surfaces_.empty()) details.first = surfaces_.front().t;
    if (frame_.with_error) {
      std::optional<CellErrors::Cut> cut;
      if (is_cut_) cut = {surfaces_, are_doubtful_};
      errors_.add(crossing, stretch, scale, field, cut, details);
    }
    describe(to_, at, details);
  }

  // The crossing of segment k of batch_, which comes from runs_.
  [[nodiscard]] CellCrossing plain_crossing(std::size_t k) const {
    const CellSegments& s = batch_.segments();
    return planar_crossing(frame_.projector, static_cast<int>(s.x[k]), static_cast<int>(s.y[k]),
                           s.front[k], s.back[k]);
  }

  TileTarget to_;
  const Frame& frame_;
  // of the current cell
  VolumeAlongRay volume_;
  CutsAlongRay cuts_;
  bool is_empty_ = false;      // neither absorbs nor shines
  bool is_cut_ = false;        // surfaces cross the cell
  bool are_doubtful_ = false;  // CutsAlongRay::doubtful of the current segment
  CrossingRuns runs_;
  std::vector<CellCrossing> crossings_;
  CellBatch batch_;  // segments of runs_, then of crossings_
  std::vector<CutSegment> cut_segments_;
  std::vector<IsosurfaceCrossing> all_surfaces_;             // of cut_segments_
  std::vector<IsosurfaceCrossing> surfaces_;                 // of the segment at hand
  std::vector<IsosurfaceCrossing> alone_;                    // scratch
  std::array<CellMap::Point, CellMap::kMostNodes> nodes_{};  // relative (projection.hpp)
  // used if details are requested
  CellErrors errors_;
  SegmentNotes notes_;  // of the segment at hand
};

}  // namespace

void render_general_cells(const TileTarget& to, std::span<const CellId> cells) {
  GeneralCellRenderer renderer(to);
  for (const CellId cell : cells) {
    check_cancelled();
    renderer.render(cell);
  }
}

}  // namespace hiac

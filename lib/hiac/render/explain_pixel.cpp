#include "hiac/render/explain_pixel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/element/field_along_ray.hpp"
#include "hiac/frame/background.hpp"
#include "hiac/frame/cell_groups.hpp"
#include "hiac/frame/tiles/tile_bins.hpp"
#include "hiac/optics/polynomial_piece.hpp"
#include "hiac/render/bounds/bounded_scene.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/cells/cuts_along_ray.hpp"
#include "hiac/render/cells/planar_crossing.hpp"
#include "hiac/render/draw_cells.hpp"
#include "hiac/render/edges/screen_edges.hpp"
#include "hiac/render/edges/tile_edges.hpp"
#include "hiac/render/refine/pixel_refinement.hpp"
#include "hiac/render/skin_painter.hpp"

namespace hiac {
namespace {

// The accuracy of Psi.
constexpr double kPsiTolerance = 1e-13;

void require_explainable(const Scene& scene, std::uint32_t x, std::uint32_t y) {
  if (x >= scene.image.width || y >= scene.image.height)
    throw UsageError(
        fmt::format("pixel {},{}: not in the picture (expected columns 0 to {} and rows 0 to {})",
                    x, y, scene.image.width - 1, scene.image.height - 1));
  if (scene.render.splat_below > 0)
    throw UsageError(
        "a pixel is explained by ray segments, and splats are none (`render.splat_below` = 0 "
        "expected)");
}

// Psi of a segment. `fields`: that of extinction and, if it differs, that of colour.
double mean_transparency(const OpticsTables& optics, std::span<const FieldAlongRay::Piece> fields,
                         double length) {
  if (!(length > 0)) return 1;
  const PiecewiseLinear<3> one(std::vector<PiecewiseLinear<3>::Point>{{0, {1, 1, 1}}});
  double light = 0, transparency = 1;
  // the light of a medium that emits 1 everywhere is the length times Psi
  for (const FieldAlongRay::Piece& piece : fields) {
    const double part = (piece.end - piece.begin) * length;
    const SegmentRadiance r = integrate_segment(
        {piece.fields[0], piece.fields[0], part}, one, optics.extinction_function, Glow::emission,
        std::max(kPsiTolerance * part, std::numeric_limits<double>::min()));
    light += transparency * r.rgb[0];
    transparency *= r.transparency;
  }
  return light / length;
}

void append(const SegmentList& all, std::size_t i, SegmentList& list) {
  list.segments.push_back(all.segments[i]);
  list.details.push_back(all.details[i]);
}

std::vector<std::uint32_t> sorted_along_ray(const SegmentList& found) {
  std::vector<std::uint32_t> sorted(found.segments.size());
  std::iota(sorted.begin(), sorted.end(), 0U);
  std::ranges::sort(sorted, [&](std::uint32_t a, std::uint32_t b) { return found.nearer(a, b); });
  return sorted;
}

class RayFollower {
 public:
  // `background`: the largest channel of the background.
  RayFollower(const Frame& frame, const ScreenEdges& edges, const TileRect& tile, int x, int y,
              double background)
      : frame_(frame),
        edges_(edges),
        tile_(tile),
        tile_edges_(frame, edges, tile),
        painter_(frame, edges, tile_edges_),
        x_(x),
        y_(y),
        at_(tile.index(x, y)),
        background_(background),
        cuts_(frame) {
    buffer_.reset(tile, frame.projector, frame.with_details);
  }

  // A cell whose place in the order is known. The engine composites its segments itself.
  void follow(CellId cell) {
    SegmentList found, others;
    TileEdges left = tile_edges_;  // looking takes no edge away, and adds no error
    SkinPainter looking(frame_, edges_, left);
    const PixelDetails before = buffer_.details[at_];
    deal_out(
        [&](const TileTarget& to) {
          draw(cell, looking, to.group);
          looking.settle(to);
        },
        found, others);
    buffer_.details[at_] = before;
    if (found.segments.empty()) return draw(cell, painter_, nullptr);
    const std::vector<std::uint32_t> sorted = sorted_along_ray(found);
    TileBuffer so_far = buffer_;
    for (std::size_t i = 0; i + 1 < sorted.size(); ++i) composite(cell, found, sorted[i], so_far);
    const std::uint32_t violations = buffer_.details[at_].violations;
    draw(cell, painter_, nullptr);
    add_row(cell, found, sorted.back(), buffer_, buffer_.details[at_].violations > violations);
  }

  // Follows cells that the engine sorts along the ray.
  void follow_group(std::span<const CellId> cells) {
    SegmentList all, found, others;
    const TileTarget to{frame_, tile_, buffer_, &all, counts_};
    std::vector<CellId> owners_of_all, owners;
    for (const CellId cell : cells) {
      draw(cell, painter_, &all);
      owners_of_all.resize(all.segments.size(), cell);
    }
    const std::vector<CellId> met_at = painter_.settle(to);
    owners_of_all.insert(owners_of_all.begin(), met_at.begin(), met_at.end());
    for (std::size_t i = 0; i < all.segments.size(); ++i) {
      const bool here = all.segments[i].pixel == at_;
      append(all, i, here ? found : others);
      if (here) owners.push_back(owners_of_all[i]);
    }
    const std::vector<std::uint32_t> sorted = sorted_along_ray(found);
    std::vector<SegmentDetails> details(found.details);
    for (std::size_t i = 0; i < sorted.size(); ++i)
      details[sorted[i]] = details_in_order(found, sorted, i);
    found.details = std::move(details);
    for (const std::uint32_t i : sorted) {
      composite(owners[i], found, i, buffer_);
      rows_.back().in_group = true;
    }
    composite_sorted(others, frame_.witness_tolerance, buffer_, counts_);
  }

  // Edges beside all cells that the rays pass.
  void follow_rest() {
    SegmentList found, others;
    deal_out([&](const TileTarget& to) { tile_edges_.append_rest(to); }, found, others);
    for (const std::uint32_t i : sorted_along_ray(found)) composite(kNoCell, found, i, buffer_);
  }

  [[nodiscard]] std::vector<PixelSegment> take_rows() { return std::move(rows_); }
  [[nodiscard]] Color color() const { return color_of(buffer_); }
  [[nodiscard]] double transparency() const { return buffer_.transparency[at_]; }
  // The error bound of the finished pixel, as in the picture's channel.
  [[nodiscard]] std::optional<double> error(PixelRefinement& refinement) const {
    if (!frame_.with_error) return std::nullopt;
    return refinement.error(buffer_, at_, background_);
  }

 private:
  // In the whole tile, as the engine does: what the tile's pixels share is the same, too.
  void draw(CellId cell, SkinPainter& painter, SegmentList* group) {
    const TileTarget to{frame_, tile_, buffer_, group, counts_};
    if (painter.concerns(cell))
      painter.draw(to, cell, true);
    else
      draw_for(frame_, cell)(to, {&cell, 1});
  }

  // Appends what is drawn in the pixel, and what is in the tile's other pixels.
  template <typename Draw>
  void deal_out(const Draw& draw, SegmentList& found, SegmentList& others) {
    SegmentList all;
    draw(TileTarget{frame_, tile_, buffer_, &all, counts_});
    for (std::size_t i = 0; i < all.segments.size(); ++i)
      append(all, i, all.segments[i].pixel == at_ ? found : others);
  }

  // One segment of a list, noted behind what a buffer holds.
  void composite(CellId cell, const SegmentList& found, std::size_t i, TileBuffer& buffer) {
    TileCounts counts;
    SegmentList one;
    append(found, i, one);
    composite_sorted(one, frame_.witness_tolerance, buffer, counts);
    add_row(cell, found, i, buffer, counts.violations > 0);
  }

  [[nodiscard]] Color color_of(const TileBuffer& buffer) const {
    return {buffer.red[at_], buffer.green[at_], buffer.blue[at_]};
  }
  [[nodiscard]] std::optional<double> error_of(const TileBuffer& buffer) const {
    if (!frame_.with_error) return std::nullopt;
    const double transparency = buffer.transparency[at_];
    return pixel_error(frame_, buffer.details[at_], transparency,
                       transparency <= frame_.least_transparency, background_);
  }

  // `after`: the pixel behind the segment.
  void add_row(CellId cell, const SegmentList& found, std::size_t i, const TileBuffer& after,
               bool out_of_order) {
    PixelSegment row;
    row.part = found.details[i].part;
    row.cell = cell;
    row.out_of_order = out_of_order;
    const double front = found.segments[i].front, back = found.segments[i].back;
    row.transparency = after.transparency[at_];
    row.color = color_of(after);
    row.error = error_of(after);
    if (cell != kNoCell) row.kind = frame_.mesh.kinds[cell];
    if (row.part != RayPart::inside) {
      row.front.depth = row.back.depth = frame_.projector.distance(front);
      row.light = found.segments[i].light.rgb;
      row.opacity = 1 - found.segments[i].light.transparency;
      rows_.push_back(std::move(row));
      return;
    }
    row.length = (back - front) * after.ray_scale[at_];
    const CellMap map(row.kind, relative_positions(frame_.mesh, cell, frame_.projector),
                      frame_.straightness);
    const CellCrossing* crossing = crossing_of(cell, front);
    CellCrossing part = planar_crossing(frame_.projector, x_, y_, front, back);
    if (crossing != nullptr) part.front_reference = place_of(*crossing);
    set_fields(row, map, stretch_of(frame_.projector, part));
    if (crossing != nullptr) find_surfaces(row, map, *crossing);
    rows_.push_back(std::move(row));
  }

  // The crossing of a cell that the engine has begin at a place after z-clipping.
  [[nodiscard]] const CellCrossing* crossing_of(CellId cell, double front) {
    crossings_.clear();
    scan_cell(frame_, cell, tile_, crossings_);
    std::erase_if(crossings_, [&](const CellCrossing& c) { return c.x != x_ || c.y != y_; });
    if (crossings_.empty()) return nullptr;
    return &*std::ranges::min_element(crossings_, {}, [&](const CellCrossing& c) {
      return std::abs(std::max(c.front, frame_.projector.near()) - front);
    });
  }

  void set_fields(PixelSegment& row, const CellMap& map, const RayStretch& part) {
    const OpticsTables& optics = frame_.optics;
    const std::array<CellField, 2> fields{cell_field(frame_.mesh, row.cell, frame_.extinction),
                                          cell_field(frame_.mesh, row.cell, frame_.color_field())};
    FieldAlongRay(row.kind, map, fields).along(part, pieces_);
    const auto end = [&](const FieldAlongRay::Piece& piece, double u, double t) {
      SegmentEnd result;
      result.depth = frame_.projector.distance(t);
      result.extinction_field = evaluate(piece.fields[0], u);
      result.color_field = evaluate(piece.fields[1], u);
      result.tau = optics.extinction_function(result.extinction_field)[0];
      result.kappa = optics.color_function(result.color_field);
      return result;
    };
    row.front = end(pieces_.front(), 0, part.front);
    row.back = end(pieces_.back(), 1, part.back);
    row.psi = mean_transparency(optics, pieces_, row.length);
  }

  void find_surfaces(PixelSegment& row, const CellMap& map, const CellCrossing& crossing) {
    if (!cuts_.enter(row.cell,
                     frame_.with_error ? ray_displacement(frame_, row.cell) : RayDisplacement{}))
      return;
    cuts_.find(map, crossing, stretch_of(frame_.projector, crossing), {}, surfaces_);
    for (const IsosurfaceCrossing& met : surfaces_)
      row.surfaces.push_back(
          {static_cast<std::size_t>(met.surface - frame_.isosurfaces.surfaces.data()),
           frame_.projector.distance(met.t), met.shade.rgb, 1 - met.shade.transparency});
  }

  const Frame& frame_;
  const ScreenEdges& edges_;
  TileRect tile_;
  TileEdges tile_edges_;
  SkinPainter painter_;
  int x_, y_;
  std::size_t at_;  // of the pixel in the tile's planes
  double background_;
  TileBuffer buffer_;
  TileCounts counts_;
  std::vector<PixelSegment> rows_;
  // scratch
  CutsAlongRay cuts_;
  std::vector<FieldAlongRay::Piece> pieces_;
  std::vector<CellCrossing> crossings_;
  std::vector<IsosurfaceCrossing> surfaces_;
};

}  // namespace

PixelExplanation explain_pixel(const ZooMesh& mesh, const VisibilityOrder& order,
                               const Scene& scene, std::uint32_t x, std::uint32_t y,
                               bool with_background) {
  require_explainable(scene, x, y);
  const Projector projector(scene.camera, scene.image);
  const bool is_bounded = !reason_unbounded(scene);
  const Frame frame(mesh, scene, projector, is_bounded ? Details::bounded : Details::described);

  PixelExplanation result;
  result.x = x;
  result.y = y;
  if (with_background) result.background = background_at(scene.background, scene.image, x, y);
  const TileBins bins = bin_cells(frame, order, scene.image, {x, y, 1, 1});
  const auto ranks = bins.cells_of(0);
  const ScreenEdges edges(frame, scene);
  RayFollower ray(frame, edges, bins.tiles.front(), static_cast<int>(x), static_cast<int>(y),
                  std::ranges::max(result.background));
  for (auto left = ranks; !left.empty();) {
    const CellRun run = first_run(order, left, 1);
    std::vector<CellId> cells;
    for (const std::uint32_t rank : run.ranks) cells.push_back(order.cells[rank]);
    if (run.is_group)
      ray.follow_group(cells);
    else
      ray.follow(cells.front());
    left = left.subspan(cells.size());
  }
  ray.follow_rest();

  result.transparency = ray.transparency();
  result.ended = result.transparency <= frame.least_transparency;
  PixelRefinement refinement(frame, order, bins.tiles.front(), ranks);
  result.error = ray.error(refinement);
  const Color color = ray.color();
  for (std::size_t c = 0; c < 3; ++c)
    result.rgba[c] = color[c] + result.transparency * result.background[c];
  result.rgba[3] = 1 - result.transparency;
  result.segments = ray.take_rows();
  return result;
}

}  // namespace hiac

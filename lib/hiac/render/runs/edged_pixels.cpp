#include "hiac/render/runs/edged_pixels.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "hiac/render/edges/pixel_layers.hpp"

namespace hiac {
namespace {

// A segment, or an end of a crossing.
struct Entry {
  std::uint32_t pixel;
  double middle;
  EdgedPhase phase;
  std::uint32_t part, index;  // of the part's segments or crossings

  [[nodiscard]] bool is_stop() const {
    return phase == EdgedPhase::stop_entered || phase == EdgedPhase::stop_left;
  }
  [[nodiscard]] auto key() const { return std::tie(pixel, middle, phase, part, index); }
};

std::vector<Entry> sorted_entries(std::span<const EdgedTile* const> parts) {
  std::vector<Entry> entries;
  for (std::uint32_t part = 0; part < parts.size(); ++part) {
    std::uint32_t index = 0;
    for (const EdgedSegment& s : parts[part]->segments)
      entries.push_back({s.pixel, s.middle, s.phase, part, index++});
    index = 0;
    for (const EdgedCrossing& c : parts[part]->crossings.rays) {
      entries.push_back({c.pixel, c.middle, EdgedPhase::stop_entered, part, index});
      entries.push_back({c.pixel, c.middle, EdgedPhase::stop_left, part, index++});
    }
  }
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) { return a.key() < b.key(); });
  return entries;
}

struct Fragment : EdgeFragment {
  bool is_taken = false;
};

// Every edge is drawn by one part, whose fragments of it come piece by piece.
std::vector<Fragment> sorted_fragments(std::span<const EdgedTile* const> parts) {
  std::vector<Fragment> fragments;
  for (const EdgedTile* part : parts)
    for (const EdgeFragment& fragment : part->fragments) fragments.push_back({fragment});
  std::ranges::stable_sort(
      fragments, {}, [](const Fragment& f) { return std::tuple(f.pixel, f.t, f.place.edge); });
  return fragments;
}

class Visitor {
 public:
  Visitor(std::span<const EdgedTile* const> parts, const EdgedView& view,
          const std::function<bool(const EdgedSegment&)>& composite)
      : parts_(parts), view_(view), composite_(composite) {}

  void run() {
    const std::vector<Entry> entries = sorted_entries(parts_);
    fragments_ = sorted_fragments(parts_);
    std::size_t entry = 0;
    for (std::size_t first = 0, end = 0; first < fragments_.size() || entry < entries.size();
         first = end) {
      std::uint32_t pixel = std::numeric_limits<std::uint32_t>::max();
      if (first < fragments_.size()) pixel = fragments_[first].pixel;
      if (entry < entries.size()) pixel = std::min(pixel, entries[entry].pixel);
      while (end < fragments_.size() && fragments_[end].pixel == pixel) ++end;
      own_ = std::span(fragments_).subspan(first, end - first);
      layers_ = {};
      bool is_seen = true;
      for (; entry < entries.size() && entries[entry].pixel == pixel; ++entry)
        is_seen = is_seen && meet(entries[entry]);
      for (const Fragment& left : own_)
        is_seen = is_seen && take(left.t, false, [&](const Fragment& f) { return &f == &left; });
    }
  }

 private:
  // Whether what lies behind is seen.
  bool meet(const Entry& entry) {
    const EdgedTile& part = *parts_[entry.part];
    if (!entry.is_stop()) return composite_(part.segments[entry.index]);
    const EdgedCrossing& ray = part.crossings.rays[entry.index];
    const auto is_met_at = [&](const EdgeStop& stop, const Fragment& f) {
      return lies_on(part.crossings, ray, stop, f.place, view_.projector, view_.tile);
    };
    const auto is_left_with = [&](const Fragment& f) { return is_met_at(ray.back, f); };
    if (entry.phase == EdgedPhase::stop_left) return take(ray.back.t, false, is_left_with);
    return take(ray.front.t, true, [&](const Fragment& f) {
      return is_met_at(ray.front, f) || (f.t < ray.middle && !is_left_with(f));
    });
  }

  // Composites the pixel's fragments that are not taken yet and that lie here, as TileEdges::take.
  template <typename LiesHere>
  bool take(double t, bool or_nearer, const LiesHere& lies_here) {
    strips_.clear();
    for (Fragment& fragment : own_) {
      if (fragment.is_taken || !lies_here(fragment)) continue;
      fragment.is_taken = true;
      strips_.push_back({fragment.strip, fragment.share});
      if (or_nearer) t = std::min(t, fragment.t);
    }
    return strips_.empty() || composite_(edge_at(t, own_.front().pixel));
  }

  // The strips that have been taken, as one layer.
  EdgedSegment edge_at(double t, std::uint32_t pixel) {
    const Edges& look = view_.look;
    const double opacity = own_.size() == 1
                               ? std::min(strips_.front().share, 1.0) * look.opacity
                               : layers_.add(strips_, pixel_center(view_.tile.column(pixel)),
                                             pixel_center(view_.tile.row(pixel)), look.opacity);
    EdgedSegment edge{
        .pixel = pixel,
        .is_edge = true,
        .middle = t,
        .front = t,
        .back = t,
        .light = {{opacity * look.color[0], opacity * look.color[1], opacity * look.color[2]},
                  1 - opacity},
        .details = {}};
    edge.details.front = edge.details.back = edge.details.first = edge.details.mean = t;
    edge.details.light = std::ranges::max(edge.light.rgb);
    edge.details.transparency = edge.light.transparency;
    edge.details.part = RayPart::edge;
    return edge;
  }

  std::span<const EdgedTile* const> parts_;
  const EdgedView& view_;
  const std::function<bool(const EdgedSegment&)>& composite_;
  std::vector<Fragment> fragments_;
  // of the pixel at hand
  std::span<Fragment> own_;
  PixelLayers layers_;
  std::vector<CoveringStrip> strips_;  // scratch
};

}  // namespace

void visit_edged(std::span<const EdgedTile* const> parts, const EdgedView& view,
                 const std::function<bool(const EdgedSegment&)>& composite) {
  Visitor(parts, view, composite).run();
}

}  // namespace hiac

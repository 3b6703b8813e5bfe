#include "hiac/render/runs/edged_pixels.hpp"

#include <algorithm>
#include <tuple>

namespace hiac {
namespace {

// A segment or a stop.
struct Entry {
  std::uint32_t pixel;
  double middle;
  EdgedPhase phase;
  std::uint32_t part, index;  // of the part's segments or stops

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
    for (const EdgeStop& s : parts[part]->stops)
      entries.push_back({s.pixel, s.middle,
                         s.enters ? EdgedPhase::stop_entered : EdgedPhase::stop_left, part,
                         index++});
  }
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) { return a.key() < b.key(); });
  return entries;
}

std::vector<EdgeFragment> sorted_fragments(std::span<const EdgedTile* const> parts) {
  std::vector<EdgeFragment> fragments;
  for (const EdgedTile* part : parts)
    fragments.insert(fragments.end(), part->fragments.begin(), part->fragments.end());
  std::ranges::sort(fragments, {}, [](const EdgeFragment& f) {
    return std::tuple(f.pixel, f.t, f.edge, f.share, f.node);
  });
  return fragments;
}

// Whether a fragment lies on a face, as for SkinPainter.
bool lies_on(const std::array<std::uint64_t, 4>& face, const EdgeFragment& fragment) {
  const auto has = [&](std::uint64_t node) { return std::ranges::find(face, node) != face.end(); };
  return has(fragment.node) || (has(fragment.edge[0]) && has(fragment.edge[1]));
}

class Visitor {
 public:
  Visitor(std::span<const EdgedTile* const> parts, const Edges& look,
          const std::function<bool(const EdgedSegment&)>& composite)
      : parts_(parts), look_(look), composite_(composite) {}

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
      bool is_seen = true;
      for (; entry < entries.size() && entries[entry].pixel == pixel; ++entry)
        is_seen = is_seen && meet(entries[entry]);
      if (is_seen && !own_.empty())
        take(pixel, nearest_left(), false, [](const EdgeFragment&) { return true; });
    }
  }

 private:
  // Whether what lies behind is seen.
  bool meet(const Entry& entry) {
    if (!entry.is_stop()) return composite_(parts_[entry.part]->segments[entry.index]);
    const EdgeStop& stop = parts_[entry.part]->stops[entry.index];
    const auto is_left_with = [&](const EdgeFragment& f) { return lies_on(stop.back_face, f); };
    if (!stop.enters) return take(stop.pixel, stop.t, false, is_left_with);
    return take(stop.pixel, stop.t, true, [&](const EdgeFragment& f) {
      return lies_on(stop.front_face, f) || (f.t < stop.middle && !is_left_with(f));
    });
  }

  [[nodiscard]] double nearest_left() const {
    for (const EdgeFragment& fragment : own_)
      if (fragment.share > 0) return fragment.t;
    return 0;
  }

  // Composites the pixel's fragments that are not taken yet and that lie here, as TileEdges::take.
  template <typename LiesHere>
  bool take(std::uint32_t pixel, double t, bool or_nearer, const LiesHere& lies_here) {
    double share = 0;
    for (EdgeFragment& fragment : own_) {
      if (fragment.share == 0 || !lies_here(fragment)) continue;
      share += fragment.share;
      fragment.share = 0;
      if (or_nearer) t = std::min(t, fragment.t);
    }
    if (share == 0) return true;
    const double opacity = std::min(share, 1.0) * look_.opacity;
    EdgedSegment edge{
        .pixel = pixel,
        .is_edge = true,
        .middle = t,
        .front = t,
        .back = t,
        .light = {{opacity * look_.color[0], opacity * look_.color[1], opacity * look_.color[2]},
                  1 - opacity},
        .details = {}};
    edge.details.front = edge.details.back = edge.details.first = edge.details.mean = t;
    edge.details.light = std::ranges::max(edge.light.rgb);
    edge.details.transparency = edge.light.transparency;
    edge.details.part = RayPart::edge;
    return composite_(edge);
  }

  std::span<const EdgedTile* const> parts_;
  const Edges& look_;
  const std::function<bool(const EdgedSegment&)>& composite_;
  std::vector<EdgeFragment> fragments_;  // the share of those that are taken is 0
  std::span<EdgeFragment> own_;          // of the pixel at hand
};

}  // namespace

void visit_edged(std::span<const EdgedTile* const> parts, const Edges& look,
                 const std::function<bool(const EdgedSegment&)>& composite) {
  Visitor(parts, look, composite).run();
}

}  // namespace hiac

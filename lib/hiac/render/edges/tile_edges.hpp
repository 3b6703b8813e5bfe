#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/pixel_mask.hpp"
#include "hiac/render/edges/pixel_layers.hpp"
#include "hiac/render/edges/screen_edges.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// The edges in one tile as fragments of its pixels, each taken once: where its place along the ray
/// is reached.
///
/// A fragment is the part of a straight piece that covers a pixel, by the exact area of the piece's
/// strip in the pixel's square. Its depth is that of the piece's point nearest to the pixel's
/// centre. Fragments that are taken together are one layer. What several fragments cover of a pixel
/// together is found from samples (pixel_layers.hpp): where they overlap they count once, so that
/// lines neither darken the nodes at which they meet nor hide more behind them than they cover.
class TileEdges {
 public:
  /// All arguments must outlive it.
  TileEdges(const Frame& frame, const ScreenEdges& edges, const TileRect& tile);

  [[nodiscard]] bool empty() const { return fragments_.empty(); }
  /// The pixels that have fragments which are not taken yet.
  [[nodiscard]] const PixelMask& left() const { return left_; }
  /// Whether a cell may meet fragments which are not taken yet.
  [[nodiscard]] bool may_meet(CellId cell) const;
  /// The transparency of all that has been composited of edges in a pixel.
  [[nodiscard]] double transparency(std::size_t at) const {
    return transparency_.empty() ? 1 : transparency_[at];
  }

  /// The point of an edge that is nearest to a pixel's centre.
  struct Place {
    const EdgePiece* piece;
    double along;  ///< the whole edge, from 0 to 1
    double t;      ///< ray parameter of the plane parallel to the screen through it
    NodeId node;   ///< the edge's end that a line's half width and half a pixel reach, or kNoNode
  };

  /// Composites those fragments of a pixel that are not taken yet and of which lies_here(place) is
  /// true. They lie at the ray parameter `at_parameter` or, `or_nearer`, at the nearest of their
  /// own if that is nearer. In a group of cells they are sorted in at `at_parameter`, as the faces
  /// decide what is in front; settle() completes them.
  template <typename LiesHere>
  void take(const TileTarget& to, std::size_t at, double at_parameter, bool or_nearer,
            const LiesHere& lies_here) {
    if (!left_.holds(at)) return;
    taken_.clear();
    double depth = at_parameter;
    bool all = true;
    for (std::uint32_t k = first_[at]; k < first_[at + 1]; ++k) {
      Fragment& fragment = fragments_[k];
      if (fragment.is_taken) continue;
      if (!lies_here(fragment.place)) {
        all = false;
        continue;
      }
      fragment.is_taken = true;
      taken_.push_back(k);
      if (or_nearer) depth = std::min(depth, fragment.place.t);
    }
    if (all) left_.remove(at);
    if (!taken_.empty()) add_layer(to, at, at_parameter, depth);
  }

  /// Gives what has been taken in a group its light, front to back, before the group's list is
  /// composited.
  void settle(const TileTarget& to);

  /// Calls visit(at, share, place) for every fragment: the pixel's index in the tile's planes, and
  /// the share of the pixel that the fragment covers.
  template <typename Visit>
  void visit_all(const Visit& visit) const {
    for (const Fragment& fragment : fragments_) visit(fragment.at, fragment.share, fragment.place);
  }

  /// Composites all fragments that are not taken yet: nothing lies between those of a pixel.
  void append_rest(const TileTarget& to);

 private:
  struct Fragment {
    std::size_t at;  // the pixel's index in the tile's planes
    double share;    // of the pixel
    Place place;
    bool is_taken = false;
  };
  // What has been taken in a group: fragments, by their numbers, and their entry in the list.
  struct Taken {
    std::size_t at;
    double t;
    std::vector<std::uint32_t> fragments;
    std::size_t entry;
  };
  void add(const EdgePiece& piece);
  void sort_by_pixel();
  void add_layer(const TileTarget& to, std::size_t at, double at_parameter, double depth);
  [[nodiscard]] double opacity_of(std::size_t at, std::span<const std::uint32_t> fragments);
  [[nodiscard]] PlainRadiance light_of(double opacity) const;
  [[nodiscard]] Strip strip_of(const EdgePiece& piece) const;

  const Frame& frame_;
  const Edges& look_;
  TileRect tile_;
  std::vector<Fragment> fragments_;   // by pixel, and by depth
  std::vector<std::uint32_t> first_;  // of every pixel's, and the end
  PixelMask left_;
  std::vector<double> transparency_;
  std::vector<PixelLayers> layers_;  // of pixels with several fragments
  std::vector<std::uint32_t>
      layers_of_;  // of every pixel: one more than its place in layers_, or 0
  std::vector<Taken> in_group_;
  std::vector<std::uint32_t> taken_;   // scratch
  std::vector<CoveringStrip> strips_;  // scratch
};

}  // namespace hiac

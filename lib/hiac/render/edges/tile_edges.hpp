#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/render/edges/screen_edges.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// The edges in one tile as fragments of its pixels, each taken once: where its place along the ray
/// is reached.
///
/// A fragment is the part of a straight piece that covers a pixel, by the exact area of the piece's
/// strip in the pixel's square. Its depth is that of the piece's point nearest to the pixel's
/// centre. Fragments that are taken together count as beside one another: their shares add up, to
/// the whole pixel at most, so that lines run on through the nodes at which their pieces meet.
class TileEdges {
 public:
  /// All arguments must outlive it.
  TileEdges(const Frame& frame, const ScreenEdges& edges, const TileRect& tile);

  [[nodiscard]] bool empty() const { return fragments_.empty(); }
  /// The transparency of all that has been composited of edges in a pixel.
  [[nodiscard]] double transparency(std::size_t at) const {
    return transparency_.empty() ? 1 : transparency_[at];
  }

  /// The point of an edge that is nearest to a pixel's centre.
  struct Place {
    const EdgePiece* piece;
    double t;     ///< ray parameter of the plane parallel to the screen through it
    NodeId node;  ///< the edge's end that a line's half width and half a pixel reach, or kNoNode
  };

  /// Composites those fragments of a pixel that are not taken yet and of which lies_here(place) is
  /// true. In a group of cells they are
  /// sorted in at the ray parameter `at_parameter` or, `or_nearer`, at the nearest of their own if
  /// that is nearer.
  template <typename LiesHere>
  void take(const TileTarget& to, std::size_t at, double at_parameter, bool or_nearer,
            const LiesHere& lies_here) {
    if (empty()) return;
    double share = 0;
    for (std::size_t k = first_[at]; k < first_[at + 1]; ++k) {
      Fragment& fragment = fragments_[k];
      if (fragment.share == 0 || !lies_here(fragment.place)) continue;
      share += fragment.share;
      fragment.share = 0;
      if (or_nearer) at_parameter = std::min(at_parameter, fragment.place.t);
    }
    if (share > 0) composite_share(to, at, at_parameter, share);
  }

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
    double share;    // of the pixel; 0 once it is taken
    Place place;
  };
  void add(const EdgePiece& piece, const TileRect& tile);
  void composite_share(const TileTarget& to, std::size_t at, double at_parameter, double share);

  const Frame& frame_;
  const Edges& look_;
  std::vector<Fragment> fragments_;  // by pixel, and by depth
  std::vector<std::size_t> first_;   // of every pixel's, and the end
  std::vector<double> transparency_;
};

}  // namespace hiac

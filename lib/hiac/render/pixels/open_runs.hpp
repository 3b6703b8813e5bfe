#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/pixels/tile.hpp"
#include "hiac/render/runs/ray_runs.hpp"

namespace hiac {

/// The last run of every pixel of a tile, which the pixel's next segment continues if it begins, to
/// the bit, where the run ends. In planes, so that a kernel adds to the runs of neighbouring pixels
/// at once (open_runs-inl.hpp); either way rounds products before it adds them, and makes the same
/// bits.
///
/// Of the tile's buffer it keeps the transparency of all of a pixel's segments together, by which
/// kernels know what is not seen, and where the pixel's runs before this one ended.
struct OpenRuns {
  using Plane = TilePixels::Plane;
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  // consecutive in memory, so that a kernel needs one address for all of them
  alignas(64) Plane front;               ///< kNone where no run is open
  Plane back;                            ///< -kNone where no run is open
  Plane red, green, blue, transparency;  ///< of the run alone
  Plane before;                          ///< transparency of the pixel's runs before
  std::vector<RayRun> closed;            ///< in the order in which they were closed

  void reset() {
    front.fill(kNone);
    back.fill(-kNone);
    before.fill(1);
    closed.clear();
  }

  [[nodiscard]] bool is_open(std::size_t at) const { return front[at] != kNone; }
  [[nodiscard]] RayRun run(std::size_t at) const {
    return {front[at],
            back[at],
            {{red[at], green[at], blue[at]}, transparency[at]},
            static_cast<std::uint32_t>(at)};
  }

  /// Ends an open run. Another one must be opened at once.
  void close(std::size_t at, TileBuffer& buffer) {
    closed.push_back(run(at));
    buffer.last[at] = std::max(buffer.last[at], back[at]);
    before[at] *= transparency[at];
  }
  /// Opens a run, without a segment, and closes the one before.
  void open(std::size_t at, double begin, TileBuffer& buffer) {
    if (is_open(at)) close(at, buffer);
    front[at] = back[at] = begin;
    red[at] = green[at] = blue[at] = 0;
    transparency[at] = 1;
  }
  /// Adds a segment to an open run.
  void extend(std::size_t at, double end, const PlainRadiance& light, TileBuffer& buffer) {
    red[at] += transparency[at] * light.rgb[0];
    green[at] += transparency[at] * light.rgb[1];
    blue[at] += transparency[at] * light.rgb[2];
    transparency[at] *= light.transparency;
    back[at] = end;
    buffer.transparency[at] = before[at] * transparency[at];
  }
};

}  // namespace hiac

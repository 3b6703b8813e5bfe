#pragma once

#include <span>
#include <vector>

#include "hiac/render/edges/pixel_samples.hpp"
#include "hiac/render/edges/strip_coverage.hpp"

namespace hiac {

/// A strip and the share of a pixel that it covers (strip_coverage).
struct CoveringStrip {
  Strip strip;
  double share;
};

/// What lines have covered of one pixel, layer by layer, front to back. The medium is one and the
/// same in all of the pixel, that of its ray; lines are where they are in it: of two that cover the
/// same part the one in front hides the other, and two that lie beside one another fill the pixel
/// together.
class PixelLayers {
 public:
  /// Adds a layer behind all others: the samples that it covers, and the share of the pixel, which
  /// may be known better than from the samples. Returns the share of the light that has passed all
  /// others which this layer takes away.
  double add(const PixelSamples& covered, double share, double opacity);
  /// The same of strips that lie at one place in the pixel around (x, y): together they cover what
  /// at least one of them does.
  double add(std::span<const CoveringStrip> strips, double x, double y, double opacity);

  /// The mean over the pixel of what passes all layers.
  [[nodiscard]] double transparency() const { return transparency_; }

 private:
  // the samples that at least one layer covers, at least two, ...; of opaque layers only the first
  std::vector<PixelSamples> covered_;
  double transparency_ = 1;
};

}  // namespace hiac

#pragma once

#include <span>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/drawn_tile.hpp"
#include "hiac/render/pixels/pixel_details.hpp"
#include "hiac/render/runs/ray_runs.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// What merging needs of the frame of any part, of which set_constants made those of the whole.
struct MergeConstants {
  double least_transparency, witness_tolerance, largest_light;
  bool with_details;
};
MergeConstants merge_constants(const Frame& frame);

/// One tile of a mesh in parts: the runs of all parts, sorted by depth in every pixel and
/// composited front to back.
///
/// Exact for parts of any shape: cells do not overlap, so runs of different parts have no more than
/// ends in common, and the order of their entries is that of all they hold. Runs that begin at one
/// depth are taken by their ends, then by part. The witness counts runs that begin before another
/// one has ended.
class MergedTile final : public DrawnTile {
 public:
  /// `parts`: by ascending number of the part. `edges`: null if the scene has none. The result
  /// depends on nothing else.
  MergedTile(const MergeConstants& constants, std::span<const TileRuns> parts,
             const EdgedView* edges = nullptr);

  [[nodiscard]] const TilePixels& pixels() const override { return pixels_; }
  [[nodiscard]] const TileCounts& counts() const override { return counts_; }
  [[nodiscard]] const PixelFacts& facts(std::size_t at) const override { return details_[at]; }
  [[nodiscard]] double error(std::size_t at, double background) override;
  [[nodiscard]] double surface_transparency(std::size_t at) const override {
    return covers_.empty() ? 1 : covers_[at];
  }

 private:
  void composite(const RayRun& run, const RunFacts* facts);
  bool composite(const EdgedSegment& segment);
  bool note_place(std::size_t at, double front, double back);
  void add_light(std::size_t at, const PlainRadiance& light);

  MergeConstants constants_;
  TilePixels pixels_;
  TileCounts counts_;
  std::vector<PixelDetails> details_;
  std::vector<double> covers_;  // of skin and edges of all parts; empty where there are none
};

}  // namespace hiac

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hiac/frame/channels.hpp"
#include "hiac/frame/crop.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/frame_constants.hpp"
#include "hiac/frame/surfaces/touched_faces.hpp"
#include "hiac/frame/tiles/tile_bins.hpp"
#include "hiac/render/runs/merged_tile.hpp"
#include "hiac/render/runs/ray_runs.hpp"
#include "hiac/render/splatting.hpp"

namespace hiac {

/// The accurate engine for one part of a mesh: draws runs, which MergedTile merges.
///
/// A part is any set of cells with all their nodes, numbered in the order of the whole mesh: then
/// every face has the same depths, to the bit, in both parts that share it. Before anything is
/// drawn the parts learn of one another what set_constants and Isosurfaces need:
///
///     every part:  extremes(), touched_faces()
///     every part:  close_faces(those that another part touches, too), set_whole(all extremes)
class PartEngine {
 public:
  /// Mesh and scene must outlive it, and pass check_renderable and require_parted_scene.
  PartEngine(const ZooMesh& part, const Scene& scene, std::span<const Channel> channels);
  PartEngine(const PartEngine&) = delete;
  PartEngine& operator=(const PartEngine&) = delete;

  [[nodiscard]] MeshExtremes extremes() const { return extremes_of(frame_); }
  /// The faces of the part's boundary at which isosurfaces touch it; nodes are those of the part.
  [[nodiscard]] std::vector<TouchedFace> touched_faces() const;
  void close_faces(std::span<const TouchedFace> faces);
  void set_whole(const MeshExtremes& extremes);

  [[nodiscard]] MergeConstants constants() const { return merge_constants(frame_); }
  [[nodiscard]] std::uint64_t splatted_cells() const { return splatted_->count(); }
  /// The cells of the part's own order in each tile of a part of the picture.
  [[nodiscard]] TileBins bins(const VisibilityOrder& order, const PixelRect& rect) const;
  [[nodiscard]] TileRuns draw(const VisibilityOrder& order, const TileRect& tile,
                              std::span<const std::uint32_t> ranks) const;

 private:
  const Scene& scene_;
  Projector projector_;
  Frame frame_;
  std::optional<SplattedCells> splatted_;
};

/// Throws UsageError where a scene asks for what is not drawn of meshes in parts, a skin or edges,
/// or channels for a bound that is not claimed of it.
void require_parted_scene(const Scene& scene, std::span<const Channel> channels);

}  // namespace hiac

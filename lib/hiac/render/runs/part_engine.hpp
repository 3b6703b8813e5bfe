#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "hiac/frame/channels.hpp"
#include "hiac/frame/crop.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/frame_constants.hpp"
#include "hiac/frame/surfaces/touched_faces.hpp"
#include "hiac/frame/tiles/pixel_mask.hpp"
#include "hiac/frame/tiles/tile_bins.hpp"
#include "hiac/render/edges/screen_edges.hpp"
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
///     every part:  close_faces(those that another part touches, too), set_skin and set_edges
///     (where
///                  the scene has them), set_whole(all extremes)
class PartEngine {
 public:
  /// Mesh and scene must outlive it, and pass check_renderable and require_parted_scene.
  PartEngine(const ZooMesh& part, const Scene& scene, std::span<const Channel> channels);
  PartEngine(const PartEngine&) = delete;
  PartEngine& operator=(const PartEngine&) = delete;

  [[nodiscard]] const ZooMesh& mesh() const { return frame_.mesh; }
  [[nodiscard]] MeshExtremes extremes() const { return extremes_of(frame_); }
  /// The faces of the part's boundary at which isosurfaces touch it; nodes are those of the part.
  [[nodiscard]] std::vector<TouchedFace> touched_faces() const;
  void close_faces(std::span<const TouchedFace> faces);
  /// The boundary of the whole mesh, on which the skin lies (boundary_faces.hpp).
  void set_skin(std::vector<std::uint8_t> boundary) { frame_.skin.faces = std::move(boundary); }
  /// The edges that this part draws, the boundary of the whole mesh, and for every node its number
  /// there.
  void set_edges(std::span<const EdgeNodes> edges, std::vector<std::uint8_t> boundary,
                 std::span<const std::uint64_t> global_nodes);
  void set_whole(const MeshExtremes& extremes);

  [[nodiscard]] MergeConstants constants() const { return merge_constants(frame_); }
  [[nodiscard]] std::uint64_t splatted_cells() const { return splatted_->count(); }
  /// The cells of the part's own order in each tile of a part of the picture.
  [[nodiscard]] TileBins bins(const VisibilityOrder& order, const PixelRect& rect) const;
  /// A ray parameter before which no run through these cells of the order begins.
  [[nodiscard]] double nearest(const VisibilityOrder& order,
                               std::span<const std::uint32_t> ranks) const;
  /// Marks the pixels of a tile through which the part's edges pass; whether there are any.
  bool mark_edges(const TileRect& tile, PixelMask& mask) const;
  /// `mask`: the pixels of the tile through which edges of any part pass; null: there are no edges.
  [[nodiscard]] TileRuns draw(const VisibilityOrder& order, const TileRect& tile,
                              std::span<const std::uint32_t> ranks,
                              const PixelMask* mask = nullptr) const;

 private:
  void add_fragments(const TileRect& tile, std::vector<EdgeFragment>& fragments) const;

  const Scene& scene_;
  Projector projector_;
  Frame frame_;
  std::optional<SplattedCells> splatted_;
  ScreenEdges edges_;
  std::vector<std::uint8_t> boundary_;  // of the whole mesh; where edges are drawn
  std::span<const std::uint64_t> global_nodes_;
};

/// Throws UsageError where channels ask for a bound that is not claimed of the scene, or not of one
/// with a skin in parts: the faces beside an edge of the skin may be those of other parts.
void require_parted_scene(const Scene& scene, std::span<const Channel> channels);

}  // namespace hiac

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hiac/base/progress.hpp"
#include "hiac/cluster/communicator.hpp"
#include "hiac/frame/channels.hpp"
#include "hiac/frame/crop.hpp"
#include "hiac/frame/tiles/picture.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// One part of a mesh that this process draws. Everything must outlive the renderer.
struct DrawnPart {
  std::uint32_t number;  ///< among all parts; every part has one process
  const ZooMesh& mesh;   ///< any cells of the whole, nodes in the whole mesh's order
  std::span<const std::uint64_t> global_nodes;  ///< the number in the whole mesh of every node
  const VisibilityOrder& order;                 ///< of the part alone
};

/// What one process did for its pictures.
struct PartedWork {
  std::uint64_t runs = 0, segments = 0;  ///< drawn of its parts
  std::uint64_t sent_bytes = 0;          ///< of runs, to other processes
  std::uint64_t rounds = 0, most_round_bytes = 0;
  double draw_seconds = 0, merge_seconds = 0;
};

/// Pictures of a mesh whose parts lie in several processes (docs/cluster.md).
///
/// Every process draws the runs of its parts and sends those of a tile to the tile's owner, who
/// merges them (MergedTile) and sends the pixels to rank 0. This is done in rounds of some tiles,
/// which bound the memory for runs. Where parts lie behind opaque ones, a round is drawn in layers,
/// the nearest parts first, and parts of which nothing is seen in a tile are not drawn there; while
/// the farther layers of a round are drawn, the nearer ones of the next rounds are. The picture is
/// a function of the mesh and its parts: neither the number of processes and threads nor who has
/// which part changes a bit.
class PartedRenderer {
 public:
  /// All processes call it, with the same scene and channels. Parts and scene must pass
  /// check_renderable and require_parted_scene.
  PartedRenderer(Communicator& all, std::span<const DrawnPart> own, const Scene& scene,
                 std::span<const Channel> channels = {});
  ~PartedRenderer();
  PartedRenderer(const PartedRenderer&) = delete;
  PartedRenderer& operator=(const PartedRenderer&) = delete;

  /// All processes call it, with the same arguments. An image of a part of the picture, on rank 0;
  /// that of others is empty. The statistics are the same everywhere but for the times.
  RenderResult render(const PixelRect& part, bool with_background, Progress* progress = nullptr);

  [[nodiscard]] const PartedWork& work() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hiac

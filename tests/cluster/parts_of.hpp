#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "hiac/cluster/parted_renderer.hpp"
#include "hiac/image/image.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::test {

/// A mesh cut into parts, each with its own order for a scene. Parts without cells are left out.
class Parts {
 public:
  Parts(const ZooMesh& mesh, std::span<const std::uint32_t> part_of_cell, std::uint32_t count,
        const Scene& scene);

  /// The parts that `rank` of `ranks` has, dealt out in turn; in this order or the other way round.
  [[nodiscard]] std::vector<DrawnPart> of_rank(std::uint32_t rank, std::uint32_t ranks,
                                               bool reversed = false) const;

 private:
  struct Part {
    std::uint32_t number;
    ZooMesh mesh;
    std::vector<std::uint64_t> global_nodes;
    VisibilityOrder order;
  };
  std::deque<Part> parts_;
};

/// Runs `work` of every rank, each in a thread of its own.
void run_ranks(std::uint32_t ranks, const std::function<void(Communicator&)>& work);

/// Whether all values of two images are the same, to the bit.
bool same_bits(const Image& a, const Image& b);

}  // namespace hiac::test

#pragma once

#include <cstdint>
#include <span>

#include "hiac/cluster/communicator.hpp"
#include "hiac/render/runs/part_engine.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// A part's engine, the part's number, and that in the whole mesh of every node of the part.
struct NumberedEngine {
  PartEngine& engine;
  std::uint32_t number;
  std::span<const std::uint64_t> global_nodes;
};

/// Lets the engines of all parts, in all processes, learn what they need of the whole mesh
/// (PartEngine). Returns the constants of merging, also where a process has no part. Throws
/// InputError if there is no part at all. The scene is that of the engines.
MergeConstants share_whole_facts(Communicator& all, std::span<const NumberedEngine> own,
                                 const Scene& scene);

}  // namespace hiac

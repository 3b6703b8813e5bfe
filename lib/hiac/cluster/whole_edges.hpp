#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/cluster/communicator.hpp"
#include "hiac/cluster/part_boundary.hpp"
#include "hiac/geometry/face_form.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// For each of this process's parts the edges that it draws, by ascending end nodes: together those
/// that chosen_edges chooses of the whole mesh, each in one of the parts that have it. Whether an
/// edge is a feature depends on the faces on both sides of it, which may be of different parts.
/// `boundary`: of every part's cells, whole_boundary. All processes call it.
std::vector<std::vector<EdgeNodes>> whole_edges(
    Communicator& all, std::span<const NumberedPart> own, const Edges& wanted,
    std::span<const std::vector<std::uint8_t>> boundary);

}  // namespace hiac

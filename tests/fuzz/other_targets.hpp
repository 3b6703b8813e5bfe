#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/fuzz/target.hpp"

namespace hiac::fuzz {

/// What the tools read besides meshes, surfaces and points, by our own code: "specification" (with
/// colour maps), "state" (of ParaView), "order" (a chunk's payload), "npy", "sgi", "pfm", "hdr".
/// Tried under CTest alone.
std::optional<Target> other_target(const std::string& name);

/// Small sound inputs of such a target.
std::vector<std::string> other_seeds(const std::string& name);

}  // namespace hiac::fuzz

#pragma once

#include <vector>

#include "hiac/check/conformity.hpp"

namespace hiac {

/// The part of judge_conformity that is about faces on one another: torn_interface,
/// hanging_interface, sliding_interface.
std::vector<Finding> find_interfaces(const ZooMesh& mesh, const std::vector<FreeFace>& faces,
                                     double planarity);

}  // namespace hiac

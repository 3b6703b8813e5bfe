#pragma once

#include <vector>

#include "hiac/check/conformity.hpp"

namespace hiac {

/// Finds the faces that lie on one another, for judge_conformity: torn_interface,
/// hanging_interface, sliding_interface.
std::vector<Finding> find_interfaces(const ZooMesh& mesh, const std::vector<FreeFace>& faces,
                                     double planarity);

}  // namespace hiac

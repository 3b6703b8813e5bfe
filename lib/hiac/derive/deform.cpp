#include "hiac/derive/deform.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac {

void deform(ZooMesh& mesh, const Field& displacement, double scale) {
  if (displacement.location != FieldLocation::node || displacement.components != 3)
    throw UsageError(
        fmt::format("field '{}' moves no nodes (a field of nodes with 3 components "
                    "expected, {} components found)",
                    displacement.name, displacement.components));
  std::vector<double> moved(mesh.xyz.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved[i] = mesh.xyz[i] + scale * displacement.values[i];
    if (!std::isfinite(moved[i]))
      throw InputError(displacement.name,
                       fmt::format("node {} is moved to no finite position (finite values "
                                   "expected, {} found)",
                                   i / 3, displacement.values[i]));
  }
  mesh.xyz = SharedArray<double>(std::move(moved));
}

}  // namespace hiac

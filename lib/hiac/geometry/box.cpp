#include "hiac/geometry/box.hpp"

#include "hiac/base/special_values.hpp"

namespace hiac {

Box Box::empty() {
  return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
}

double Box::diagonal() const {
  return low[0] > high[0] ? 0 : length({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

Box box_of_nodes(const ZooMesh& mesh) {
  Box box = Box::empty();
  for (std::size_t node = 0; node < mesh.node_count(); ++node)
    box.include(mesh.position(static_cast<NodeId>(node)));
  return box;
}

Box box_of_cells(const ZooMesh& mesh) {
  Box box = Box::empty();
  for (const NodeId node : mesh.nodes) box.include(mesh.position(node));
  return box;
}

}  // namespace hiac

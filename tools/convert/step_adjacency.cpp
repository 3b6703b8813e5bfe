#include "tools/convert/step_adjacency.hpp"

#include <algorithm>

#include "hiac/mesh/face_adjacency.hpp"

namespace hiac::tools {

FaceAdjacency StepAdjacency::of(const ZooMesh& mesh) {
  if (known_ && std::ranges::equal(kinds_.view(), mesh.kinds.view()) &&
      std::ranges::equal(nodes_.view(), mesh.nodes.view()))
    return *known_;
  known_ = build_face_adjacency(mesh);
  kinds_ = mesh.kinds;
  nodes_ = mesh.nodes;
  return *known_;
}

}  // namespace hiac::tools

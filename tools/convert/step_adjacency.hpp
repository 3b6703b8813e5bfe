#pragma once

#include <optional>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::tools {

/// The face adjacency of one step after the other, which is computed again only where the cells are
/// others: coordinates do not matter to it.
class StepAdjacency {
 public:
  /// The adjacency that build_face_adjacency gives.
  FaceAdjacency of(const ZooMesh& mesh);

 private:
  std::optional<FaceAdjacency> known_;
  SharedArray<CellKind> kinds_;  // of the known one
  SharedArray<NodeId> nodes_;
};

}  // namespace hiac::tools

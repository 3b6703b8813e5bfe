#pragma once

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Matches faces by their conventional nodes. Linear time in the number of faces for meshes whose
/// nodes have bounded valence (n log n in the worst case), about 8 bytes a face beyond the result,
/// in parallel; the result does not depend on the number of threads.
FaceAdjacency build_face_adjacency(const ZooMesh& mesh);

}  // namespace hiac

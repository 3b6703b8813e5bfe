#include "hiac/frame/surfaces/boundary_faces.hpp"

#include <optional>

#include "hiac/base/parallel.hpp"
#include "hiac/mesh/face_adjacency.hpp"

namespace hiac {

std::vector<std::uint8_t> boundary_faces(const ZooMesh& mesh) {
  constexpr std::size_t kGrain = std::size_t{1} << 14;
  std::optional<FaceAdjacency> built;
  if (!mesh.adjacency) built = build_face_adjacency(mesh);
  const FaceAdjacency& adjacency = mesh.adjacency ? *mesh.adjacency : *built;
  const std::vector<std::uint64_t> first = face_offsets(mesh);
  std::vector<std::uint8_t> faces(mesh.cell_count(), 0);
  parallel_for(faces.size(), kGrain, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end; ++cell)
      for (std::uint64_t face = first[cell]; face < first[cell + 1]; ++face)
        if (adjacency.neighbors[face] == kNoCell)
          faces[cell] |= static_cast<std::uint8_t>(1U << (face - first[cell]));
  });
  return faces;
}

}  // namespace hiac

#include "hiac/mesh/parted/part_contacts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/parted/whole_corners.hpp"

namespace hiac {
namespace {

/// A face of a part's boundary: its corners in the whole mesh, ascending, and the part.
struct CutFace {
  std::array<std::uint64_t, 4> corners;
  std::uint32_t part;
};

void append_boundary(const MeshPart& part, std::uint32_t number, std::vector<CutFace>& faces) {
  const ZooMesh& mesh = part.mesh;
  const FaceAdjacency adjacency = mesh.adjacency ? *mesh.adjacency : build_face_adjacency(mesh);
  std::size_t place = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const std::size_t count = topology_of(mesh.kinds[cell]).faces.size();
    for (std::size_t face = 0; face < count; ++face, ++place) {
      if (adjacency.neighbors[place] != kNoCell) continue;
      CutFace cut{whole_corners(mesh, part.global_nodes.view(), cell, face), number};
      std::ranges::sort(cut.corners);
      faces.push_back(cut);
    }
  }
}

}  // namespace

std::vector<PartContact> part_contacts(std::span<const MeshPart> parts) {
  std::vector<CutFace> faces;
  for (std::uint32_t k = 0; k < parts.size(); ++k) append_boundary(parts[k], k, faces);
  std::ranges::sort(faces, {}, [](const CutFace& f) { return std::pair(f.corners, f.part); });
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> counts;
  for (auto face = faces.begin(); face != faces.end();) {
    const auto next = std::find_if(
        face, faces.end(), [&](const CutFace& other) { return other.corners != face->corners; });
    if (next - face == 2 && face->part != (face + 1)->part)
      ++counts[{face->part, (face + 1)->part}];
    face = next;
  }
  std::vector<PartContact> contacts;
  for (const auto& [pair, count] : counts) contacts.push_back({pair.first, pair.second, count});
  return contacts;
}

}  // namespace hiac

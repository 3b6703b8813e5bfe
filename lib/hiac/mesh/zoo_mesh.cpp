#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {
std::vector<std::uint64_t> face_offsets(const ZooMesh& mesh) {
  std::vector<std::uint64_t> offsets(mesh.cell_count() + 1);
  std::uint64_t faces = 0;
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    offsets[cell] = faces;
    faces += face_count(mesh.kinds[cell]);
  }
  offsets.back() = faces;
  return offsets;
}

}  // namespace hiac

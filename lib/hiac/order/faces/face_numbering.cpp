#include "hiac/order/faces/face_numbering.hpp"

#include <algorithm>

namespace hiac {

FaceNumbering::FaceNumbering(const ZooMesh& mesh) {
  if (mesh.cell_count() == 0) return;
  const CellShape shape = shape_of(mesh.kinds[0]);
  const bool one_shape =
      std::ranges::all_of(mesh.kinds, [&](CellKind kind) { return shape_of(kind) == shape; });
  stride_ = static_cast<std::uint32_t>(topology_of(shape).faces.size());
  if (!one_shape) table_ = face_offsets(mesh);
}

}  // namespace hiac

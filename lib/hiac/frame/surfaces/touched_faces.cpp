#include "hiac/frame/surfaces/touched_faces.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "hiac/element/face_interpolant.hpp"
#include "hiac/frame/surfaces/boundary_faces.hpp"

namespace hiac {

void append_touched_faces(const ZooMesh& mesh, CellId cell, const CellField& field, double value,
                          const TouchedFace& form, std::vector<TouchedFace>& faces) {
  const auto nodes = mesh.cell_nodes(cell);
  const CellKind kind = mesh.kinds[cell];
  // in cells of higher order the field may exceed the value between the nodes
  if (std::ranges::max(std::span(field.values).first(nodes.size())) != value) return;
  for (std::size_t f = 0; f < face_count(kind); ++f) {
    const FaceOffsets of_face = face_offsets(kind, f, nodes, field.values);
    const auto values = std::span(of_face.offsets).first(of_face.node_count());
    if (!std::ranges::all_of(values, [&](double v) { return v == value; })) continue;
    TouchedFace face = form;
    face.face = static_cast<std::uint8_t>(f);
    face.nodes.fill(std::numeric_limits<NodeId>::max());
    std::copy_n(of_face.nodes.begin(), of_face.count, face.nodes.begin());
    std::ranges::sort(face.nodes);
    faces.push_back(face);
  }
}

std::vector<TouchedFace> touched_boundary_faces(const ZooMesh& mesh, const Isosurfaces& all) {
  std::vector<TouchedFace> faces;
  std::vector<CellId> cells;  // of each face
  for (CellId cell = 0; cell + 1 < all.first.size(); ++cell)
    for (std::size_t cut = all.first[cell]; cut < all.first[cell + 1]; ++cut) {
      const FrameIsosurface& surface = all.surfaces[all.cuts[cut].surface];
      append_touched_faces(mesh, cell, cell_field(mesh, cell, all.fields[surface.field]),
                           surface.value, {all.cuts[cut].surface, {}, cut, 0}, faces);
      cells.resize(faces.size(), cell);
    }
  if (faces.empty()) return faces;
  const std::vector<std::uint8_t> boundary = boundary_faces(mesh);
  std::vector<TouchedFace> result;
  for (std::size_t k = 0; k < faces.size(); ++k)
    if ((boundary[cells[k]] >> faces[k].face & 1) != 0) result.push_back(faces[k]);
  return result;
}

void close_face(const TouchedFace& face, Isosurfaces& all) {
  all.cuts[face.cut].closed_faces |= static_cast<std::uint8_t>(1U << face.face);
}

}  // namespace hiac

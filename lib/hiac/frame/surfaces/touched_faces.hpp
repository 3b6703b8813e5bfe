#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "hiac/element/cell_field.hpp"
#include "hiac/frame/surfaces/isosurfaces.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A face at all of whose corners the field equals a surface's value, in a cell that is below the
/// value elsewhere.
struct TouchedFace {
  std::uint32_t surface;
  std::array<NodeId, 4> nodes;  ///< ascending; the last of a triangle is the largest NodeId
  std::size_t cut;              ///< index into Isosurfaces::cuts
  std::uint8_t face;

  [[nodiscard]] auto key() const { return std::tie(surface, nodes); }
};

/// Appends the faces of a cell, below `value` elsewhere, that have the value at all their corners:
/// each as `form` with its nodes and its number. `field`: that of the surface in the cell.
void append_touched_faces(const ZooMesh& mesh, CellId cell, const CellField& field, double value,
                          const TouchedFace& form, std::vector<TouchedFace>& faces);

/// The touched faces on the boundary of a mesh. Where it is a part of another mesh, the cell on the
/// face's other side may touch the surface too, and then the face is closed in both (Isosurfaces).
std::vector<TouchedFace> touched_boundary_faces(const ZooMesh& mesh, const Isosurfaces& all);

/// Closes a face.
void close_face(const TouchedFace& face, Isosurfaces& all);

}  // namespace hiac

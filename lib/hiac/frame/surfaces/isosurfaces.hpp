#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/frame_field.hpp"
#include "hiac/frame/projection.hpp"
#include "hiac/frame/surfaces/surface_look.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// An isosurface as the engine draws it.
struct FrameIsosurface : SurfaceLook {
  std::size_t field;  ///< index into Isosurfaces::fields
  double value;
};

/// One isosurface in one cell that it crosses.
struct IsosurfaceCut {
  std::uint32_t surface;      ///< index into Isosurfaces::surfaces
  std::uint8_t closed_faces;  ///< a bit for each of the cell's faces: see Isosurfaces
};

/// The scene's isosurfaces and the cells that they cross.
///
/// A ray crosses a surface where its field goes from below the value to the value or above it, or
/// back, inside a cell including its entry and exit faces. All cells that share a face have the
/// same values there, and the test `below?` has one result for a face and a ray in both cells
/// (face_value.hpp), so that every crossing is drawn once, in the cell that contains both of its
/// sides:
///
/// - One, two or three nodes of a tetrahedron may have the value (section 5.1). Where a whole face
///   has it the surface lies in the face, and the cell in which the field falls below it draws it.
///   On the mesh's boundary such a face is therefore drawn when the field is below the value
///   inside, from whichever side it is seen.
/// - Where the field only touches the value, coming from below and going back below, there is no
///   passage: a whole face at which it does so is closed (closed_faces) in both cells. So is, by
///   the half-open rule, a face that is touched from above. Faces that match node by node are
///   recognised; two cells of a sliding interface or around hanging nodes draw such a face each.
/// - A cell that has the value everywhere counts as not below it, and draws nothing.
///
/// Where values jump across a face (cell and corner fields) nothing is drawn at the jump, even if
/// the value lies between: there is no point at which the field takes it. Therefore constant cells
/// have no surfaces, and surfaces of corner fields end at the faces where they do not fit.
///
/// Several surfaces at one depth of a ray are composited in the order of the scene, the first one
/// in front.
struct Isosurfaces {
  std::vector<FrameField> fields;  ///< without intervals
  std::vector<FrameIsosurface> surfaces;
  std::vector<FrameLight> lights;
  double largest_light = 0;  ///< upper bound of a surface's light, any channel
  /// The cuts of cell c are first[c] to first[c + 1]; both arrays are empty if the scene has no
  /// isosurface.
  std::vector<std::uint64_t> first;
  std::vector<IsosurfaceCut> cuts;

  /// The surfaces that cross a cell, by ascending number.
  [[nodiscard]] std::span<const IsosurfaceCut> in(CellId cell) const {
    if (first.empty()) return {};
    return std::span(cuts).subspan(first[cell], first[cell + 1] - first[cell]);
  }

  /// A surface's field minus its value, at a corner of a cell: a difference of doubles has the
  /// correct sign, and is 0 only if they are equal.
  [[nodiscard]] double offset(const FrameIsosurface& surface, CellId cell, std::uint64_t entry,
                              NodeId node) const {
    const FrameField& field = fields[surface.field];
    return field.values[field.index(cell, entry, node)] - surface.value;
  }
};

/// Throws UsageError, as scalar_field does, when a field does not exist.
Isosurfaces make_isosurfaces(const ZooMesh& mesh, const Scene& scene, const Projector& projector);

}  // namespace hiac

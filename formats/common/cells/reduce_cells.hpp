#pragma once

#include <span>
#include <string>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Turns cells that the zoo has no kind for into cells of its kinds.
///
/// Polyhedra with the faces of a shape of the zoo become that shape. Cells of order 2 and 3 with
/// nodes in faces and inside become the serendipity kind of that order when nothing is lost: when
/// that kind's interpolant reproduces the positions and values of `fields` at the nodes left out,
/// to 1e-12 of the largest (1e-6 when the values are in single precision). With
/// ReadOptions::approximate they always do; then cells of order 4 and more become cubic, and
/// polyhedra are divided into tetrahedra and pyramids around their centre. Notes in the mesh state
/// the changes and the largest error. Other cells are not changed.
///
/// Returns why some cells were not converted, for the message that refuses them; empty when all
/// were. `fields` belong to the mesh. Throws InputError(subject, ...).
std::string reduce_cells(ForeignMesh& mesh, const ReadOptions& options,
                         std::span<const ForeignField* const> fields, const std::string& subject);

}  // namespace hiac::formats

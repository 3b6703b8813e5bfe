#pragma once

#include <span>
#include <string>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Turns cells that the zoo has no kind for into cells of its kinds.
///
/// Polyhedra whose faces are those of a shape of the zoo become that shape. Cells of order 2 and 3
/// with nodes in faces and inside become the serendipity kind of that order where this loses
/// nothing: where the nodes left out, and the values of `fields` there, are what the others make of
/// them, to 1e-12 of the largest (1e-6 where the values are in single precision). With
/// ReadOptions::approximate also where it does; cells of order 4 and more become cubic, and
/// polyhedra tetrahedra and pyramids that have their centre in common. Notes in the mesh say what
/// was done and the largest error. Cells that it does not turn stay as they are.
///
/// Returns why, for the message that refuses them; empty when all were turned. `fields` are of the
/// mesh. Throws InputError(subject, ...).
std::string reduce_cells(ForeignMesh& mesh, const ReadOptions& options,
                         std::span<const ForeignField* const> fields, const std::string& subject);

}  // namespace hiac::formats

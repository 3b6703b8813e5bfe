#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Makes the zoo mesh of a file's contents. Every format that uses this function treats --time,
/// --step, --block and unsupported kinds in the same way, and its meshes pass the gate.
///
/// Of fields with several steps it takes the requested step; without a request it takes the last
/// step of each field, with a note when these have different times. Mid-edge nodes that cells leave
/// out are put in the middle of their straight edges, one for all cells of an edge, with the mean
/// of the fields at its ends; a cell that leaves out all of them becomes linear. Throws
/// InputError(subject, ...), and UsageError when the options ask for something that does not exist.
Reading assemble(ForeignMesh&& foreign, const ReadOptions& options, const std::string& subject);

/// The same for a piece of a mesh, which may have no cells.
Reading assemble_piece(ForeignMesh&& foreign, const ReadOptions& options,
                       const std::string& subject);

/// The inventory of a file's contents. Ranges of fields are those of their last step.
Inventory inventory_of(const ForeignMesh& foreign, std::string_view format,
                       const std::string& subject);

/// Gives a format, whose name is set, the functions that read and list its files; both use `open`,
/// which returns the contents of a file (for a listing it is called without requests).
void read_through(
    Format& format,
    std::function<ForeignMesh(const std::string& path, const ReadOptions& options)> open);

}  // namespace hiac::formats

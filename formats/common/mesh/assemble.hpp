#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// The zoo mesh of what a file holds: --time, --step, --block and the treatment of kinds that the
/// zoo has not are the same for every format that goes through here, and so is the gate.
///
/// Of fields with several steps the one asked for is taken; without a request the last of each,
/// with a note when those are of different times. Mid-edge nodes that cells leave out are put in
/// the middle of their straight edges, one for all cells of an edge, with the mean of the fields at
/// its ends; a cell that leaves out all of them is the linear one. Throws InputError(subject, ...),
/// and UsageError where the options ask for what there is not.
Reading assemble(ForeignMesh&& foreign, const ReadOptions& options, const std::string& subject);

/// The same of a piece of a mesh, which may be without cells.
Reading assemble_piece(ForeignMesh&& foreign, const ReadOptions& options,
                       const std::string& subject);

/// The inventory of what a file holds. Fields are summed up at their last step.
Inventory inventory_of(const ForeignMesh& foreign, std::string_view format,
                       const std::string& subject);

/// Makes a format, whose name is set, read and list its files through these two: `open` finds out
/// what a file holds (without a request where it is to be listed).
void read_through(
    Format& format,
    std::function<ForeignMesh(const std::string& path, const ReadOptions& options)> open);

}  // namespace hiac::formats

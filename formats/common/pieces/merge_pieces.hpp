#pragma once

#include <string>
#include <vector>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Joins the pieces of one mesh and releases their memory on the way. Where pieces meet, each has
/// its own copy of the nodes: those that are one (common_nodes, to which `numbers` may name a field
/// with the nodes' numbers in the whole mesh) become one, so that the cells on both sides share
/// faces. Cells that an earlier piece has, too, are left out. Notes say by what nodes were joined
/// and what was left out. Throws InputError(subject, ...) when the pieces do not have the same
/// fields.
Reading merge_pieces(std::vector<Reading>&& pieces, const std::string& subject,
                     const std::string& numbers = {});

/// Adds the contents of another piece of the same mesh to the inventory of the pieces before it.
void add_piece(Inventory& all, const Inventory& piece);

}  // namespace hiac::formats

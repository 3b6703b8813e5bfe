#pragma once

#include <string>
#include <vector>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Joins the pieces of one mesh and releases their memory on the way. Where pieces meet, each has
/// its own copy of the nodes: nodes of different pieces with equal coordinates and equal values of
/// every node field become one, so that the cells on both sides share faces, except where a piece
/// itself has several nodes at that place, as along a crack. Throws InputError(subject, ...) when
/// the pieces do not have the same fields.
Reading merge_pieces(std::vector<Reading>&& pieces, const std::string& subject);

/// Adds the contents of another piece of the same mesh to the inventory of the pieces before it.
void add_piece(Inventory& all, const Inventory& piece);

}  // namespace hiac::formats

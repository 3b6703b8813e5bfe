#pragma once

#include <string>
#include <vector>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Puts the pieces of one mesh together, releasing them on the way. Where pieces meet, each has its
/// own copy of the nodes: nodes of different pieces with equal coordinates and equal values of
/// every node field become one, so that the cells on both sides share faces. (Not where a piece
/// itself has several nodes in that place, as along a crack.) Throws InputError(subject, ...) when
/// the pieces do not carry the same fields.
Reading merge_pieces(std::vector<Reading>&& pieces, const std::string& subject);

/// Adds what one more piece of the same mesh holds to the inventory of those before it.
void add_piece(Inventory& all, const Inventory& piece);

}  // namespace hiac::formats

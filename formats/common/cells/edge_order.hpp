#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats {

/// The zoo's order (ShapeTopology) of the nodes of a prism whose nodes 0 1 2 turn right-handed
/// about the direction to 3 4 5, as in nearly every format; the zoo's prism turns the other way.
inline constexpr std::uint8_t kRightHandedPrism[] = {0, 2, 1, 3, 5, 4};

/// The permutation (CellConversion::permutation) to `kind` from a format that lists the corners in
/// the order of its documentation, followed by the nodes of its edges, edge by edge.
///
/// Node i of the kind is the format's corner corners[i]; empty: the same order. Edge e of the
/// format joins its corners edges[e], in the direction in which a cubic cell lists the nodes of the
/// edge. Every edge of the kind must be among them, in either direction. The face nodes of a cubic
/// tetrahedron follow in the order `faces`: faces[f] is the place of the zoo's face f in the
/// format.
std::vector<std::uint8_t> permutation_by_edges(CellKind kind, std::span<const std::uint8_t> corners,
                                               std::span<const ShapeEdge> edges,
                                               std::span<const std::uint8_t> faces = {});

/// The same permutation in storage that lasts, because conversions refer to it. Equal permutations
/// are stored once.
std::span<const std::uint8_t> kept_permutation(std::vector<std::uint8_t> permutation);

}  // namespace hiac::formats

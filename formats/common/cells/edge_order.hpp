#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats {

/// A prism whose nodes 0 1 2 turn right-handed round the way to 3 4 5, as nearly every format has
/// it, in the zoo's order (ShapeTopology: the other way round).
inline constexpr std::uint8_t kRightHandedPrism[] = {0, 2, 1, 3, 5, 4};

/// The permutation (CellConversion::permutation) to `kind` from a format that has the corners in
/// the order of its documentation and behind them the nodes of its edges, edge by edge.
///
/// Node i of the kind is the format's corner corners[i]; empty: the same order. edges[e] are the
/// format's corners that its edge e joins, in the direction in which a cubic cell's edge nodes go.
/// Every edge of the kind must be among them, in either direction. Of a cubic tetrahedron the nodes
/// in faces follow in the order `faces`: the place of the zoo's face f among the format's.
std::vector<std::uint8_t> permutation_by_edges(CellKind kind, std::span<const std::uint8_t> corners,
                                               std::span<const ShapeEdge> edges,
                                               std::span<const std::uint8_t> faces = {});

/// The same permutation, kept for good: conversions look into it. Equal ones are kept once.
std::span<const std::uint8_t> kept_permutation(std::vector<std::uint8_t> permutation);

}  // namespace hiac::formats

#pragma once

#include "formats/common/cells/cell_conversion.hpp"

namespace hiac::formats {

/// The conversion of a format's cell that lists the corners of the shape in the usual right-handed
/// order and then, if it is quadratic, one node per edge in the order `edges` (pairs of the
/// format's corners). Without `edges`: the zoo's order of edges, which VTK, Abaqus, Exodus and
/// others use (of a prism: 0-1, 1-2, 2-0, 3-4, 4-5, 5-3, 0-3, 1-4, 2-5).
CellConversion solid_conversion(CellKind kind, std::span<const ShapeEdge> edges = {});

/// The same with the corners in another order: node i of the kind is the format's corner
/// corners[i].
CellConversion ordered_conversion(CellKind kind, std::span<const std::uint8_t> corners,
                                  std::span<const ShapeEdge> edges);

/// Solids that list vertical edges before the edges of the top: bricks of 20 nodes and prisms of 15
/// (CalculiX's results, Nastran).
CellConversion vertical_edges_first(CellKind kind);

/// A volume cell that the zoo has no kind for and whose first nodes are the corners of the shape.
CellConversion unsupported_with_corners(CellShape shape);

}  // namespace hiac::formats

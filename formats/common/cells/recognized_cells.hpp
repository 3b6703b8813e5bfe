#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "formats/common/cells/cell_conversion.hpp"
#include "formats/common/cells/lattice.hpp"

namespace hiac::formats {

/// The positions of the nodes of a file's cell, in the file's order.
using NodePositions = std::vector<std::array<double, 3>>;

/// The conversion of cells with more nodes than any of the zoo's kinds to the nearest kind.
struct RecognizedCell {
  CellKind kind;
  std::size_t order;
  /// For every node of the kind, in the zoo's order, its value as weights of the values at the
  /// file's nodes.
  std::vector<Weights> weights;
  /// A node of the file that is not a node of the kind: its place, and the kind's shape functions
  /// there.
  struct LeftOut {
    std::size_t place;
    std::vector<double> shape_functions;
  };
  std::vector<LeftOut> left_out;
};

/// Recognizes a cell type of which only the corners are known (CellConversion::corners) by the
/// positions of its other nodes: each is assigned to the evenly spaced point that it is nearest to
/// on average over the given cells. The order in which a format lists the nodes of edges, faces and
/// the interior is therefore irrelevant. Nothing when no order from 2 to 9 fits, that is, when one
/// point is the nearest to two nodes, or nodes are further away than a third of the spacing.
std::optional<RecognizedCell> recognized_cell(const CellConversion& conversion,
                                              std::span<const NodePositions> cells);

}  // namespace hiac::formats

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
  /// For every node of the kind, in the zoo's order, its value from those at the file's nodes.
  std::vector<Weights> weights;
  /// A node of the file that is none of the kind's: its place, and the kind's shape functions
  /// there.
  struct LeftOut {
    std::size_t place;
    std::vector<double> shape_functions;
  };
  std::vector<LeftOut> left_out;
};

/// Recognizes a type of cell of which only the corners are known (CellConversion::corners) by where
/// its further nodes lie: each is taken to be at that evenly spaced point of the cell that it is
/// nearest to in the mean of the cells given. So it does not matter in which order a format lists
/// the nodes of edges, faces and inside. Nothing when no order from 2 to 9 fits, one point being
/// the nearest to two nodes, or nodes being further away than a third of the spacing.
std::optional<RecognizedCell> recognized_cell(const CellConversion& conversion,
                                              std::span<const NodePositions> cells);

}  // namespace hiac::formats

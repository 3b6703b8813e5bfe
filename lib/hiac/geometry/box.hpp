#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A closed box along the axes. The empty one has low > high.
struct Box {
  Vector low, high;

  static Box empty();
  void include(std::span<const double, 3> p) {
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], p[c]);
      high[c] = std::max(high[c], p[c]);
    }
  }
  void include(const Box& box) {
    include(std::span<const double, 3>(box.low));
    include(std::span<const double, 3>(box.high));
  }
  [[nodiscard]] bool meets(const Box& other) const {
    for (std::size_t c = 0; c < 3; ++c)
      if (other.high[c] < low[c] || high[c] < other.low[c]) return false;
    return true;
  }
  /// The distance between opposite corners; 0 of the empty box.
  [[nodiscard]] double diagonal() const;
};

/// The box around all nodes of a mesh, those of no cell included.
Box box_of_nodes(const ZooMesh& mesh);

/// The box around the nodes of a mesh's cells.
Box box_of_cells(const ZooMesh& mesh);

}  // namespace hiac

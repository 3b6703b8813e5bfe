#pragma once

#include <cstdint>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The numbering of FaceAdjacency: the number of each cell's first face. A mesh of a single shape
/// needs no table for it.
class FaceNumbering {
 public:
  explicit FaceNumbering(const ZooMesh& mesh);

  /// The number of a cell's first face; for the cell after the last, the number of all faces.
  [[nodiscard]] std::uint64_t first(std::size_t cell) const {
    return table_.empty() ? stride_ * cell : table_[cell];
  }
  [[nodiscard]] std::uint32_t count(std::size_t cell) const {
    return table_.empty() ? stride_ : static_cast<std::uint32_t>(table_[cell + 1] - table_[cell]);
  }

 private:
  std::uint32_t stride_ = 0;
  std::vector<std::uint64_t> table_;
};

}  // namespace hiac

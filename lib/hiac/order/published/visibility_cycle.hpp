#pragma once

#include <vector>

#include "hiac/base/error.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A visibility cycle, which an algorithm reports instead of an order: no order of the cells is
/// right along every ray.
class VisibilityCycle : public JudgementError {
 public:
  /// `cells`: each is partly in front of the next, and the last of the first. The message names
  /// them, or the first few of a long cycle.
  explicit VisibilityCycle(std::vector<CellId> cells);

  [[nodiscard]] const std::vector<CellId>& cells() const { return cells_; }

 private:
  std::vector<CellId> cells_;
};

}  // namespace hiac

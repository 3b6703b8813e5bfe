#pragma once

#include <functional>
#include <vector>

#include "hiac/annotate/ticks.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// The scalars along a bar: 0 is its lower end, 1 its upper one.
class ScalarAxis {
 public:
  /// low <= high, even in the scalar or in its logarithm, for which low is positive. A range of one
  /// value, or too narrow for round numbers, is widened.
  ScalarAxis(double low, double high, bool logarithmic);

  [[nodiscard]] double value_at(double t) const;
  [[nodiscard]] double position_of(double value) const;

  /// Round numbers, as many as `fit`, at most 7 and at least 2.
  [[nodiscard]] std::vector<Tick> ticks(
      const std::function<bool(const std::vector<Tick>&)>& fit) const;

 private:
  double low_, high_;
  bool logarithmic_;
};

/// The first and the last scalar of a transfer function.
template <std::size_t N>
std::array<double, 2> scalars_of(const TransferFunction<N>& transfer) {
  return {transfer.points.front().scalar, transfer.points.back().scalar};
}

/// The axis of scalars from low to high. Throws InputError "key `KEY`: ..." where it is to be
/// logarithmic and low is not positive.
ScalarAxis axis_over(const std::array<double, 2>& range, bool logarithmic, const std::string& key);

}  // namespace hiac

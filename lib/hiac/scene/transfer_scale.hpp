#pragma once

#include <vector>

#include "hiac/base/transfer_function.hpp"

namespace hiac {

/// How a transfer function's points lie on its scalars: evenly, or evenly in their logarithms.
enum class TransferScale : bool { linear, log };

template <std::size_t N>
using TransferPoints = std::vector<typename PiecewiseLinear<N>::Point>;

/// Moves points on 0 to 1 to the scalars from `low` to `high`, exactly at both ends. `low` <
/// `high`; for the logarithmic scale both are positive.
template <std::size_t N>
TransferPoints<N> stretched(TransferPoints<N> points, double low, double high, TransferScale scale);

/// Points on positive scalars between which values are linear in the scalar's logarithm, as points
/// between which they are linear in the scalar: no channel differs by more than `tolerance`, which
/// is positive (proven by the largest curvature of the logarithm in every piece).
template <std::size_t N>
TransferPoints<N> logarithmic(const TransferPoints<N>& points, double tolerance);

extern template TransferPoints<1> stretched<1>(TransferPoints<1>, double, double, TransferScale);
extern template TransferPoints<3> stretched<3>(TransferPoints<3>, double, double, TransferScale);
extern template TransferPoints<1> logarithmic<1>(const TransferPoints<1>&, double);
extern template TransferPoints<3> logarithmic<3>(const TransferPoints<3>&, double);

}  // namespace hiac

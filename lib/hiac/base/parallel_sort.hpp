#pragma once

#include <vector>

#include <oneapi/tbb/parallel_sort.h>

#include "hiac/base/cancellation.hpp"

namespace hiac {

/// Sorts by `less`, with any number of threads. `less` must be a total order, so that the result
/// does not depend on the number of threads. Throws Cancelled, with the elements in arbitrary
/// order, if the current cancellation is requested.
template <typename T, typename Less>
void parallel_sort(std::vector<T>& elements, const Less& less) {
  const Cancellation* const cancellation = current_cancellation();
  if (cancellation == nullptr) {
    oneapi::tbb::parallel_sort(elements.begin(), elements.end(), less);
    return;
  }
  oneapi::tbb::parallel_sort(elements.begin(), elements.end(), [&](const T& a, const T& b) {
    if (cancellation->requested()) throw Cancelled();
    return less(a, b);
  });
}

}  // namespace hiac

#pragma once

#include <vector>

#include <oneapi/tbb/parallel_sort.h>

namespace hiac {

/// Sorts by `less`, with any number of threads. `less` must be a total order: then the result does
/// not depend on the number of threads.
template <typename T, typename Less>
void parallel_sort(std::vector<T>& elements, const Less& less) {
  oneapi::tbb::parallel_sort(elements.begin(), elements.end(), less);
}

}  // namespace hiac

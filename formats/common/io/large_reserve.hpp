#pragma once

#include <cstddef>
#include <vector>

namespace hiac::formats {

/// Asks the system to back memory by large pages where it likes to: a mesh's arrays are written
/// from front to back, and every page that is touched first costs a fault.
void prefer_large_pages(const void* data, std::size_t bytes);

/// Room for that many elements, on large pages. More than will be needed does no harm: memory is
/// taken when it is written to.
template <typename T>
void reserve_large(std::vector<T>& values, std::size_t count) {
  if (count <= values.capacity()) return;
  values.reserve(count);
  prefer_large_pages(values.data(), values.capacity() * sizeof(T));
}

}  // namespace hiac::formats

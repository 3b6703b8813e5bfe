#pragma once

#include <cstddef>
#include <vector>

namespace hiac::formats {

/// Advises the system to back memory by large pages: a mesh's arrays are written from front to
/// back, and the first access to every page costs a fault.
void prefer_large_pages(const void* data, std::size_t bytes);

/// Reserves room for that many elements, on large pages. Reserving too much is harmless: the system
/// allocates memory only when it is written.
template <typename T>
void reserve_large(std::vector<T>& values, std::size_t count) {
  if (count <= values.capacity()) return;
  values.reserve(count);
  prefer_large_pages(values.data(), values.capacity() * sizeof(T));
}

}  // namespace hiac::formats

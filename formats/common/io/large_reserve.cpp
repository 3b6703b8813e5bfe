#include "formats/common/io/large_reserve.hpp"

#include <cstdint>

#include <sys/mman.h>

namespace hiac::formats {

void prefer_large_pages(const void* data, std::size_t bytes) {
  constexpr std::uintptr_t kLargePage = 1U << 21;
  const auto begin = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t first = (begin + kLargePage - 1) & ~(kLargePage - 1);
  const std::uintptr_t last = (begin + bytes) & ~(kLargePage - 1);
  // only advice: if the system ignores it, small pages work as well
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

}  // namespace hiac::formats

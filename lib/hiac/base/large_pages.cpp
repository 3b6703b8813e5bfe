#include "hiac/base/large_pages.hpp"

#include <cstdint>

#include <sys/mman.h>

namespace hiac {
namespace {

constexpr std::uintptr_t kLargePage = std::uintptr_t{1} << 21;
// Smaller arrays fit into caches, and may lie in memory that the heap reuses.
constexpr std::size_t kLeastPages = 8;

}  // namespace

void advise_large_pages(void* memory, std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  if (bytes < kLeastPages * kLargePage) return;
  // only whole large pages inside the array, so that its neighbours are unaffected
  auto* const bytes_of_array = static_cast<unsigned char*>(memory);
  const std::uintptr_t address = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t begin = (address + kLargePage - 1) / kLargePage * kLargePage;
  const std::uintptr_t end = (address + bytes) / kLargePage * kLargePage;
  // if the system does not take the advice, that costs time, not correctness
  static_cast<void>(madvise(bytes_of_array + (begin - address), end - begin, MADV_HUGEPAGE));
#else
  static_cast<void>(memory);
  static_cast<void>(bytes);
#endif
}

}  // namespace hiac

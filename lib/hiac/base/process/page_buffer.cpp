#include "hiac/base/process/page_buffer.hpp"

#include <new>

#include <sys/mman.h>

namespace hiac {

PageBuffer::~PageBuffer() {
  if (size_ > 0) munmap(data_, size_);
}

void PageBuffer::grow(std::size_t size) {
  void* const grown =
      size_ == 0 ? mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)
                 : mremap(data_, size_, size, MREMAP_MAYMOVE);
  if (grown == MAP_FAILED) throw std::bad_alloc();
  data_ = grown;
  size_ = size;
}

}  // namespace hiac

#include "hiac/base/process/shared_memory.hpp"

#include <array>
#include <atomic>
#include <new>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hiac {
namespace {

constexpr std::size_t kCountedSlots = 256;
constexpr std::uint64_t kBlock = 512;  // the unit of st_blocks

// What exists now, for whoever counts: descriptors + 1. Few exist at a time.
std::array<std::atomic<int>, kCountedSlots> counted{};

}  // namespace

SharedMemory::SharedMemory()
    : descriptor_(memfd_create("hiac", MFD_CLOEXEC | MFD_ALLOW_SEALING)), slot_(0) {
  if (descriptor_ < 0) throw std::bad_alloc();
  fcntl(descriptor_, F_ADD_SEALS, F_SEAL_SHRINK);
  for (; slot_ < kCountedSlots; ++slot_) {
    int none = 0;
    if (counted[slot_].compare_exchange_strong(none, descriptor_ + 1)) break;
  }
}

SharedMemory::~SharedMemory() {
  if (slot_ < kCountedSlots) counted[slot_] = 0;
  close(descriptor_);
}

std::size_t SharedMemory::size() const {
  struct stat status {};
  return fstat(descriptor_, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
}

void SharedMemory::discard(std::size_t begin, std::size_t end) const {
  if (begin < end)
    fallocate(descriptor_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(begin),
              static_cast<off_t>(end - begin));
}

std::uint64_t bytes_in_shared_memory() {
  std::uint64_t sum = 0;
  for (const auto& slot : counted) {
    struct stat status {};
    if (const int next = slot; next > 0 && fstat(next - 1, &status) == 0)
      sum += static_cast<std::uint64_t>(status.st_blocks) * kBlock;
  }
  return sum;
}

}  // namespace hiac

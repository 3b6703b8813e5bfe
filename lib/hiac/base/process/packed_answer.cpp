#include <cstdint>
#include <map>
#include <mutex>
#include <new>

#include <sys/mman.h>

#include "hiac/base/process/isolated_process.hpp"

namespace hiac {
namespace {

struct Block {
  std::shared_ptr<const SharedMemory> memory;
  std::size_t at, size;
};

// What free_block is to free.
struct Blocks {
  std::mutex mutex;
  std::map<void*, Block> known;
};
Blocks& blocks() {
  static Blocks all;
  return all;
}

void* mapped(const SharedMemory& memory, std::size_t at, std::size_t size) {
  void* const data = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, memory.descriptor(),
                          static_cast<off_t>(at));
  if (data == MAP_FAILED) throw std::bad_alloc();
  return data;
}

constexpr std::size_t whole_pages(std::size_t size) {
  return (size + kPackPage - 1) / kPackPage * kPackPage;
}

}  // namespace

PackedAnswer::PackedAnswer(std::shared_ptr<const SharedMemory> memory, std::size_t begin,
                           std::size_t end)
    : memory_(std::move(memory)), begin_(begin), end_(end) {
  if (begin_ % kPackPage != 0 || begin_ >= end_ || end_ > memory_->size()) throw std::bad_alloc();
  data_ = static_cast<char*>(mapped(*memory_, begin_, end_ - begin_));
}

PackedAnswer::~PackedAnswer() {
  munmap(data_, end_ - begin_);
  std::size_t at = begin_;
  for (const auto& [begin, end] : taken_) {
    memory_->discard(at, begin);
    at = end;
  }
  memory_->discard(at, end_);
}

void* PackedAnswer::take_block(std::span<const char> block) {
  const std::size_t at = begin_ + static_cast<std::size_t>(block.data() - data_);
  const std::size_t size = whole_pages(block.size());
  void* const data = mapped(*memory_, at, size);
  taken_.emplace_back(at, at + size);
  const std::lock_guard lock(blocks().mutex);
  blocks().known[data] = {memory_, at, size};
  return data;
}

void free_block(void* data) {
  const std::lock_guard lock(blocks().mutex);
  const auto found = blocks().known.find(data);
  if (found == blocks().known.end()) return;
  const Block& block = found->second;
  // in this order: of memory that nobody maps, whole runs of pages are freed at once
  munmap(data, block.size);
  block.memory->discard(block.at, block.at + block.size);
  blocks().known.erase(found);
}

}  // namespace hiac

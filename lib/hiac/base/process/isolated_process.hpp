#pragma once

#include <functional>
#include <memory>
#include <string>

#include <sys/types.h>

#include "hiac/base/process/pack.hpp"
#include "hiac/base/process/shared_memory.hpp"

namespace hiac {

/// The packed answer to a request, mapped into memory; what lies outside the blocks that have been
/// taken (SharedBlock) is given back by the destructor.
class PackedAnswer {
 public:
  /// The bytes [begin, end) of the memory.
  PackedAnswer(std::shared_ptr<const SharedMemory> memory, std::size_t begin, std::size_t end);
  ~PackedAnswer();
  PackedAnswer(const PackedAnswer&) = delete;
  PackedAnswer& operator=(const PackedAnswer&) = delete;

  [[nodiscard]] std::span<const char> bytes() const { return {data_, end_ - begin_}; }
  /// Maps a block (PackReader::block) once more, so that it outlives this and may be written to. It
  /// is freed by free_block.
  void* take_block(std::span<const char> block);

 private:
  std::shared_ptr<const SharedMemory> memory_;
  std::size_t begin_, end_;
  char* data_ = nullptr;
  std::vector<std::pair<std::size_t, std::size_t>> taken_;  ///< places in the memory, rising
};

/// Frees what PackedAnswer::take_block returned.
void free_block(void* block);

/// A process that reads files for this one, request by request, with libraries that are not safe
/// against damaged files: whatever they do, it is contained. It is a fork of this thread alone:
/// what it runs must not use threads. It ends with this object, or with this process.
class IsolatedProcess {
 public:
  /// What the process does with a request: packs the answer, or throws an Error.
  using Serve =
      std::function<void(const std::string& path, const std::string& request, PackWriter& answer)>;

  /// Messages name `library`. Throws std::bad_alloc when no process can be made.
  IsolatedProcess(std::string library, Serve serve);
  ~IsolatedProcess();
  IsolatedProcess(const IsolatedProcess&) = delete;
  IsolatedProcess& operator=(const IsolatedProcess&) = delete;

  /// The answer to a request about the file `path`. Errors of `serve` are passed on; a crash, or
  /// more than ten minutes + 1 s a megabyte of the file of processor time for this request, becomes
  /// an InputError naming `path` and the library, and so does every request after that.
  PackedAnswer answer(const std::string& path, const std::string& request);

 private:
  struct Link;
  std::string library_;
  Serve serve_;
  std::shared_ptr<const SharedMemory> memory_;
  std::unique_ptr<Link> link_;
};

}  // namespace hiac

#pragma once

#include <string>
#include <string_view>

#include "hiac/base/process/shared_memory.hpp"

namespace hiac::formats {

/// A regular file mapped into memory, which can be read without allocating memory for it.
class MappedFile {
 public:
  /// Throws InputError naming the file when it is not a regular file or cannot be opened.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  [[nodiscard]] std::string_view text() const { return {data_, size_}; }

 private:
  const char* data_ = nullptr;
  std::size_t size_ = 0;
};

/// A copy of a file's text in memory that has a name under which libraries can open it.
class MemoryFile {
 public:
  /// Throws InputError naming `subject` when there is no memory for it.
  MemoryFile(std::string_view text, const std::string& subject);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Overwrites the word at text[at, at + length) by a zero and blanks.
  void put_zero(std::size_t at, std::size_t length);
  /// Overwrites text[at, at + length) by blanks.
  void put_blanks(std::size_t at, std::size_t length);

 private:
  SharedMemory memory_;
  std::string path_;
  std::string subject_;
};

}  // namespace hiac::formats

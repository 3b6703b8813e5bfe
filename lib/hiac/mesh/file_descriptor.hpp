#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace hiac {

/// An open file descriptor, which the destructor closes.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  [[nodiscard]] int number() const { return number_; }
  /// Closes the file now. Throws InputError if the system reports lost data.
  void close(const std::string& subject);

 private:
  int number_;
};

/// Opens a file to be read. Throws InputError.
FileDescriptor open_to_read(const std::string& path);

/// Opens an existing file, pipe or device to be written from its beginning. Throws InputError.
FileDescriptor open_to_write(const std::string& path);

/// Reads until `buffer` is full or the stream ends; returns the number of bytes. Throws InputError.
std::size_t read_fully(int descriptor, std::span<std::uint8_t> buffer, const std::string& subject);

/// Writes all of `bytes`. Throws InputError, also if the reader of a pipe has closed it.
void write_fully(int descriptor, std::span<const std::uint8_t> bytes, const std::string& subject);

}  // namespace hiac

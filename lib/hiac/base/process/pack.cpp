#include "hiac/base/process/pack.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <new>

#include <sys/mman.h>
#include <unistd.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

constexpr std::size_t kAlignment = 8;

constexpr std::size_t padding_of(std::size_t size, std::size_t alignment) {
  return (alignment - size % alignment) % alignment;
}

/// Frees the whole pages of private memory that nobody reads any more.
void give_back(char* data, std::size_t count) {
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  const std::size_t before = padding_of(address, kPackPage);
  if (count < before + kPackPage) return;
  madvise(data + before, (count - before) / kPackPage * kPackPage, MADV_DONTNEED);
}

}  // namespace

void PackWriter::write_all(const char* data, std::size_t count) {
  while (count > 0) {
    const ssize_t done = ::pwrite(descriptor_, data, count, static_cast<off_t>(at_));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) throw std::bad_alloc();
    data += done;
    at_ += static_cast<std::size_t>(done);
    count -= static_cast<std::size_t>(done);
  }
}

void PackWriter::pad(std::size_t alignment) {
  static constexpr std::array<char, kPackPage> kZeros{};
  write_all(kZeros.data(), padding_of(at_, alignment));
}

void PackWriter::bytes(const void* data, std::size_t count) {
  write_all(static_cast<const char*>(data), count);
  pad(kAlignment);
}

void PackWriter::consume_block(void* data, std::size_t count) {
  constexpr std::size_t kPart = std::size_t{16} << 20;
  number(count);
  pad(kPackPage);
  char* at = static_cast<char*>(data);
  for (std::size_t left = count; left > 0;) {
    const std::size_t part = std::min(left, kPart);
    write_all(at, part);
    give_back(at, part);
    at += part;
    left -= part;
  }
  pad(kPackPage);
}

void PackWriter::text(std::string_view value) {
  number(value.size());
  bytes(value.data(), value.size());
}

std::span<const char> PackReader::take(std::size_t size) {
  const std::size_t padded = size + padding_of(size, kAlignment);
  if (padded < size || padded > rest_.size()) fail();
  const std::span<const char> part = rest_.first(size);
  rest_ = rest_.subspan(padded);
  return part;
}

void PackReader::skip_to_page() {
  const std::size_t padding = padding_of(all_.size() - rest_.size(), kPackPage);
  if (padding > rest_.size()) fail();
  rest_ = rest_.subspan(padding);
}

std::span<const char> PackReader::block() {
  const std::uint64_t size = number();
  skip_to_page();
  if (size > rest_.size()) fail();
  const std::span<const char> part = rest_.first(size);
  rest_ = rest_.subspan(size);
  skip_to_page();
  return part;
}

void PackReader::fail() const {
  throw InputError(subject_, "cannot be read: the library that reads it was led astray");
}

std::uint64_t PackReader::number() {
  std::uint64_t value = 0;
  std::memcpy(&value, take(sizeof value).data(), sizeof value);
  return value;
}

std::uint64_t PackReader::number_below(std::uint64_t limit) {
  const std::uint64_t value = number();
  if (value >= limit) fail();
  return value;
}

std::span<const char> PackReader::text_bytes() {
  const std::uint64_t size = number();
  if (size > rest_.size()) fail();
  return take(size);
}

std::string PackReader::text() {
  const std::span<const char> part = text_bytes();
  return {part.begin(), part.end()};
}

std::size_t PackReader::count() {
  const std::uint64_t value = number();
  if (value > rest_.size() / sizeof value) fail();
  return value;
}

}  // namespace hiac

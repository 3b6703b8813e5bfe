#include "formats/common/io/pack.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <new>

#include <unistd.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

constexpr std::size_t kAlignment = 8;

constexpr std::size_t padding_of(std::size_t size) {
  return (kAlignment - size % kAlignment) % kAlignment;
}

}  // namespace

void PackWriter::bytes(const void* data, std::size_t count) {
  const auto write_all = [&](const char* at, std::size_t left) {
    while (left > 0) {
      const ssize_t done = ::write(descriptor_, at, left);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) throw std::bad_alloc();
      at += done;
      left -= static_cast<std::size_t>(done);
    }
  };
  constexpr std::array<char, kAlignment> kZeros{};
  write_all(static_cast<const char*>(data), count);
  write_all(kZeros.data(), padding_of(count));
}

void PackWriter::text(std::string_view value) {
  number(value.size());
  bytes(value.data(), value.size());
}

std::span<const char> PackReader::take(std::size_t size) {
  const std::size_t padded = size + padding_of(size);
  if (padded < size || padded > rest_.size()) fail();
  const std::span<const char> part = rest_.first(size);
  rest_ = rest_.subspan(padded);
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

std::string PackReader::text() {
  const std::uint64_t size = number();
  if (size > rest_.size()) fail();
  const std::span<const char> part = take(size);
  return {part.begin(), part.end()};
}

std::size_t PackReader::count() {
  const std::uint64_t value = number();
  if (value > rest_.size() / sizeof value) fail();
  return value;
}

}  // namespace hiac::formats

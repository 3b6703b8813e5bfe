#pragma once

#include <cstring>
#include <initializer_list>
#include <string>

namespace hiac::formats {

/// The bytes of numbers as this machine stores them.
template <typename Number>
std::string raw_bytes(std::initializer_list<Number> numbers) {
  std::string bytes;
  for (const Number number : numbers) {
    char raw[sizeof(Number)];
    std::memcpy(raw, &number, sizeof(Number));
    bytes.append(raw, sizeof(Number));
  }
  return bytes;
}

}  // namespace hiac::formats

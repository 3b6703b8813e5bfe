#pragma once

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "tests/support/instrumented.hpp"

namespace hiac::test {

/// How many changes of each input are tried: what the environment variable HIAC_MUTATIONS says, or
/// the usual number.
inline int mutations_wanted(std::size_t usual) {
  const char* const wanted = std::getenv("HIAC_MUTATIONS");
  return wanted == nullptr ? static_cast<int>(tried(usual)) : std::atoi(wanted);
}

/// Bytes with up to four changes: cut off, taken out, doubled, or replaced by what means something
/// to a reader.
inline std::string mutated(std::string bytes, std::mt19937& random) {
  static const std::vector<std::string> kTelling{"0",
                                                 "-1",
                                                 "9999999999",
                                                 "1e400",
                                                 "nan",
                                                 "",
                                                 "\n",
                                                 ",",
                                                 "\xff",
                                                 "\"",
                                                 "=",
                                                 "[",
                                                 "2000000000",
                                                 std::string(4, '\0'),
                                                 std::string("\xff\xff\xff\x7f", 4),
                                                 std::string(8, '\xff')};
  for (std::size_t changes = 1 + random() % 4; changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = random() % bytes.size();
    switch (random() % 6) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(at, random() % 16);
        break;
      case 2:
        bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 64));
        break;
      case 3:
        bytes.replace(at, random() % 6, kTelling[random() % kTelling.size()]);
        break;
      default:
        bytes[at] = static_cast<char>(random() % 256);
    }
  }
  return bytes;
}

}  // namespace hiac::test

#pragma once

#include <cstddef>
#include <vector>

namespace hiac::test {

/// Whether sanitizers watch this program, which makes it some fifteen times slower.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool kInstrumented = true;
#else
inline constexpr bool kInstrumented = false;
#endif

/// Of `all` cases of one kind, how many a test tries: a quarter of them where it is instrumented.
/// Results are proven by all of them; what sanitizers find, they find in few.
constexpr std::size_t tried(std::size_t all) { return kInstrumented ? (all + 3) / 4 : all; }

/// The cases that are tried, spread over all of them.
template <class Case>
std::vector<Case> tried(std::vector<Case> all) {
  if constexpr (kInstrumented) {
    std::vector<Case> some;
    for (std::size_t k = 0; k < all.size(); k += 4) some.push_back(all[k]);
    return some;
  }
  return all;
}

}  // namespace hiac::test

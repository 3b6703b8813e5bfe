#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tests/render/truth/random_scenes.hpp"

namespace hiac::test {

/// A pixel's error, R, G, B or A, and what the channel "error" says it is at most.
struct PixelError {
  std::uint64_t seed = 0;
  std::uint32_t x = 0, y = 0;
  std::size_t channel = 0;
  double error = 0, claimed = 0;

  /// Error by claim; infinite where the claim is not a number.
  [[nodiscard]] double ratio() const;
};

/// What pictures of random scenes come to.
struct ErrorComparison {
  std::uint64_t pixels = 0;      ///< all but those in which nothing is seen
  std::uint64_t at_default = 0;  ///< of those, at the default tolerance
  std::vector<double> claims;    ///< of those, every one
  double largest_error = 0;
  PixelError worst;                  ///< by ratio
  PixelError largest_claim;          ///< at the default tolerance
  std::vector<PixelError> failures;  ///< ratio above 1: at most 20

  void add(const ErrorComparison& other);
};

/// Renders a random scene over its background with the channel "error" and compares with
/// SceneTruth.
ErrorComparison compare_error_channel(SceneCells cells, std::uint64_t seed, std::uint32_t side);

}  // namespace hiac::test

// Compares the channel "error" with the true error of as many pixels of random scenes as one likes:
//     error_sweep tetrahedra 10000000
//     error_sweep other 300000 [first seed]
//     error_sweep curved 30000 [first seed]
// and exits 1 where a claim was too small. A small sample of it is error_bound_test.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <string>

#include <fmt/format.h>

#include "hiac/base/parallel.hpp"
#include "tests/render/truth/error_comparison.hpp"

namespace {

using hiac::test::ErrorComparison;
using hiac::test::PixelError;

constexpr std::uint32_t kSide = 80;

void print(const char* what, const PixelError& e) {
  fmt::print("{}: seed {} pixel {},{} channel {}: error {:.3e}, claimed {:.3e}, ratio {:.3g}\n",
             what, e.seed, e.x, e.y, "RGBA"[e.channel], e.error, e.claimed, e.ratio());
}

void report(ErrorComparison& all, std::uint64_t scenes) {
  fmt::print("{} pixels of {} scenes, largest error {:.3e}\n", all.pixels, scenes,
             all.largest_error);
  print("largest ratio", all.worst);
  for (const PixelError& failure : all.failures) print("TOO SMALL", failure);
  if (all.claims.empty()) return;
  print("largest claim at the default tolerance", all.largest_claim);
  std::ranges::sort(all.claims);
  const auto quantile = [&](double q) {
    return all.claims[static_cast<std::size_t>(q * static_cast<double>(all.claims.size() - 1))];
  };
  const auto above = all.claims.end() - std::ranges::upper_bound(all.claims, 1e-10);
  fmt::print(
      "claims at the default tolerance, {} pixels: median {:.1e}, 90 % {:.1e}, 99 % {:.1e}, "
      "99.9 % {:.1e}; {:.4f} % above 1e-10\n",
      all.at_default, quantile(0.5), quantile(0.9), quantile(0.99), quantile(0.999),
      100 * static_cast<double>(above) / static_cast<double>(all.claims.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: error_sweep tetrahedra|other|curved PIXELS [SEED]\n");
    return 2;
  }
  using hiac::test::SceneCells;
  const std::string what = argv[1];
  const auto cells = what == "tetrahedra" ? SceneCells::tetrahedra
                     : what == "curved"   ? SceneCells::curved
                                          : SceneCells::other_kinds;
  const std::uint32_t side = cells == SceneCells::tetrahedra ? kSide : kSide / 4;
  const auto pixels = static_cast<std::uint64_t>(std::strtod(argv[2], nullptr));
  std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1, scenes = 0;
  ErrorComparison all;
  std::mutex mutex;
  constexpr std::size_t kBatch = 64;
  while (all.pixels < pixels) {
    hiac::parallel_for(kBatch, 1, [&](hiac::IndexRange range) {
      for (std::size_t k = range.begin; k < range.end; ++k) {
        const ErrorComparison one = hiac::test::compare_error_channel(cells, seed + k, side);
        const std::lock_guard lock(mutex);
        all.add(one);
      }
    });
    seed += kBatch;
    scenes += kBatch;
    if (scenes % (16 * kBatch) == 0) {
      report(all, scenes);
      std::fflush(stdout);
    }
  }
  report(all, scenes);
  return all.failures.empty() ? 0 : 1;
}

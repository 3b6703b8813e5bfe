#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include "hiac/optics/linear_piece.hpp"
#include "hiac/optics/polynomial_piece.hpp"
#include "tests/support/linear_piece_vectors.hpp"

namespace hiac {
namespace {

constexpr std::size_t kPieces = 1024;  // inputs and outputs stay in the first-level cache

struct Batch {
  std::vector<double> b = std::vector<double>(kPieces);
  std::vector<double> a = std::vector<double>(kPieces);
  std::vector<double> transparency = std::vector<double>(kPieces);
  std::vector<double> front = std::vector<double>(kPieces);
  std::vector<double> back = std::vector<double>(kPieces);
  LinearPieceOutput output{transparency, front, back};

  /// `thick_share` of the pieces have densities up to 100, the rest up to `largest`.
  explicit Batch(double largest, double thick_share = 0) {
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (std::size_t i = 0; i < kPieces; ++i) {
      const double scale = unit(engine) < thick_share ? 100 : largest;
      b[i] = scale * unit(engine);
      a[i] = scale * unit(engine);
    }
  }
};

using Evaluate = void (*)(std::span<const double>, std::span<const double>,
                          const LinearPieceOutput&);

void run_batch(benchmark::State& state, Evaluate evaluate, double largest, double thick_share) {
  Batch batch(largest, thick_share);
  for (auto _ : state) {
    evaluate(batch.b, batch.a, batch.output);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(kPieces) * state.iterations());
}

void run_scalar(benchmark::State& state, double largest) {
  const Batch batch(largest);
  for (auto _ : state)
    for (std::size_t i = 0; i < kPieces; ++i)
      benchmark::DoNotOptimize(linear_piece_weights(batch.b[i], batch.a[i]));
  state.SetItemsProcessed(static_cast<std::int64_t>(kPieces) * state.iterations());
}

constexpr Evaluate kWeights = linear_piece_weights;
constexpr Evaluate kEmission = linear_piece_emission;

BENCHMARK_CAPTURE(run_batch, weights_to_0_1, kWeights, 0.1, 0);
BENCHMARK_CAPTURE(run_batch, weights_to_1, kWeights, 1, 0);
BENCHMARK_CAPTURE(run_batch, weights_to_4, kWeights, 4, 0);
BENCHMARK_CAPTURE(run_batch, weights_to_0_1_one_percent_thick, kWeights, 0.1, 0.01);
BENCHMARK_CAPTURE(run_batch, weights_to_100, kWeights, 100, 0);
BENCHMARK_CAPTURE(run_batch, emission_to_0_1, kEmission, 0.1, 0);
BENCHMARK_CAPTURE(run_batch, emission_to_1, kEmission, 1, 0);
BENCHMARK_CAPTURE(run_batch, emission_to_100, kEmission, 100, 0);
BENCHMARK_CAPTURE(run_scalar, weights_to_0_1, 0.1);
BENCHMARK_CAPTURE(run_scalar, weights_to_1, 1);
BENCHMARK_CAPTURE(run_scalar, weights_to_100, 100);

/// Segments of optical depth about 0.1 whose field crosses about one breakpoint.
void polynomial_segments(benchmark::State& state, Glow glow) {
  const auto degree = static_cast<std::size_t>(state.range(0));
  const std::vector<PiecewiseLinear<3>::Point> color_points{
      {0, {0, 0, 1}}, {0.5, {1, 1, 1}}, {1, {1, 0, 0}}};
  const std::vector<PiecewiseLinear<1>::Point> extinction_points{{0, {0}}, {1, {2}}};
  const PiecewiseLinear<3> color(color_points);
  const PiecewiseLinear<1> extinction(extinction_points);
  std::mt19937_64 engine(8);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<PolynomialSegment> segments;
  for (int i = 0; i < 256; ++i) {
    std::vector<double> c(degree + 1);
    for (double& v : c) v = unit(engine);
    segments.push_back({BernsteinPolynomial(c), BernsteinPolynomial(c), 0.1});
  }
  for (auto _ : state)
    for (const PolynomialSegment& segment : segments)
      benchmark::DoNotOptimize(integrate_segment(segment, color, extinction, glow, 1e-9));
  state.SetItemsProcessed(static_cast<std::int64_t>(segments.size()) * state.iterations());
}

BENCHMARK_CAPTURE(polynomial_segments, chromaticity, Glow::chromaticity)->Arg(1)->Arg(2)->Arg(4);
BENCHMARK_CAPTURE(polynomial_segments, emission, Glow::emission)->Arg(2);

}  // namespace
}  // namespace hiac

#pragma once

#include <cstdint>
#include <map>

#include "hiac/scene/scene.hpp"

namespace hiac::view {

/// Chooses how coarse pictures are while something moves: every step-th pixel of every step-th row
/// (coarse_scene.hpp), the smallest step whose pictures take no longer than a twentieth of a
/// second.
///
/// It does not flicker: a step changes only for times that are clearly too long, or for a finer one
/// that is clearly fast enough. What a finer picture takes is what it took when it was last drawn,
/// or, where that is not known, what it takes if all time goes into pixels.
class StepChoice {
 public:
  static constexpr double kSecondsPerFrame = 0.05;

  /// The step for the next picture of that size.
  [[nodiscard]] std::uint32_t step(ImageSize size);

  /// Tells how long a picture of the present step took.
  void took(double seconds);

  /// The scene or the mesh is another one: earlier times say nothing.
  void forget();

 private:
  // no coarser than this many pixels, 200 x 150, whatever the time
  static constexpr std::uint64_t kFewestPixels = 30000;

  [[nodiscard]] static std::uint32_t coarsest(ImageSize size);
  [[nodiscard]] double expected(std::uint32_t step) const;

  std::uint32_t step_ = 0;                // none yet
  std::map<std::uint32_t, double> took_;  // seconds by step, smoothed
  ImageSize size_{};
};

}  // namespace hiac::view

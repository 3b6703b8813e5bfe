#include "tools/view/viewport/step_choice.hpp"

#include <algorithm>

namespace hiac::view {

std::uint32_t StepChoice::coarsest(ImageSize size) {
  const std::uint64_t pixels = static_cast<std::uint64_t>(size.width) * size.height;
  std::uint32_t step = 1;
  while (pixels / (static_cast<std::uint64_t>(step + 1) * (step + 1)) >= kFewestPixels) ++step;
  return step;
}

// Time grows no faster than the number of pixels: a longer one that is known is of another view.
double StepChoice::expected(std::uint32_t step) const {
  const double ratio = static_cast<double>(step_) / step;
  const double most = took_.at(step_) * ratio * ratio;
  const auto known = took_.find(step);
  return known == took_.end() ? most : std::min(known->second, most);
}

std::uint32_t StepChoice::step(ImageSize size) {
  if (size != size_) forget();
  size_ = size;
  const std::uint32_t most = coarsest(size);
  if (step_ == 0) step_ = most;
  const auto now = took_.find(step_);
  if (now == took_.end()) return step_;
  constexpr double kTooLong = 1.2, kFastEnough = 0.8;
  if (now->second > kTooLong * kSecondsPerFrame)
    step_ = std::min(step_ + 1, most);
  else if (step_ > 1 && expected(step_ - 1) < kFastEnough * kSecondsPerFrame)
    --step_;
  return step_;
}

void StepChoice::took(double seconds) {
  constexpr double kNewest = 0.4;
  const auto [place, is_first] = took_.try_emplace(step_, seconds);
  if (!is_first) place->second += kNewest * (seconds - place->second);
}

void StepChoice::forget() {
  step_ = 0;
  took_.clear();
}

}  // namespace hiac::view

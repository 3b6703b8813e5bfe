#pragma once

#include <string>
#include <vector>

namespace hiac::tools {

struct Tick {
  double value;
  std::string label;
};

/// Round numbers in [low, high], at most `count` (at least 2) of them: all multiples there of the
/// smallest step of 1, 2 or 5 times a power of ten that leaves no more. Labels have the digits that
/// tell neighbours apart. Low and high are finite and differ by more than 1e-12 of the larger one.
/// After P. Heckbert, "Nice Numbers for Graph Labels", Graphics Gems, 1990.
std::vector<Tick> round_ticks(double low, double high, int count);

/// The largest number of 1, 2 or 5 times a power of ten that is at most `value` (positive, finite).
double round_below(double value);

}  // namespace hiac::tools

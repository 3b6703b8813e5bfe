#pragma once

#include <string>
#include <vector>

namespace hiac {

struct Tick {
  double value;
  std::string label;
};

/// Round numbers in [low, high], at most `count` (at least 2) of them: all multiples there of the
/// smallest step of 1, 2 or 5 times a power of ten that leaves no more. Labels have the digits that
/// tell neighbours apart. Low and high are finite and differ by more than 1e-12 of the larger one.
/// After P. Heckbert, "Nice Numbers for Graph Labels", Graphics Gems, 1990.
std::vector<Tick> round_ticks(double low, double high, int count);

/// Round numbers in [low, high], 0 < low < high, for an axis that is even in the logarithm: at most
/// `count` (at least 2) powers of ten, every second or third ... of them where there are more;
/// where there are fewer than two, also 2 and 5 times powers of ten; and where these are too few or
/// too many, round_ticks.
std::vector<Tick> logarithmic_ticks(double low, double high, int count);

/// A number as it is printed: a minus sign in place of the hyphen.
std::string typeset(const std::string& number);

/// The largest number of 1, 2 or 5 times a power of ten that is at most `value` (positive, finite).
double round_below(double value);

}  // namespace hiac

#pragma once

#include <span>

namespace hiac::formats {

/// What one unit in the last decimal digit of the largest value is worth, if the values look like
/// numbers that were rounded to decimal digits; otherwise 0.
///
/// The digits are those of the shortest decimal numbers that give the values (std::to_chars); the
/// value with most of them tells their number. Between kFewestDigits and kMostDigits they are taken
/// for rounded. Fewer may be exact, and more are those of a double; so may be multiples of a power
/// of two (0.015625), which are not counted.
double unit_of_last_digit(std::span<const double> values);
inline constexpr int kFewestDigits = 5;
inline constexpr int kMostDigits = 14;

}  // namespace hiac::formats

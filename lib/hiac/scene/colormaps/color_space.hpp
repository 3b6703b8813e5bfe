#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "hiac/scene/range_arithmetic.hpp"

namespace hiac::color_space {

// Colour spaces as VTK defines them, so that a preset has the same meaning as in ParaView: sRGB
// primaries with their usual four digits, white point D65 as (0.9505, 1, 1.089), and Moreland's
// polar form Msh of CIELAB (K. Moreland, "Diverging Color Maps for Scientific Visualization",
// 2009). The conversions to RGB are templates: evaluated with Range they prove bounds.

using Triple = std::array<double, 3>;

Triple rgb_to_lab(const Triple& rgb);
Triple rgb_to_hsv(const Triple& rgb);  ///< hue in [0, 1]
Triple lab_to_msh(const Triple& lab);  ///< magnitude, saturation angle, hue angle

/// Returns X/X_white from CIELAB's f: cubic, linear near black.
template <typename T>
T lab_inverse(const T& f) {
  // t > 0.008856, tested as f > its cube root
  constexpr double kThreshold = 0.20689170570621107;  // the cube root
  using Value = std::pair<double, double>;
  return switched(
      f, kThreshold,
      [](double x) -> Value {
        return {(x - 16.0 / 116.0) / 7.787, 1 / 7.787};
      },
      [](double x) -> Value {
        return {x * x * x, 3 * x * x};
      });
}

/// Encodes a linear component by sRGB's function.
template <typename T>
T gamma_encoded(const T& linear) {
  using Value = std::pair<double, double>;
  return switched(
      linear, 0.0031308,
      [](double x) -> Value {
        return {12.92 * x, 12.92};
      },
      [](double x) -> Value {
        const double root = std::pow(x, 1 / 2.4);
        return {1.055 * root - 0.055, 1.055 / 2.4 * root / x};
      });
}

/// Decodes a component that sRGB's function has encoded (IEC 61966-2-1:1999).
template <typename T>
T gamma_decoded(const T& encoded) {
  using Value = std::pair<double, double>;
  return switched(
      encoded, 0.04045,
      [](double x) -> Value {
        return {x / 12.92, 1 / 12.92};
      },
      [](double x) -> Value {
        const double base = (x + 0.055) / 1.055;
        return {std::pow(base, 2.4), 2.4 / 1.055 * std::pow(base, 1.4)};
      });
}

/// Converts CIELAB to RGB; colours outside RGB are scaled down to a largest component of 1, then
/// clamped at 0.
template <typename T>
std::array<T, 3> lab_to_rgb(const std::array<T, 3>& lab) {
  const T fy = (lab[0] + T(16)) * T(1 / 116.0);
  const T x = lab_inverse(fy + lab[1] * T(1 / 500.0)) * T(0.9505);
  const T y = lab_inverse(fy);
  const T z = lab_inverse(fy - lab[2] * T(1 / 200.0)) * T(1.089);
  const T r = gamma_encoded(x * T(3.2406) + y * T(-1.5372) + z * T(-0.4986));
  const T g = gamma_encoded(x * T(-0.9689) + y * T(1.8758) + z * T(0.0415));
  const T b = gamma_encoded(x * T(0.0557) + y * T(-0.2040) + z * T(1.0570));
  const T largest = maximum(T(1), maximum(r, maximum(g, b)));
  return {maximum(T(0), r / largest), maximum(T(0), g / largest), maximum(T(0), b / largest)};
}

template <typename T>
std::array<T, 3> msh_to_rgb(const std::array<T, 3>& msh) {
  const T radius = msh[0] * sine(msh[1]);
  return lab_to_rgb<T>({msh[0] * cosine(msh[1]), radius * cosine(msh[2]), radius * sine(msh[2])});
}

/// Converts HSV to RGB, for hues in [-1, 1], where -1, 0 and 1 are the same red.
template <typename T>
std::array<T, 3> hsv_to_rgb(const std::array<T, 3>& hsv) {
  const T six_h = hsv[0] * T(6);
  // a trapezoid around green (or blue): 1 within a sixth of the circle, 0 beyond a third
  const auto around = [&](double sixth) { return unit_clamped(T(2) - absolute(six_h - T(sixth))); };
  const std::array<T, 3> pure{unit_clamped(absolute(absolute(six_h) - T(3)) - T(1)),
                              maximum(around(2), around(-4)), maximum(around(4), around(-2))};
  std::array<T, 3> rgb;
  for (std::size_t c = 0; c < 3; ++c) rgb[c] = (hsv[1] * pure[c] + (T(1) - hsv[1])) * hsv[2];
  return rgb;
}

}  // namespace hiac::color_space

#pragma once

#include <cstdint>

namespace hiac {

/// The meaning of a volume's colour function; I is the radiance, t the distance from the eye.
enum class Glow : std::uint8_t {
  chromaticity,  ///< kappa: dI/dt = kappa tau - tau I (Williams and Max)
  emission       ///< g: dI/dt = g - tau I (Wilhelms and Van Gelder)
};

}  // namespace hiac

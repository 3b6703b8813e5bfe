#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "hiac/render/explain_pixel.hpp"

namespace hiac::tools {

/// A pixel's explanation as a table for a terminal. Every segment has a line for where the ray
/// enters its cell and one for where it leaves, with a line between them for each isosurface met;
/// numbers have six digits. The last line holds the pixel's R, G, B and A in full.
/// `scene`: what the pixel is of.
std::string pixel_table(const PixelExplanation& pixel, const Scene& scene);

/// The same for programs, every number in full. What is not finite is null, as is the error where
/// no bound is claimed.
nlohmann::ordered_json pixel_json(const PixelExplanation& pixel, const Scene& scene);

}  // namespace hiac::tools

#pragma once

#include <optional>

#include "hiac/image/image.hpp"

namespace hiac {

/// Pixels per degree of visual angle: a display 0.7 m wide of 3840 pixels, seen from 0.7 m (67.02).
inline constexpr double kFlipPixelsPerDegree = 67.020643276;

/// Returns how different two images look to a person who sees them alternate in the same place, per
/// pixel: one channel, "flip", from 0 (equal) to 1. Symmetric.
///
/// P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild, "FLIP: A
/// Difference Evaluator for Alternating Images", Proc. ACM on Computer Graphics and Interactive
/// Techniques 3 (2), 2020 (LDR-FLIP), with the paper's constants. R, G and B (or Y) are clamped to
/// [0, 1], as a display would show them; a frequent summary is the mean over the pixels.
///
/// Returns none if an image has no colour, or a colour that is not finite. Throws
/// std::invalid_argument if the images differ in size.
std::optional<Image> flip_map(const Image& image, const Image& reference,
                              double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace hiac

#pragma once

#include <optional>

#include "hiac/image/image.hpp"

namespace hiac {

/// Returns the mean structural similarity of two images: 1 for equal ones, less for others.
/// Symmetric.
///
/// Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment: From Error
/// Visibility to Structural Similarity", IEEE Transactions on Image Processing 13 (4), 2004,
/// section III: Gaussian windows of 11 x 11 pixels with sigma = 1.5 that lie inside the image,
/// K1 = 0.01, K2 = 0.03, at full resolution. The images are compared as displayed: R, G and B (or
/// Y) are clamped to [0, 1], sRGB-encoded, and combined into the luma 0.299 R + 0.587 G + 0.114 B
/// (ITU-R BT.601); L = 1.
///
/// Returns none if an image has no colour, a colour that is not finite, or a side of fewer than 11
/// pixels. Throws std::invalid_argument if the images differ in size.
std::optional<double> structural_similarity(const Image& image, const Image& reference);

}  // namespace hiac

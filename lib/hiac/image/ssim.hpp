#pragma once

#include <optional>

#include "hiac/image/image.hpp"

namespace hiac {

/// The mean structural similarity of two images: 1 for equal ones, less for others. Symmetric.
///
/// Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment: From Error
/// Visibility to Structural Similarity", IEEE Transactions on Image Processing 13 (4), 2004,
/// section III: Gaussian windows of 11 x 11 pixels with sigma = 1.5 that lie inside the image,
/// K1 = 0.01, K2 = 0.03, at full resolution. It is taken on the images as they are displayed: R, G
/// and B (or Y) are clamped to [0, 1], sRGB-encoded, and weighed to the luma 0.299 R + 0.587 G +
/// 0.114 B (ITU-R BT.601); L = 1.
///
/// No result when an image has no colour, a colour that is not finite, or fewer than 11 pixels a
/// side. Throws std::invalid_argument when the images are not of one size.
std::optional<double> structural_similarity(const Image& image, const Image& reference);

}  // namespace hiac

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "hiac/image/image.hpp"

namespace hiac {

/// How a picture lies on the plane, compared with its reference.
enum class Orientation : std::uint8_t {
  mirrored,        ///< left and right exchanged
  upside_down,     ///< top and bottom exchanged
  half_turned,     ///< both
  transposed,      ///< rows are columns; square pictures alone
  turned_left,     ///< by a quarter, counter-clockwise; square pictures alone
  turned_right,    ///< clockwise; square pictures alone
  antitransposed,  ///< transposed and half turned; square pictures alone
};
/// "mirrored left to right", "turned by a quarter, clockwise" ...
std::string_view name_of(Orientation orientation);

/// How a picture's values are stored, where that is not linear and premultiplied by alpha.
enum class Encoding : std::uint8_t {
  encoded_once_more,  ///< values are sRGB-encoded, though taken as linear
  decoded_once_more,  ///< linear values were decoded as if they were sRGB-encoded
  straight,           ///< colours are not multiplied by alpha
};
/// "sRGB-encoded values where linear ones are expected" ...
std::string_view name_of(Encoding encoding);

/// What explains a part of the difference of a picture from its reference, and the root mean square
/// of the differences that remain once that is undone.
struct OrientationFit {
  Orientation orientation;
  double rmse;
};
struct EncodingFit {
  Encoding encoding;
  double rmse;
};
/// The picture at c + scale (p - c) + shift shows what the reference has at p; c is the middle.
struct PlaceFit {
  std::array<double, 2> shift;  ///< pixels, to the right and down
  double scale;
  double rmse;         ///< of the luminance, in its place
  double rmse_before;  ///< of the luminance, where it is
};

/// What is wrong with a picture as a whole, before any pixel of it is.
struct Misfit {
  double rmse = 0;  ///< of R G B (or Y) as they are
  std::optional<OrientationFit> orientation;
  std::optional<EncodingFit> encoding;
  std::optional<PlaceFit> place;
};

/// Looks for a turn or a mirror image, for a wrong encoding, and for a shift and a scale of a
/// picture of the same scene as its reference. An orientation or an encoding is reported only if
/// undoing it leaves half of the difference at most; both together, half of what the better one
/// leaves. Shift and scale are looked for with these undone, and reported if they leave four fifths
/// of the difference at most, and move something by at least a fiftieth of a pixel.
///
/// Shift and scale are those of least squares of the luminance (B. Lucas, T. Kanade, An iterative
/// image registration technique, IJCAI 1981), from coarse pictures to fine ones: they are found up
/// to about a tenth of the picture's width. Values that are not finite count as 0.
///
/// Throws std::invalid_argument if the sizes differ. Without common colours nothing is found.
Misfit find_misfit(const Image& picture, const Image& reference);

}  // namespace hiac

// Based on: B. Lucas, T. Kanade, An iterative image registration technique with an application to
// stereo vision, IJCAI 1981; coarse to fine as in J. Bergen et al., Hierarchical model-based motion
// estimation, ECCV 1992.
#include "hiac/image/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "hiac/image/plane_filter.hpp"
#include "hiac/image/srgb.hpp"

namespace hiac {
namespace {

// An explanation is reported if undoing it leaves at most this share of the difference.
constexpr double kClearlyBetter = 0.5, kPlacedBetter = 0.8;
// Pixels: what a smaller displacement changes is not told from other differences.
constexpr double kLeastDisplacement = 0.02;
// Pixels along a side of the coarsest pictures, and steps at each size.
constexpr std::size_t kCoarsestSide = 12;
constexpr int kSteps = 12;

// R, G and B of the pixels, or Y three times, and alpha (1 without).
struct Colors {
  std::size_t width, height;
  std::vector<std::array<double, 3>> rgb;
  std::vector<double> alpha;
};

double finite(double value) { return std::isfinite(value) ? value : 0; }

std::optional<Colors> colors_of(const Image& image) {
  const auto channels = color_channels(image);
  if (!channels) return std::nullopt;
  const auto alpha = image.channel_index("A");
  Colors colors{image.width(), image.height(), {}, {}};
  for (std::size_t y = 0; y < image.height(); ++y) {
    for (std::size_t x = 0; x < image.width(); ++x) {
      const auto pixel = image.pixel(x, y);
      colors.rgb.push_back({finite(pixel[(*channels)[0]]), finite(pixel[(*channels)[1]]),
                            finite(pixel[(*channels)[2]])});
      colors.alpha.push_back(alpha ? finite(pixel[*alpha]) : 1);
    }
  }
  return colors;
}

double rmse(const Colors& a, const Colors& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.rgb.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      const double difference = a.rgb[k][c] - b.rgb[k][c];
      sum += difference * difference;
    }
  return a.rgb.empty() ? 0 : std::sqrt(sum / (3.0 * static_cast<double>(a.rgb.size())));
}

// Undoes an orientation: the picture as it would be without.
Colors undone(const Colors& picture, Orientation orientation) {
  Colors result = picture;
  const std::size_t width = picture.width, height = picture.height;
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t across = width - 1 - x, up = height - 1 - y;
      std::array<std::size_t, 2> from{x, y};
      switch (orientation) {
        case Orientation::mirrored:
          from = {across, y};
          break;
        case Orientation::upside_down:
          from = {x, up};
          break;
        case Orientation::half_turned:
          from = {across, up};
          break;
        case Orientation::transposed:
          from = {y, x};
          break;
        case Orientation::turned_left:
          from = {y, across};
          break;
        case Orientation::turned_right:
          from = {up, x};
          break;
        case Orientation::antitransposed:
          from = {up, across};
          break;
      }
      result.rgb[y * width + x] = picture.rgb[from[1] * width + from[0]];
      result.alpha[y * width + x] = picture.alpha[from[1] * width + from[0]];
    }
  }
  return result;
}

Colors undone(Colors picture, Encoding encoding) {
  for (std::size_t k = 0; k < picture.rgb.size(); ++k) {
    for (double& value : picture.rgb[k]) {
      const double clamped = std::clamp(value, 0.0, 1.0);
      switch (encoding) {
        case Encoding::encoded_once_more:
          value = srgb_decode(clamped);
          break;
        case Encoding::decoded_once_more:
          value = srgb_encode(clamped);
          break;
        case Encoding::straight:
          value *= picture.alpha[k];
          break;
      }
    }
  }
  return picture;
}

// An orientation and an encoding, or one of them, or none, and what is left once they are undone.
struct Candidate {
  std::optional<Orientation> orientation;
  std::optional<Encoding> encoding;
  double rmse;

  [[nodiscard]] int parts() const { return orientation.has_value() + encoding.has_value(); }
};

std::vector<Candidate> candidates_of(const Colors& picture, const Colors& reference) {
  using enum Orientation;
  std::vector<std::optional<Orientation>> orientations{std::nullopt, mirrored, upside_down,
                                                       half_turned};
  if (picture.width == picture.height)
    for (const Orientation turn : {transposed, turned_left, turned_right, antitransposed})
      orientations.emplace_back(turn);
  std::vector<Candidate> found;
  for (const auto& orientation : orientations) {
    const Colors upright = orientation ? undone(picture, *orientation) : picture;
    found.push_back({orientation, std::nullopt, rmse(upright, reference)});
    for (const Encoding encoding :
         {Encoding::encoded_once_more, Encoding::decoded_once_more, Encoding::straight})
      found.push_back({orientation, encoding, rmse(undone(upright, encoding), reference)});
  }
  return found;
}

// The candidate that leaves least, of those that leave clearly less than all with fewer parts.
Candidate best_of(const std::vector<Candidate>& candidates) {
  Candidate best = candidates.front();  // nothing undone
  for (const int parts : {1, 2}) {
    const double before = best.rmse;
    for (const Candidate& candidate : candidates)
      if (candidate.parts() == parts && candidate.rmse < before &&
          candidate.rmse <= kClearlyBetter * before && candidate.rmse < best.rmse)
        best = candidate;
  }
  return best;
}

Plane luminance(const Colors& colors) {
  Plane plane{colors.width, colors.height, {}};
  for (const auto& [r, g, b] : colors.rgb)
    plane.values.push_back(0.2126 * r + 0.7152 * g + 0.0722 * b);
  return plane;
}

// Half the width and height: means of four pixels of the smoothed plane, whose middles are those of
// the coarse pixels.
Plane halved(const Plane& plane) {
  const std::array<double, 3> smooth{0.25, 0.5, 0.25};
  const Plane soft = filtered(plane, smooth, smooth);
  Plane half{plane.width / 2, plane.height / 2, {}};
  for (std::size_t y = 0; y < half.height; ++y)
    for (std::size_t x = 0; x < half.width; ++x) {
      const std::size_t at = 2 * y * plane.width + 2 * x;
      half.values.push_back((soft.values[at] + soft.values[at + 1] + soft.values[at + plane.width] +
                             soft.values[at + plane.width + 1]) /
                            4);
    }
  return half;
}

// Catmull and Rom's weights of the four values around a place between the middle two.
std::array<double, 4> cubic_weights(double t) {
  return {((-0.5 * t + 1) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1,
          ((-1.5 * t + 2) * t + 0.5) * t, (0.5 * t - 0.5) * t * t};
}

// A plane's value between its pixels; none beyond the pixels' middles.
std::optional<double> value_at(const Plane& plane, double x, double y) {
  const auto last_x = static_cast<double>(plane.width - 1);
  const auto last_y = static_cast<double>(plane.height - 1);
  if (!(x >= 0 && y >= 0 && x <= last_x && y <= last_y)) return std::nullopt;
  const auto left = static_cast<std::ptrdiff_t>(x), top = static_cast<std::ptrdiff_t>(y);
  const auto across = cubic_weights(x - static_cast<double>(left));
  const auto down = cubic_weights(y - static_cast<double>(top));
  const auto inside = [](std::ptrdiff_t at, std::size_t side) {
    return static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(at, 0, static_cast<std::ptrdiff_t>(side) - 1));
  };
  double sum = 0;
  for (std::ptrdiff_t j = 0; j < 4; ++j) {
    const std::size_t row = inside(top + j - 1, plane.height) * plane.width;
    for (std::ptrdiff_t i = 0; i < 4; ++i)
      sum += down[static_cast<std::size_t>(j)] * across[static_cast<std::size_t>(i)] *
             plane.values[row + inside(left + i - 1, plane.width)];
  }
  return sum;
}

// Where the picture shows what the reference has at p: c + scale (p - c) + shift.
struct Place {
  double x = 0, y = 0, scale = 1;
};

// How far a picture at a place is from its reference, and the normal equations of a better place.
struct Comparison {
  double sum = 0;  // of squared differences
  std::size_t count = 0;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
};

// The picture at the place against the reference, with the normal equations of a better place.
Comparison compared(const Plane& picture, const Plane& reference, const Place& place) {
  Comparison result;
  const double middle_x = static_cast<double>(reference.width - 1) / 2;
  const double middle_y = static_cast<double>(reference.height - 1) / 2;
  const std::size_t width = reference.width;
  for (std::size_t y = 1; y + 1 < reference.height; ++y) {
    for (std::size_t x = 1; x + 1 < width; ++x) {
      const double from_x = static_cast<double>(x) - middle_x;
      const double from_y = static_cast<double>(y) - middle_y;
      const auto value = value_at(picture, middle_x + place.scale * from_x + place.x,
                                  middle_y + place.scale * from_y + place.y);
      if (!value) continue;
      const std::size_t at = y * width + x;
      const auto& values = reference.values;
      const double difference = *value - values[at];
      // slopes of the picture at its place are those of the reference, where the two agree
      const double slope_x = (values[at + 1] - values[at - 1]) / 2;
      const double slope_y = (values[at + width] - values[at - width]) / 2;
      const Eigen::Vector3d change(slope_x, slope_y, slope_x * from_x + slope_y * from_y);
      result.normal += change * change.transpose();
      result.right -= difference * change;
      result.sum += difference * difference;
      ++result.count;
    }
  }
  return result;
}

// The place of least squares, from a first one.
Place refined(const Plane& picture, const Plane& reference, Place place) {
  const double diagonal =
      std::hypot(static_cast<double>(picture.width), static_cast<double>(picture.height)) / 2;
  for (int step = 0; step < kSteps; ++step) {
    const Comparison now = compared(picture, reference, place);
    if (now.count < reference.values.size() / 4) break;
    const Eigen::LDLT<Eigen::Matrix3d> solver(now.normal);
    if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-12)) break;
    const Eigen::Vector3d change = solver.solve(now.right);
    if (!change.allFinite()) break;
    const Place next{place.x + change[0], place.y + change[1], place.scale + change[2]};
    const Comparison then = compared(picture, reference, next);
    if (then.count == 0 ||
        then.sum / static_cast<double>(then.count) >= now.sum / static_cast<double>(now.count))
      break;
    place = next;
    if (std::hypot(change[0], change[1]) + diagonal * std::abs(change[2]) < 1e-4) break;
  }
  return place;
}

Place place_of(const Plane& picture, const Plane& reference) {
  Place place;
  if (std::min(picture.width, picture.height) >= 2 * kCoarsestSide) {
    place = place_of(halved(picture), halved(reference));
    place = {2 * place.x, 2 * place.y, place.scale};
  }
  return refined(picture, reference, place);
}

double rmse_at(const Plane& picture, const Plane& reference, const Place& place) {
  const Comparison found = compared(picture, reference, place);
  return found.count == 0 ? 0 : std::sqrt(found.sum / static_cast<double>(found.count));
}

std::optional<PlaceFit> fit_place(const Colors& picture, const Colors& reference) {
  if (std::min(picture.width, picture.height) < kCoarsestSide) return std::nullopt;
  const Plane of_picture = luminance(picture), of_reference = luminance(reference);
  const double before = rmse_at(of_picture, of_reference, {});
  if (before == 0) return std::nullopt;
  const Place place = place_of(of_picture, of_reference);
  const double after = rmse_at(of_picture, of_reference, place);
  const double diagonal =
      std::hypot(static_cast<double>(picture.width), static_cast<double>(picture.height)) / 2;
  const double displacement = std::hypot(place.x, place.y) + diagonal * std::abs(place.scale - 1);
  if (displacement < kLeastDisplacement || after > kPlacedBetter * before) return std::nullopt;
  return PlaceFit{{place.x, place.y}, place.scale, after, before};
}

}  // namespace

std::string_view name_of(Orientation orientation) {
  switch (orientation) {
    case Orientation::mirrored:
      return "mirrored left to right";
    case Orientation::upside_down:
      return "upside down";
    case Orientation::half_turned:
      return "turned by half a turn";
    case Orientation::transposed:
      return "transposed";
    case Orientation::turned_left:
      return "turned by a quarter, counter-clockwise";
    case Orientation::turned_right:
      return "turned by a quarter, clockwise";
    case Orientation::antitransposed:
      return "transposed and turned by half a turn";
  }
  return {};
}

std::string_view name_of(Encoding encoding) {
  switch (encoding) {
    case Encoding::encoded_once_more:
      return "sRGB-encoded values where linear ones are expected";
    case Encoding::decoded_once_more:
      return "linear values where sRGB-encoded ones are expected";
    case Encoding::straight:
      return "colours that are not multiplied by alpha";
  }
  return {};
}

Misfit find_misfit(const Image& picture, const Image& reference) {
  if (picture.width() != reference.width() || picture.height() != reference.height())
    throw std::invalid_argument("find_misfit: images of different sizes");
  std::optional<Colors> colors = colors_of(picture);
  const std::optional<Colors> expected = colors_of(reference);
  if (!colors || !expected) return {};
  Misfit misfit{rmse(*colors, *expected), {}, {}, {}};
  if (misfit.rmse == 0) return misfit;
  const Candidate best = best_of(candidates_of(*colors, *expected));
  if (best.orientation) {
    *colors = undone(*colors, *best.orientation);
    misfit.orientation = OrientationFit{*best.orientation, rmse(*colors, *expected)};
  }
  if (best.encoding) {
    *colors = undone(std::move(*colors), *best.encoding);
    misfit.encoding = EncodingFit{*best.encoding, best.rmse};
  }
  misfit.place = fit_place(*colors, *expected);
  return misfit;
}

}  // namespace hiac

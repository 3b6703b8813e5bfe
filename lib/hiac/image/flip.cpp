#include "hiac/image/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "hiac/image/plane_filter.hpp"

namespace hiac {
namespace {

using Triple = std::array<double, 3>;
/// The three components of an image in some colour space.
using Planes = std::array<Plane, 3>;

// Colour spaces. The matrices and the white point (D65) are those of the authors' code. ----------

constexpr Triple kWhite{0.950428545, 1.000000000, 1.088900371};

Triple rgb_to_xyz(const Triple& rgb) {
  return {(10135552 * rgb[0] + 8788810 * rgb[1] + 4435075 * rgb[2]) / 24577794,
          (2613072 * rgb[0] + 8788810 * rgb[1] + 887015 * rgb[2]) / 12288897,
          (1425312 * rgb[0] + 8788810 * rgb[1] + 70074185 * rgb[2]) / 73733382};
}
Triple xyz_to_rgb(const Triple& xyz) {
  return {3.241003275 * xyz[0] - 1.537398934 * xyz[1] - 0.498615861 * xyz[2],
          -0.969224334 * xyz[0] + 1.875930071 * xyz[1] + 0.041554224 * xyz[2],
          0.055639423 * xyz[0] - 0.204011202 * xyz[1] + 1.057148933 * xyz[2]};
}

/// Converts to the opponent space that is linear in light: achromatic, red-green, blue-yellow.
Triple xyz_to_ycxcz(const Triple& xyz) {
  const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
Triple ycxcz_to_xyz(const Triple& color) {
  const double y = (color[0] + 16) / 116;
  return {kWhite[0] * (y + color[1] / 500), kWhite[1] * y, kWhite[2] * (y - color[2] / 200)};
}

/// Converts to CIELAB with chroma reduced by the Hunt effect according to lightness (the
/// perceptually uniform colour space of section 4).
Triple hunt_adjusted_lab(const Triple& rgb) {
  constexpr double kDelta = 6.0 / 29.0;
  const auto f = [](double t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
  };
  const Triple xyz = rgb_to_xyz(rgb);
  const double x = f(xyz[0] / kWhite[0]), y = f(xyz[1] / kWhite[1]), z = f(xyz[2] / kWhite[2]);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

/// Returns the HyAB distance: city-block in lightness, Euclidean in chroma.
double hyab(const Triple& a, const Triple& b) {
  return std::fabs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// Planes -----------------------------------------------------------------------------------------

Triple at(const Planes& planes, std::size_t i) {
  return {planes[0].values[i], planes[1].values[i], planes[2].values[i]};
}

template <typename Convert>
void convert(Planes& planes, const Convert& convert_color) {
  for (std::size_t i = 0; i < planes[0].values.size(); ++i) {
    const Triple color = convert_color(at(planes, i));
    for (std::size_t c = 0; c < 3; ++c) planes[c].values[i] = color[c];
  }
}

/// Returns the colours that a display shows; none if the image has no colour or one that is not
/// finite.
std::optional<Planes> displayed(const Image& image) {
  const auto channels = color_channels(image);
  if (!channels) return std::nullopt;
  Planes planes;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = {image.width(), image.height(), {}};
    planes[c].values.reserve(image.width() * image.height());
    for (std::size_t i = (*channels)[c]; i < image.values().size(); i += image.channel_count()) {
      if (!std::isfinite(image.values()[i])) return std::nullopt;
      planes[c].values.push_back(std::clamp(image.values()[i], 0.0, 1.0));
    }
  }
  return planes;
}

// The colour pipeline: filtering in space, distance, redistribution -------------------------------

/// A contrast sensitivity function in space: the sum of a sqrt(pi / b) exp(-pi^2 d^2 / b) over its
/// terms, where d is the distance in degrees.
struct SensitivityTerm {
  double a, b;
};
constexpr double kWidestB = 0.04;
const std::array<std::vector<SensitivityTerm>, 3> kSensitivity{
    {{{1, 0.0047}}, {{1, 0.0053}}, {{34.1, kWidestB}, {13.5, 0.025}}}};

Plane sensed(const Plane& plane, const std::vector<SensitivityTerm>& terms, double ppd) {
  const double pi = std::numbers::pi;
  const auto radius =
      static_cast<std::size_t>(std::ceil(3 * std::sqrt(kWidestB / (2 * pi * pi)) * ppd));
  std::vector<std::vector<double>> kernels;
  double total = 0;
  for (const auto& [a, b] : terms) {
    std::vector<double>& kernel =
        kernels.emplace_back(gaussian(radius, std::sqrt(b / (2 * pi * pi)) * ppd));
    // the term's weight, divided between the two directions
    for (double& weight : kernel) weight *= std::sqrt(a * std::sqrt(pi / b));
    total += std::pow(std::accumulate(kernel.begin(), kernel.end(), 0.0), 2);
  }
  Plane sum{plane.width, plane.height, std::vector<double>(plane.values.size())};
  for (const auto& kernel : kernels) {
    const Plane part = filtered(plane, kernel, kernel);
    for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += part.values[i] / total;
  }
  return sum;
}

/// Converts YCxCz to the colours that the eye perceives, in Hunt-adjusted CIELAB.
Planes perceived(const Planes& opponent, double ppd) {
  Planes planes;
  for (std::size_t c = 0; c < 3; ++c) planes[c] = sensed(opponent[c], kSensitivity[c], ppd);
  convert(planes, [](const Triple& color) {
    Triple rgb = xyz_to_rgb(ycxcz_to_xyz(color));
    for (double& component : rgb) component = std::clamp(component, 0.0, 1.0);
    return hunt_adjusted_lab(rgb);
  });
  return planes;
}

/// Returns the HyAB distance, redistributed to [0, 1].
double color_error(const Triple& a, const Triple& b) {
  constexpr double kQc = 0.7, kPc = 0.4, kPt = 0.95;
  static const double largest =
      std::pow(hyab(hunt_adjusted_lab({0, 1, 0}), hunt_adjusted_lab({0, 0, 1})), kQc);
  const double error = std::pow(hyab(a, b), kQc);
  const double knee = kPc * largest;
  return error < knee ? kPt / knee * error : kPt + (error - knee) / (largest - knee) * (1 - kPt);
}

// The feature pipeline: edges and points ----------------------------------------------------------

/// Scales the positive values to a sum of 1 and the negative ones to a sum of -1.
void balance(std::vector<double>& kernel) {
  double positive = 0, negative = 0;
  for (const double weight : kernel) (weight > 0 ? positive : negative) += std::fabs(weight);
  for (double& weight : kernel) weight /= weight > 0 ? positive : negative > 0 ? negative : 1;
}

/// The magnitudes of the first derivatives (edges) and of the second ones (points).
struct Features {
  std::vector<double> edges, points;
};

Features find_features(const Plane& achromatic, double ppd) {
  constexpr double kWidth = 0.082;  // of the edge detector, degrees
  const double sigma = 0.5 * kWidth * ppd;
  const auto radius = static_cast<std::size_t>(std::ceil(3 * sigma));
  std::vector<double> smooth = gaussian(radius, sigma), edge = smooth, point = smooth;
  for (std::size_t i = 0; i < smooth.size(); ++i) {
    const double x = static_cast<double>(i) - static_cast<double>(radius);
    edge[i] *= -x;
    point[i] *= x * x / (sigma * sigma) - 1;
  }
  balance(smooth);
  balance(edge);
  balance(point);
  const auto lengths = [&](const std::vector<double>& derivative) {
    const Plane x = filtered(achromatic, derivative, smooth);
    const Plane y = filtered(achromatic, smooth, derivative);
    std::vector<double> values(x.values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = std::hypot(x.values[i], y.values[i]);
    return values;
  };
  return {lengths(edge), lengths(point)};
}

Plane normalized_luminance(const Plane& y) {
  Plane plane = y;
  for (double& value : plane.values) value = (value + 16) / 116;
  return plane;
}

}  // namespace

std::optional<Image> flip_map(const Image& image, const Image& reference,
                              double pixels_per_degree) {
  if (image.width() != reference.width() || image.height() != reference.height())
    throw std::invalid_argument("images of different sizes");
  std::optional<Planes> a = displayed(image), b = displayed(reference);
  if (!a || !b) return std::nullopt;
  for (Planes* planes : {&*a, &*b})
    convert(*planes, [](const Triple& rgb) { return xyz_to_ycxcz(rgb_to_xyz(rgb)); });
  const Planes seen_a = perceived(*a, pixels_per_degree), seen_b = perceived(*b, pixels_per_degree);
  const Features features_a = find_features(normalized_luminance((*a)[0]), pixels_per_degree);
  const Features features_b = find_features(normalized_luminance((*b)[0]), pixels_per_degree);

  constexpr double kQf = 0.5;
  Image map(image.width(), image.height(), {"flip"});
  for (std::size_t i = 0; i < map.values().size(); ++i) {
    const double feature_difference =
        std::max(std::fabs(features_a.edges[i] - features_b.edges[i]),
                 std::fabs(features_a.points[i] - features_b.points[i]));
    const double feature_error = std::pow(feature_difference / std::numbers::sqrt2, kQf);
    // the final error: differing features amplify a difference in colour
    map.values()[i] = std::pow(color_error(at(seen_a, i), at(seen_b, i)), 1 - feature_error);
  }
  return map;
}

}  // namespace hiac

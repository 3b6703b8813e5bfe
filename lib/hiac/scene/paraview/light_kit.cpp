// The light kit of VTK (M. Halle and J. Meng, "LightKit: A lighting system for effective
// visualization", IEEE Visualization 2003), as vtkLightKit of VTK 9.1 computes it.
#include "hiac/scene/paraview/light_kit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "hiac/scene/scene.hpp"
#include "hiac/scene/toml/spec_key.hpp"

namespace hiac::paraview {
namespace {

using Rgb = std::array<double, 3>;

/// The colours of warmths from 0 (cold) to 1 (warm), even in the warmth, and linear between.
constexpr std::array<Rgb, 64> kWarmth{{
    {{0.1674, 0.3065, 1}}, {{0.1798, 0.3204, 1}}, {{0.1935, 0.3352, 1}}, {{0.2083, 0.3511, 1}},
    {{0.2245, 0.3679, 1}}, {{0.2422, 0.3859, 1}}, {{0.2614, 0.405, 1}},  {{0.2822, 0.4252, 1}},
    {{0.3049, 0.4467, 1}}, {{0.3293, 0.4695, 1}}, {{0.3557, 0.4935, 1}}, {{0.3841, 0.5188, 1}},
    {{0.4144, 0.5454, 1}}, {{0.4468, 0.5731, 1}}, {{0.4811, 0.602, 1}},  {{0.5173, 0.632, 1}},
    {{0.5551, 0.6628, 1}}, {{0.5943, 0.6942, 1}}, {{0.6346, 0.7261, 1}}, {{0.6756, 0.7581, 1}},
    {{0.7168, 0.7898, 1}}, {{0.7575, 0.8209, 1}}, {{0.7972, 0.8508, 1}}, {{0.8351, 0.8791, 1}},
    {{0.8705, 0.9054, 1}}, {{0.9026, 0.929, 1}},  {{0.9308, 0.9497, 1}}, {{0.9546, 0.9671, 1}},
    {{0.9734, 0.9808, 1}}, {{0.9872, 0.9907, 1}}, {{0.9958, 0.997, 1}},  {{0.9996, 0.9997, 1}},
    {{1, 0.9999, 0.9996}}, {{1, 0.9988, 0.9958}}, {{1, 0.9964, 0.9871}}, {{1, 0.9925, 0.973}},
    {{1, 0.9869, 0.9532}}, {{1, 0.9796, 0.9275}}, {{1, 0.9705, 0.8959}}, {{1, 0.9595, 0.8584}},
    {{1, 0.9466, 0.815}},  {{1, 0.9317, 0.766}},  {{1, 0.9147, 0.7116}}, {{1, 0.8956, 0.6522}},
    {{1, 0.8742, 0.5881}}, {{1, 0.8506, 0.5199}}, {{1, 0.8247, 0.4483}}, {{1, 0.7964, 0.3739}},
    {{1, 0.7656, 0.2975}}, {{1, 0.7324, 0.2201}}, {{1, 0.6965, 0.1426}}, {{1, 0.658, 0.0662}},
    {{1, 0.6179, 0}},      {{1, 0.5832, 0}},      {{1, 0.5453, 0}},      {{1, 0.5042, 0}},
    {{1, 0.4595, 0}},      {{1, 0.4111, 0}},      {{1, 0.3588, 0}},      {{1, 0.3025, 0}},
    {{1, 0.2423, 0}},      {{1, 0.1782, 0}},      {{1, 0.1104, 0}},      {{1, 0.0396, 0}},
}};

Rgb color_of(double warmth) {
  const double at = warmth * (kWarmth.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kWarmth.size() - 2);
  const double share = at - static_cast<double>(below);
  Rgb color{};
  for (std::size_t c = 0; c < color.size(); ++c)
    color[c] = (1 - share) * kWarmth[below][c] + share * kWarmth[below + 1][c];
  return color;
}

/// By what intensities are divided where colours are to be as bright as white: the root of the
/// luminance, as VTK has it.
double brightness(const Rgb& color) {
  return std::sqrt(0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2]);
}

/// The names of a light's properties, and ParaView's values of these where a state lacks them.
struct Member {
  const char *warmth, *ratio, *elevation, *azimuth;
  double usual_warmth, usual_ratio, usual_elevation, usual_azimuth;
};
constexpr Member kKey{
    "KeyLightWarmth", nullptr, "KeyLightElevation", "KeyLightAzimuth", 0.6, 1, 50, 10};
constexpr Member kFill{"FillLightWarmth",
                       "FillLightK:F Ratio",
                       "FillLightElevation",
                       "FillLightAzimuth",
                       0.4,
                       3,
                       -75,
                       -10};
constexpr Member kBack{"BackLightWarmth",
                       "BackLightK:B Ratio",
                       "BackLightElevation",
                       "BackLightAzimuth",
                       0.5,
                       3.5,
                       0,
                       110};
constexpr Member kHead{"HeadLightWarmth", "HeadLightK:H Ratio", nullptr, nullptr, 0.5, 3, 0, 0};

/// Where the camera's right, its up, and the way back to its eye are in the world.
Eigen::Matrix3d camera_axes(const Proxy& view) {
  const auto vector = [&](const char* property) {
    return Eigen::Vector3d(view.numbers<3>(property).data());
  };
  const Eigen::Vector3d back = (vector("CameraPosition") - vector("CameraFocalPoint")).normalized();
  const Eigen::Vector3d right = vector("CameraViewUp").cross(back).normalized();
  Eigen::Matrix3d axes;
  axes << right, back.cross(right), back;
  return axes;
}

class LightKit {
 public:
  explicit LightKit(const Proxy& view)
      : view_(view),
        axes_(camera_axes(view)),
        intensity_(at_least_zero("KeyLightIntensity", 0.75)),
        maintains_(view.flag("MaintainLuminance")) {}

  /// A light of the kit; a mirrored one is to the left where its angle says right.
  [[nodiscard]] std::string light(const Member& member, bool is_mirrored = false) const {
    const double elevation = angle(member.elevation, member.usual_elevation);
    const double azimuth = angle(member.azimuth, member.usual_azimuth) * (is_mirrored ? -1 : 1);
    const Eigen::Vector3d direction =
        axes_ * Eigen::Vector3d(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                std::cos(elevation) * std::cos(azimuth));
    Rgb color = color_of(warmth(member));
    const double strength = intensity_ / ratio(member) / (maintains_ ? brightness(color) : 1);
    for (double& channel : color) channel *= strength;
    return fmt::format("[[light]]\ndirection = {}\ncolor = {}\n",
                       toml_text(std::array{direction[0], direction[1], direction[2]}),
                       toml_text(color));
  }

 private:
  [[nodiscard]] double angle(const char* property, double usual) const {
    const double degrees = property == nullptr ? usual : view_.number(property, usual);
    return degrees * std::numbers::pi / 180;
  }
  [[nodiscard]] double warmth(const Member& member) const {
    const double found = view_.number(member.warmth, member.usual_warmth);
    if (!(found >= 0 && found <= 1))
      view_.fail(member.warmth, fmt::format("expected 0 to 1, found {}", found));
    return found;
  }
  [[nodiscard]] double ratio(const Member& member) const {
    if (member.ratio == nullptr) return 1;
    const double found = view_.number(member.ratio, member.usual_ratio);
    if (!(found > 0))
      view_.fail(member.ratio, fmt::format("expected more than 0, found {}", found));
    return found;
  }
  [[nodiscard]] double at_least_zero(const char* property, double usual) const {
    const double found = view_.number(property, usual);
    if (!(found >= 0 && found <= kLargestColor))
      view_.fail(property, fmt::format("expected 0 to {:g}, found {}", kLargestColor, found));
    return found;
  }

  const Proxy& view_;
  Eigen::Matrix3d axes_;
  double intensity_;
  bool maintains_;
};

}  // namespace

std::string light_kit_text(const Proxy& view) {
  if (!view.flag("UseLight")) return "";
  const LightKit kit(view);
  return kit.light(kKey) + kit.light(kFill) + kit.light(kBack) + kit.light(kBack, true) +
         kit.light(kHead);
}

}  // namespace hiac::paraview

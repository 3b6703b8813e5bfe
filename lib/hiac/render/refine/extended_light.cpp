#include "hiac/render/refine/extended_light.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hiac/geometry/extended_vector.hpp"
#include "hiac/optics/extended_piece.hpp"

namespace hiac {
namespace {

using Real = long double;
using Vec = ExtendedVector;

Vec extended(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

// Appends the positions at which a scalar passes breakpoints inside its part of the ray.
template <std::size_t N>
void add_cuts(const TransferTable<N>& table, const ExtendedEnds& scalar, std::vector<Real>& cuts) {
  const auto [least, most] = std::minmax(scalar.front, scalar.back);
  for (std::size_t k = 1; k < table.intervals(); ++k)
    if (least < table.lower[k] && table.lower[k] < most)
      cuts.push_back((table.lower[k] - scalar.front) / (scalar.back - scalar.front));
}

// The interval that contains a scalar; a breakpoint belongs to the interval above it.
template <std::size_t N>
std::size_t interval_of(const TransferTable<N>& table, Real scalar) {
  return static_cast<std::size_t>(
             std::upper_bound(table.lower.begin() + 1, table.lower.end(), scalar) -
             table.lower.begin()) -
         1;
}

template <std::size_t N>
Real value_at(const TransferTable<N>& table, std::size_t channel, std::size_t k, Real scalar) {
  return table.value[channel][k] + table.slope[channel][k] * (scalar - table.anchor[k]);
}

}  // namespace

void ExtendedLight::add_behind(const ExtendedLight& other) {
  for (std::size_t c = 0; c < 3; ++c) rgb[c] += transparency * other.rgb[c];
  seen += transparency * other.seen;
  transparency *= other.transparency;
}

ExtendedLight extended_volume(const OpticsTables& optics, Real length, const ExtendedEnds& color,
                              const ExtendedEnds& extinction) {
  std::vector<Real> cuts{0, 1};
  add_cuts(optics.extinction, extinction, cuts);
  if (!optics.same_field) add_cuts(optics.color, color, cuts);
  std::ranges::sort(cuts);
  ExtendedLight sum;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Real u0 = cuts[i], u1 = cuts[i + 1], middle = (u0 + u1) / 2;
    if (!(u0 < u1)) continue;
    const Real part = (u1 - u0) * length;
    const std::size_t k = interval_of(optics.extinction, extinction.at(middle));
    const std::size_t n = interval_of(optics.color, color.at(middle));
    const auto depth = [&](Real u) {
      return part * std::max<Real>(0, value_at(optics.extinction, 0, k, extinction.at(u)));
    };
    const Real b = depth(u0), a = depth(u1);
    const ExtendedPieceWeights w =
        optics.emission ? extended_piece_emission(b, a) : extended_piece_weights(b, a);
    const Real unit = optics.emission ? part : 1;
    // Psi, and a bound of the difference's rounding
    const Real psi = optics.emission ? w.front + w.back : 1 - w.front + 0x1p-60L;
    ExtendedLight piece{{}, w.transparency, psi * part};
    for (std::size_t c = 0; c < 3; ++c)
      piece.rgb[c] = unit * (w.front * value_at(optics.color, c, n, color.at(u0)) +
                             w.back * value_at(optics.color, c, n, color.at(u1)));
    sum.add_behind(piece);
  }
  return sum;
}

ExtendedLight extended_surface(const FrameIsosurface& surface, std::span<const FrameLight> lights,
                               const Vec& normal, const Vec& ray) {
  const Real away = dot(normal, ray), facing = std::abs(away);  // N.V
  const Real side = away > 0 ? -1 : 1;
  ExtendedLight light;
  for (std::size_t c = 0; c < 3; ++c) light.rgb[c] = surface.ambient * surface.color[c];
  for (const FrameLight& l : lights) {
    const Real to_light = l.headlight ? facing : side * dot(normal, extended(l.direction));
    const Real towards_eye = l.headlight ? 1 : -dot(ray, extended(l.direction));
    if (!(to_light > 0)) continue;
    const Real cosine = 2 * to_light * facing - towards_eye;  // R.V
    const Real specular = cosine > 0 ? surface.specular * std::pow<Real>(cosine, surface.shininess)
                                     : static_cast<Real>(0);
    for (std::size_t c = 0; c < 3; ++c)
      light.rgb[c] += l.color[c] * (surface.diffuse * to_light * surface.color[c] + specular);
  }
  light.transparency = std::exp(surface.log_transparency / std::max<Real>(facing, 1e-300L));
  for (Real& channel : light.rgb) channel *= 1 - light.transparency;
  return light;
}

}  // namespace hiac

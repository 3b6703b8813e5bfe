#pragma once

#include <array>

#include "hiac/scene/scene.hpp"
#include "tests/render/truth/chebyshev_series.hpp"

namespace hiac::test {

/// The light that a volume sends along pieces of a ray on which fields are polynomials and transfer
/// functions are linear in them, in extended precision: the optical depth is a polynomial then, and
/// the radiance is summed up by Gauss-Legendre rules that are exact to 1e-19.
class VolumeTruth {
 public:
  using Real = long double;

  /// Light gathered from the eye on, and the transparency of what lies before.
  struct Light {
    std::array<Real, 3> rgb{};
    Real transparency = 1;
  };
  /// Nothing behind less transparency than this is seen.
  static constexpr Real kOpaque = 1e-24L;

  /// The scalars of a stretch of a ray, over [-1, 1]; null where the volume has no such function.
  struct PieceFields {
    const ChebyshevSeries* color = nullptr;
    const ChebyshevSeries* extinction = nullptr;
  };

  /// The volume must outlive it.
  explicit VolumeTruth(const Volume& volume);

  [[nodiscard]] const PiecewiseLinear<3>& color() const { return color_; }
  [[nodiscard]] const PiecewiseLinear<1>& extinction() const { return extinction_; }

  /// Adds the light of the piece [from, to] of a stretch, of that length in the world.
  void add_piece(const PieceFields& fields, Real from, Real to, Real length, Light& light) const;
  /// The same where the fields are linear.
  void add_linear_piece(const PieceFields& fields, Real from, Real to, Real length,
                        Light& light) const;

 private:
  const Volume& volume_;
  PiecewiseLinear<3> color_;
  PiecewiseLinear<1> extinction_;
};

}  // namespace hiac::test

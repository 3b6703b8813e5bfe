#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hiac/base/transfer_function.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/optics/piece_rule.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// A piecewise-linear function laid out for vector gathers: on interval k, between lower[k] and
/// upper[k], channel c is value[c][k] + slope[c][k] (s - anchor[k]).
template <std::size_t N>
struct TransferTable {
  std::vector<double> lower, upper, anchor;
  std::array<std::vector<double>, N> value, slope;

  [[nodiscard]] std::size_t intervals() const { return anchor.size(); }
};

/// The volume's optics by scalar: colour (chromaticity or emission) and extinction. When both
/// depend on the same field their intervals are the same, cut at the breakpoints of either.
struct OpticsTables {
  /// The functions themselves, with only their own breakpoints.
  PiecewiseLinear<3> color_function;
  PiecewiseLinear<1> extinction_function;
  TransferTable<3> color;
  TransferTable<1> extinction;
  bool same_field = true;
  bool emission = false;
  PieceRule rule = PieceRule::exact;
  bool unsliced = false;  ///< segments are not cut at breakpoints (only with mean_color)
  /// Functions are so steep (is_steep) that rounding of a field may change the optical depth of a
  /// ray by more than 1, or colours by more than their size.
  bool steep = false;
  /// The largest colour component of the colour function.
  double largest_color = 0;
  /// For every interval of its table: whether the function is zero on all of it.
  std::vector<std::uint8_t> no_color, no_extinction;
};

/// The tables of a volume. Extinction is limited to `most_extinction`: the function gets a
/// breakpoint where it rises above that.
OpticsTables make_optics_tables(const Volume& volume, Integration integration,
                                double most_extinction = std::numeric_limits<double>::infinity());

/// Whether functions are steep (OpticsTables::steep). `largest_color_field`,
/// `largest_extinction_field`: the fields' largest magnitudes; `longest`: the length of the longest
/// ray in the mesh, world units.
bool is_steep(const OpticsTables& optics, double largest_color_field,
              double largest_extinction_field, double longest);

/// For one scalar, the number of breakpoints below it, and the number of breakpoints not above it.
/// If they are equal, the scalar is inside an interval, and both are that interval's number.
struct ScalarIntervals {
  std::uint16_t low, high;
};

/// The intervals of one value.
template <std::size_t N>
ScalarIntervals classify_value(double value, const TransferTable<N>& table);

/// The intervals of every value of a scalar field. `table` has at most 65535 breakpoints.
template <std::size_t N>
std::vector<ScalarIntervals> classify_values(std::span<const double> values,
                                             const TransferTable<N>& table);

}  // namespace hiac

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hiac {

/// A face of a cell as a parametric surface of degree 1, 2 or 3 along its edges, over the triangle
/// 0 <= u, v; u + v <= 1 or over the unit square.
///
/// Nodes: corner 0 is at (0, 0). A triangle's corners 1 and 2 are at (1, 0) and (0, 1); a
/// quadrilateral's corners 1, 2 and 3 are at (1, 0), (1, 1) and (0, 1). After the corners come
/// degree - 1 nodes on every edge, where edge k runs from corner k to the next one, then the centre
/// node if there is one. The surface is the trace of the shape functions (shape_functions.hpp): P1,
/// P2, P3 on triangles, bilinear or serendipity functions on quadrilaterals. A cubic triangle
/// without a centre node has its centre at a quarter of the sum of its edge nodes minus a sixth of
/// the sum of its corners.
struct PatchShape {
  std::uint8_t degree = 1;
  bool triangle = false;
  bool centre = false;  ///< true if there is a centre node: only in triangles of degree 3

  [[nodiscard]] std::size_t corner_count() const { return triangle ? 3 : 4; }
  [[nodiscard]] std::size_t node_count() const {
    return corner_count() * degree + (centre ? 1 : 0);
  }
  /// Number of control points of the tensor product net.
  [[nodiscard]] std::size_t control_count() const {
    return (std::size_t{degree} + 1) * (std::size_t{degree} + 1);
  }
};

inline constexpr std::size_t kMostPatchNodes = 12, kMostPatchControls = 16;

/// Weights of a patch's nodes in its control points, weights[control][node]. The control points are
/// those of the tensor product Bernstein form over the unit square, for triangles too, which are
/// one half of it; control i + (degree + 1) j belongs to B_i(u) B_j(v).
using PatchWeights = std::array<std::array<double, kMostPatchNodes>, kMostPatchControls>;
const PatchWeights& patch_weights(const PatchShape& shape);

/// A net of control points, or of one coordinate of them, as Value says.
template <typename Value>
using PatchNet = std::array<Value, kMostPatchControls>;

/// Computes one coordinate of the control points from the same coordinate of the nodes.
inline void patch_net(const PatchShape& shape, std::span<const double> nodes,
                      PatchNet<double>& net) {
  const PatchWeights& weights = patch_weights(shape);
  for (std::size_t k = 0; k < shape.control_count(); ++k) {
    net[k] = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) net[k] += weights[k][i] * nodes[i];
  }
}

/// The Bernstein polynomials of degree 1, 2 or 3 and their derivatives at u.
struct BernsteinValues {
  std::array<double, 4> value, derivative;

  BernsteinValues(std::size_t degree, double u) {
    const double w = 1 - u;
    if (degree == 1) {
      value = {w, u};
      derivative = {-1, 1};
    } else if (degree == 2) {
      value = {w * w, 2 * u * w, u * u};
      derivative = {-2 * w, 2 * (w - u), 2 * u};
    } else {
      value = {w * w * w, 3 * u * w * w, 3 * u * u * w, u * u * u};
      derivative = {-3 * w * w, 3 * w * (w - 2 * u), 3 * u * (2 * w - u), 3 * u * u};
    }
  }
};

/// The value of one coordinate at (u, v), with its derivatives.
struct PatchValue {
  double value, by_u, by_v;
};
inline PatchValue evaluate_patch(std::size_t degree, const PatchNet<double>& net,
                                 const BernsteinValues& u, const BernsteinValues& v) {
  PatchValue sum{0, 0, 0};
  for (std::size_t j = 0; j <= degree; ++j) {
    const double* row = net.data() + j * (degree + 1);
    double value = 0, by_u = 0;
    for (std::size_t i = 0; i <= degree; ++i) {
      value += u.value[i] * row[i];
      by_u += u.derivative[i] * row[i];
    }
    sum.value += v.value[j] * value;
    sum.by_u += v.value[j] * by_u;
    sum.by_v += v.derivative[j] * value;
  }
  return sum;
}

}  // namespace hiac

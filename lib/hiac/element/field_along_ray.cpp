#include "hiac/element/field_along_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/base/rounding.hpp"
#include "hiac/element/chebyshev_points.hpp"
#include "hiac/element/ray_rounding.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

// Numbers of intervals between Chebyshev points; the points of each include those of the previous
// one.
constexpr std::array<std::size_t, 3> kAdaptiveDegrees{4, 8, 16};
constexpr std::size_t kMostDegree = kAdaptiveDegrees.back();
static_assert(kMostDegree <= kMaxFieldDegree && kMostDegree <= kMostChebyshevDegree);

// A stretch that comes within e of a pyramid's apex needs about log2(1 / e) halvings.
constexpr int kMostBisections = 40;
constexpr std::size_t kMostPieces = 96;

double largest_component(const std::array<double, 3>& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

// The polynomial with these Chebyshev coefficients, without those at the end that are negligible.
BernsteinPolynomial without_tail(const double* c, std::size_t degree, double negligible) {
  double dropped = 0;
  while (degree > 0 && dropped + std::abs(c[degree]) <= negligible)
    dropped += std::abs(c[degree--]);
  return bernstein_from_chebyshev({c, degree + 1});
}

// The highest degree of fields that are polynomials in the world; 0 if none is.
std::size_t degree_in_world(std::span<const CellField> fields) {
  std::size_t degree = 0;
  for (const CellField& field : fields)
    if (field.polynomial) degree = std::max(degree, field.polynomial->degree());
  return degree;
}

}  // namespace

std::size_t degree_along_lines(CellKind kind) {
  const auto order = static_cast<std::size_t>(order_of(kind));
  switch (shape_of(kind)) {
    case CellShape::tetrahedron:
      return order;
    case CellShape::prism:
      return order + 1;
    case CellShape::brick:
      return order + 2;
    case CellShape::pyramid:
    case CellShape::wedge:
      break;
  }
  return 0;
}

// Fields and reference points at the Chebyshev points of kMostDegree on one part of a stretch.
struct FieldAlongRay::Samples {
  std::array<std::array<double, kMostDegree + 1>, kMostFields> values;
  std::array<CellMap::Point, kMostDegree + 1> xi;
  std::size_t stride = 0;  // of the known points; 0: none
};

FieldAlongRay::FieldAlongRay(CellKind kind, const CellMap& map, std::span<const CellField> fields)
    : kind_(kind),
      map_(map),
      fields_(fields),
      in_world_(degree_in_world(fields) > 0),
      exact_degree_(in_world_      ? degree_in_world(fields)
                    : map.affine() ? degree_along_lines(kind)
                                   : 0) {}

double FieldAlongRay::rounding(const RayStretch& stretch, const CellField& field) const {
  const double point = largest_component(stretch.origin) +
                       std::max(std::abs(stretch.front), std::abs(stretch.back)) *
                           largest_component(stretch.direction);
  return kUnit * (kRayValueRounding * std::max(std::abs(field.least), std::abs(field.most)) +
                  kRayPointRounding * point * map_.steepness() * (field.most - field.least));
}

void FieldAlongRay::evaluate(const CellMap::Point& xi,
                             std::span<double, kMostFields> values) const {
  std::array<double, kMaxNodesPerCell> shape;
  shape_functions<double>(kind_, xi, shape);
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    const CellField& field = fields_[f];
    double value = 0;
    for (std::size_t k = 0; k < node_count(kind_); ++k) value += shape[k] * field.values[k];
    // inside the cell the interpolant stays in its range; if the map has no inverse (cell of volume
    // 0, stretch of length 0), nothing more is known
    values[f] = std::min(std::max(field.least, value), field.most);
  }
}

void FieldAlongRay::evaluate_in_world(const CellMap::Point& point,
                                      std::span<double, kMostFields> values) const {
  const CellMap::Point origin = map_.position(reference_nodes(kind_)[0]);
  const CellMap::Point from_origin{point[0] - origin[0], point[1] - origin[1],
                                   point[2] - origin[2]};
  for (std::size_t f = 0; f < fields_.size(); ++f)
    values[f] = fields_[f].polynomial ? fields_[f].polynomial->at(from_origin) : fields_[f].least;
}

// Adds the points of a smaller stride to the samples.
void FieldAlongRay::sample(const RayStretch& stretch, double begin, double end, std::size_t stride,
                           Samples& samples) const {
  const ChebyshevPoints& points = chebyshev_points(kMostDegree);
  for (std::size_t j = 0; j <= kMostDegree; j += stride) {
    if (samples.stride != 0 && j % samples.stride == 0) continue;
    CellMap::Point guess = stretch.guess(map_);
    if (samples.stride != 0) {
      const auto &before = samples.xi[j - stride], &after = samples.xi[j + stride];
      for (std::size_t a = 0; a < 3; ++a) guess[a] = 0.5 * (before[a] + after[a]);
    } else if (j > 0) {
      guess = samples.xi[j - stride];
    }
    const double u = begin + (end - begin) * points.place(j);
    const double t = u >= 1 ? stretch.back : stretch.front + u * (stretch.back - stretch.front);
    samples.xi[j] = map_.reference(stretch.at(t), guess);
    std::array<double, kMostFields> values;
    evaluate(samples.xi[j], values);
    for (std::size_t f = 0; f < fields_.size(); ++f) samples.values[f][j] = values[f];
  }
  samples.stride = stride;
}

// The fields as exact polynomials: an affine map takes the ray to a straight line, and in the world
// it is one.
FieldAlongRay::Piece FieldAlongRay::exact(const RayStretch& stretch) const {
  const ChebyshevPoints& points = chebyshev_points(exact_degree_);
  CellMap::Point front = stretch.at(stretch.front), back = stretch.at(stretch.back);
  if (!in_world_) {
    front = map_.reference(front, map_.middle());
    back = map_.reference(back, map_.middle());
  }
  std::array<std::array<double, kMostDegree + 1>, kMostFields> values;
  for (std::size_t j = 0; j <= exact_degree_; ++j) {
    const double u = points.place(j);
    const CellMap::Point at{front[0] + u * (back[0] - front[0]),
                            front[1] + u * (back[1] - front[1]),
                            front[2] + u * (back[2] - front[2])};
    std::array<double, kMostFields> here;
    if (in_world_)
      evaluate_in_world(at, here);
    else
      evaluate(at, here);
    for (std::size_t f = 0; f < fields_.size(); ++f) values[f][j] = here[f];
  }
  Piece piece{0, 1, {}};
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    std::array<double, kMostDegree + 1> c;
    points.coefficients(values[f].data(), 1, c.data());
    piece.fields[f] = without_tail(c.data(), exact_degree_,
                                   std::max(fields_[f].allowed, rounding(stretch, fields_[f])));
  }
  return piece;
}

void FieldAlongRay::interpolate(const RayStretch& stretch, double begin, double end, int bisections,
                                std::vector<Piece>& pieces) const {
  Samples samples;
  std::array<std::array<double, kMostDegree + 1>, kMostFields> c;
  std::array<double, kMostFields> negligible;
  for (std::size_t f = 0; f < fields_.size(); ++f)
    negligible[f] = std::max(fields_[f].allowed, rounding(stretch, fields_[f]));
  std::size_t degree = 0;
  bool resolved = false;
  for (const std::size_t n : kAdaptiveDegrees) {
    degree = n;
    sample(stretch, begin, end, kMostDegree / n, samples);
    resolved = true;
    for (std::size_t f = 0; f < fields_.size(); ++f) {
      chebyshev_points(n).coefficients(samples.values[f].data(), samples.stride, c[f].data());
      resolved = resolved && std::abs(c[f][n]) + std::abs(c[f][n - 1]) <= negligible[f];
    }
    if (resolved) break;
  }
  const bool at_last = bisections == kMostBisections || pieces.size() >= kMostPieces;
  if (!resolved && !at_last) {
    const double middle = 0.5 * (begin + end);
    interpolate(stretch, begin, middle, bisections + 1, pieces);
    interpolate(stretch, middle, end, bisections + 1, pieces);
    return;
  }
  Piece piece{begin, end, {}};
  for (std::size_t f = 0; f < fields_.size(); ++f)
    piece.fields[f] = without_tail(c[f].data(), degree, negligible[f]);
  pieces.push_back(piece);
}

void FieldAlongRay::along(const RayStretch& stretch, std::vector<Piece>& pieces) const {
  pieces.clear();
  const bool constant = std::ranges::all_of(
      fields_, [](const CellField& field) { return field.least == field.most; });
  if (constant) {
    Piece piece{0, 1, {}};
    for (std::size_t f = 0; f < fields_.size(); ++f) piece.fields[f].c[0] = fields_[f].least;
    pieces.push_back(piece);
    return;
  }
  if (exact_degree_ > 0)
    pieces.push_back(exact(stretch));
  else
    interpolate(stretch, 0, 1, 0, pieces);
}

}  // namespace hiac

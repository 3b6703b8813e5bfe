#include "hiac/render/refine/extended_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Real = long double;
using Vec = ExtendedVector;

// Relative to a cell's size: the residual of a point whose reference coordinates are exact to
// rounding.
constexpr Real kResidual = 0x1p-59L;
constexpr int kMostSteps = 4;
// Relative to a cell's size: the residual at which Newton's iteration stops.
constexpr Real kSmallResidual = 0x1p-63L;

// The points of each degree include those of the previous one.
constexpr std::array<std::size_t, 2> kDegrees{8, 16};
// As in field_along_ray.cpp.
constexpr int kMostBisections = 40;
constexpr std::size_t kMostPieces = 96;

// The corners of a face, starting at the one of smallest node id and proceeding towards the smaller
// of its neighbours.
std::array<std::uint8_t, 4> in_shared_order(const ShapeFace& face, std::span<const NodeId> nodes) {
  const std::size_t n = face.corner_count;
  std::size_t first = 0;
  for (std::size_t k = 1; k < n; ++k)
    if (nodes[face.corners[k]] < nodes[face.corners[first]]) first = k;
  const std::size_t next = (first + 1) % n, before = (first + n - 1) % n;
  const bool forward = nodes[face.corners[next]] < nodes[face.corners[before]];
  std::array<std::uint8_t, 4> result{};
  for (std::size_t k = 0; k < n; ++k) result[k] = face.corners[(first + (forward ? k : n - k)) % n];
  return result;
}

struct Plane {
  Vec normal, middle;
};

Plane plane_of(const ShapeFace& face, std::span<const NodeId> nodes, std::span<const Vec> corners) {
  const auto order = in_shared_order(face, nodes);
  const std::size_t n = face.corner_count;
  const auto corner = [&](std::size_t k) -> const Vec& { return corners[order[k]]; };
  Plane plane{};
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t c = 0; c < 3; ++c) plane.middle[c] += corner(k)[c] / static_cast<Real>(n);
  plane.normal = n == 3 ? cross(minus(corner(1), corner(0)), minus(corner(2), corner(0)))
                        : cross(minus(corner(2), corner(0)), minus(corner(3), corner(1)));
  return plane;
}

}  // namespace

ExtendedCell::ExtendedCell(const Frame& frame, CellId cell)
    : kind_(frame.mesh.kinds[cell]), count_(corner_count(kind_)) {
  const auto nodes = frame.mesh.cell_nodes(cell);
  const auto reference = reference_nodes(kind_);
  std::array<CellMap::Point, kMostCorners> rough;
  for (std::size_t k = 0; k < count_; ++k) {
    nodes_[k] = nodes[k];
    corners_[k] = frame.projector.extended_camera_coordinates(frame.mesh.position(nodes[k]));
    for (std::size_t c = 0; c < 3; ++c) middle_[c] += reference[k][c] / static_cast<Real>(count_);
    reach_ = std::max(reach_, static_cast<double>(length(corners_[k])));
    edges_[k] = minus(corners_[k], corners_[0]);
    size_ = std::max(size_, static_cast<double>(length(edges_[k])));
    rough[k] = rounded(corners_[k]);
  }
  rough_map_.emplace(kind_, std::span(rough).first(count_), frame.straightness);
}

ExtendedCell::Part ExtendedCell::inside(const ExtendedRay& ray) const {
  constexpr Real kFar = std::numeric_limits<Real>::infinity();
  Vec center{};
  for (const Vec& p : corners())
    for (std::size_t c = 0; c < 3; ++c) center[c] += p[c] / static_cast<Real>(count_);
  Part part{-kFar, kFar, 0, 0};
  const auto faces = topology_of(kind_).faces;
  for (std::uint8_t f = 0; f < faces.size(); ++f) {
    const Plane plane = plane_of(faces[f], nodes_, corners_);
    const Real along = dot(plane.normal, ray.direction);
    if (along == 0) continue;  // parallel to the face: the other faces decide
    const Real t = dot(plane.normal, minus(plane.middle, ray.origin)) / along;
    const bool inwards = dot(plane.normal, minus(center, plane.middle)) > 0;
    if ((along > 0) == inwards) {
      if (t > part.front) part.front_face = f;
      part.front = std::max(part.front, t);
    } else {
      if (t < part.back) part.back_face = f;
      part.back = std::min(part.back, t);
    }
  }
  return part;
}

double ExtendedCell::bent() const {
  Real most = 0;
  for (const ShapeFace& face : topology_of(kind_).faces) {
    if (face.corner_count == 3) continue;
    const Plane plane = plane_of(face, nodes_, corners_);
    const Real area = length(plane.normal);
    if (!(area > 0)) continue;
    for (const std::uint8_t k : face.corners)
      most = std::max(most, std::abs(dot(plane.normal, minus(corners_[k], plane.middle))) / area);
  }
  return static_cast<double>(most);
}

// Newton's iteration from the inverse found in doubles; `xi`: a nearby start, replaced by the
// result.
bool ExtendedCell::newton(const Vec& point, Vec& xi) const {
  const CellMap::Point near = rough_map_->reference(rounded(point), rounded(xi));
  xi = {near[0], near[1], near[2]};
  const Vec from_first = minus(point, corners_[0]);
  Values shape;
  std::array<Vec, kMostCorners> gradient;
  for (int step = 0;; ++step) {
    shape_functions<Real>(kind_, xi, shape);
    Vec residual = from_first;
    for (std::size_t k = 1; k < count_; ++k)
      for (std::size_t c = 0; c < 3; ++c) residual[c] -= shape[k] * edges_[k][c];
    const Real size = length(residual);
    if (size <= kSmallResidual * size_ || step == kMostSteps) return size <= kResidual * size_;
    shape_gradients<Real>(kind_, xi, gradient);
    std::array<Vec, 3> column{};
    for (std::size_t k = 1; k < count_; ++k)
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t c = 0; c < 3; ++c) column[a][c] += gradient[k][a] * edges_[k][c];
    const Vec bc = cross(column[1], column[2]);
    const Real volume = dot(column[0], bc);
    xi[0] += dot(residual, bc) / volume;
    xi[1] += dot(residual, cross(column[2], column[0])) / volume;
    xi[2] += dot(residual, cross(column[0], column[1])) / volume;
    if (!std::isfinite(xi[0] + xi[1] + xi[2])) return false;
  }
}

bool ExtendedCell::interpolate(const ExtendedRay& ray, Real front, Real back, Real begin, Real end,
                               int bisections, std::span<const Field> fields,
                               std::vector<Piece>& pieces) const {
  std::array<BasicChebyshev<Real>, kMostFields> c;
  std::array<BasicCoefficients<Real>, kMostFields> values{};  // at all points of the highest degree
  Vec xi = middle_;
  bool resolved = false;
  for (const std::size_t degree : kDegrees) {
    const std::size_t stride = kDegrees.back() / degree;
    for (std::size_t j = 0; j <= kDegrees.back(); j += stride) {
      if (degree != kDegrees.front() && j % (2 * stride) == 0) continue;  // known already
      const Real u = begin + (end - begin) * chebyshev_point<Real>(j, kDegrees.back());
      if (!newton(ray.at(front + u * (back - front)), xi)) return false;
      Values shape;
      shape_functions<Real>(kind_, xi, shape);
      for (std::size_t f = 0; f < fields.size(); ++f) {
        const Field& field = fields[f];
        Real more = 0;
        for (std::size_t k = 1; k < count_; ++k)
          more += shape[k] * (field.values[k] - field.values[0]);
        values[f][j] = std::clamp(field.values[0] + more, field.least, field.most);
      }
    }
    resolved = true;
    for (std::size_t f = 0; f < fields.size(); ++f) {
      BasicCoefficients<Real> here{};
      for (std::size_t j = 0; j <= degree; ++j) here[j] = values[f][j * stride];
      c[f] = chebyshev_interpolant(here, degree);
      resolved = resolved &&
                 std::abs(c[f].c[degree]) + std::abs(c[f].c[degree - 1]) <= fields[f].negligible;
    }
    if (resolved) break;
  }
  if (!resolved && bisections < kMostBisections && pieces.size() < kMostPieces) {
    const Real middle = (begin + end) / 2;
    return interpolate(ray, front, back, begin, middle, bisections + 1, fields, pieces) &&
           interpolate(ray, front, back, middle, end, bisections + 1, fields, pieces);
  }
  Piece piece{begin, end, {}};
  for (std::size_t f = 0; f < fields.size(); ++f) {
    if (fields[f].least == fields[f].most) {
      piece.fields[f].c[0] = fields[f].least;
      continue;
    }
    Real dropped = 0;
    std::size_t degree = c[f].degree;
    while (degree > 0 && dropped + std::abs(c[f].c[degree]) <= fields[f].negligible)
      dropped += std::abs(c[f].c[degree--]);
    piece.fields[f] = bernstein_from_chebyshev(std::span<const Real>(c[f].c).first(degree + 1));
  }
  pieces.push_back(piece);
  return true;
}

bool ExtendedCell::along(const ExtendedRay& ray, Real front, Real back,
                         std::span<const Field> fields, std::vector<Piece>& pieces) const {
  pieces.clear();
  const auto constant = [](const Field& field) { return field.least == field.most; };
  if (!std::ranges::all_of(fields, constant))
    return interpolate(ray, front, back, 0, 1, 0, fields, pieces);
  Piece piece{0, 1, {}};
  for (std::size_t f = 0; f < fields.size(); ++f) piece.fields[f].c[0] = fields[f].least;
  pieces.push_back(piece);
  return true;
}

bool ExtendedCell::derivatives(const Vec& point, const Values& values, Derivatives& d) const {
  Vec xi = middle_;
  if (!newton(point, xi)) return false;
  std::array<Vec, kMostCorners> gradient;
  shape_gradients<Real>(kind_, xi, gradient);
  d = {};
  for (std::size_t k = 1; k < count_; ++k)
    for (std::size_t a = 0; a < 3; ++a) {
      d.gradient[a] += gradient[k][a] * (values[k] - values[0]);
      for (std::size_t c = 0; c < 3; ++c) d.columns[a][c] += gradient[k][a] * edges_[k][c];
    }
  return true;
}

}  // namespace hiac

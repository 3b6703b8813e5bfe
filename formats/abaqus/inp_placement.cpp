#include "formats/abaqus/inp_placement.hpp"

#include <cmath>
#include <numbers>

namespace hiac::formats::abaqus {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// The point in the next three fields, minus `from`.
Vector point_in(CommaFields& fields, const TextCursor& cursor, std::string_view line,
                const Vector& from = {}) {
  Vector point{};
  for (std::size_t c = 0; c < 3; ++c)
    if (!fields.at_end()) point[c] = real_in(fields, cursor, line);
  return point - from;
}

}  // namespace

Vector placed(const Placement& placement, const double* point) {
  Vector result = placement.translation;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t c = 0; c < 3; ++c) result[row] += placement.rotation[3 * row + c] * point[c];
  return result;
}

void rotate(const std::array<double, 7>& data, Placement& placement) {
  Vector axis = Vector{data[3], data[4], data[5]} - Vector{data[0], data[1], data[2]};
  const double size = length(axis);
  if (!(size > 0)) return;
  for (double& x : axis) x /= size;
  const double angle = data[6] * kDegree;
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  // Rodrigues' formula
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      placement.rotation[3 * i + j] = (i == j ? cosine : 0) + (1 - cosine) * axis[i] * axis[j];
  for (std::size_t i = 0; i < 3; ++i) {
    placement.rotation[3 * i + (i + 1) % 3] -= sine * axis[(i + 2) % 3];
    placement.rotation[3 * i + (i + 2) % 3] += sine * axis[(i + 1) % 3];
  }
  // x -> R (x + t - a) + a
  Vector moved{};
  for (std::size_t i = 0; i < 3; ++i) {
    moved[i] = data[i];
    for (std::size_t j = 0; j < 3; ++j)
      moved[i] += placement.rotation[3 * i + j] * (placement.translation[j] - data[j]);
  }
  placement.translation = moved;
}

std::optional<Placement> read_system(TextCursor& cursor) {
  const auto first = data_line(cursor);
  if (!first) return std::nullopt;
  const auto second = data_line(cursor);
  Placement placement;
  placement.moved = true;
  CommaFields fields(*first);
  placement.translation = point_in(fields, cursor, *first);
  if (fields.at_end()) {
    if (second) refuse(cursor, *first, "*SYSTEM: the origin and a point on the first axis");
    return placement;
  }
  Vector x = point_in(fields, cursor, *first, placement.translation);
  Vector z{0, 0, 1};
  if (second) {
    CommaFields more(*second);
    z = cross(x, point_in(more, cursor, *second, placement.translation));
  } else {
    // the z-axis is kept, and the first axis is projected onto the x-y plane
    x[2] = 0;
  }
  const double x_length = length(x);
  const double z_length = length(z);
  if (!(x_length > 0) || !(z_length > 0))
    refuse(cursor, second ? *second : *first, "*SYSTEM: points that make axes");
  for (double& c : x) c /= x_length;
  for (double& c : z) c /= z_length;
  const Vector y = cross(z, x);
  for (std::size_t row = 0; row < 3; ++row) {
    placement.rotation[3 * row] = x[row];
    placement.rotation[3 * row + 1] = y[row];
    placement.rotation[3 * row + 2] = z[row];
  }
  return placement;
}

void to_rectangular(char kind, Vector& point) {
  if (kind == 'R') return;
  const double azimuth = point[1] * kDegree;
  const double elevation = kind == 'S' ? point[2] * kDegree : 0;
  const double radius = point[0];
  point[0] = radius * std::cos(azimuth) * std::cos(elevation);
  point[1] = radius * std::sin(azimuth) * std::cos(elevation);
  if (kind == 'S') point[2] = radius * std::sin(elevation);
}

char kind_of_system(const Keyword& keyword) {
  const std::string* system = keyword.value("SYSTEM");
  return system == nullptr || system->empty() ? 'R' : upper(*system).front();
}

}  // namespace hiac::formats::abaqus

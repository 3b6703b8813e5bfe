// Based on: StereoLithography Interface Specification, 3D Systems, 1989 (the binary form).
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "formats/boundary/write_boundary.hpp"
#include "formats/common/io/binary_output.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

using Position = std::array<double, 3>;

Position position(const BoundarySurface& surface, std::uint32_t point) {
  const double* p = &surface.xyz[3 * std::size_t{point}];
  return {p[0], p[1], p[2]};
}

std::array<float, 3> unit_normal(const std::array<Position, 3>& t) {
  Position u{}, v{};
  for (std::size_t c = 0; c < 3; ++c) {
    u[c] = t[1][c] - t[0][c];
    v[c] = t[2][c] - t[0][c];
  }
  const Position normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                        u[0] * v[1] - u[1] * v[0]};
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  if (!(length > 0) || !std::isfinite(length)) return {};
  return {static_cast<float>(normal[0] / length), static_cast<float>(normal[1] / length),
          static_cast<float>(normal[2] / length)};
}

}  // namespace

std::vector<std::string> write_stl(const std::string& path, const BoundarySurface& surface) {
  if (surface.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw InputError(path, fmt::format("STL cannot hold {} triangles (at most 2^32 - 1 expected)",
                                       surface.triangles.size()));
  double farthest = 0;
  for (const double x : surface.xyz) {
    if (std::abs(x) > std::numeric_limits<float>::max())
      throw InputError(path, fmt::format("STL cannot hold the coordinate {} (it has single "
                                         "precision)",
                                         x));
    farthest = std::max(farthest, std::abs(x - static_cast<double>(static_cast<float>(x))));
  }
  BinaryOutput out(path);
  std::string header = "binary STL by hiac";  // not "solid", which begins a text
  header.resize(80, ' ');
  out.text(header);
  out.number(static_cast<std::uint32_t>(surface.triangles.size()));
  for (const auto& triangle : surface.triangles) {
    std::array<Position, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = position(surface, triangle[k]);
    for (const float x : unit_normal(corners)) out.number(x);
    for (const Position& corner : corners)
      for (const double x : corner) out.number(static_cast<float>(x));
    out.number<std::uint16_t>(0);
  }
  out.finish();
  std::vector<std::string> notes;
  if (farthest > 0)
    notes.push_back(
        fmt::format("STL has single precision: coordinates moved by at most {:.2g}", farthest));
  if (!surface.fields.empty()) notes.push_back("STL has no place for fields: left out");
  return notes;
}

}  // namespace hiac::formats

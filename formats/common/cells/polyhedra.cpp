#include "formats/common/cells/polyhedra.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

/// Six times the volume between a point and a face, divided into triangles from its first node.
double volume_below(const FaceNodes& face, std::span<const double> from,
                    const std::function<std::span<const double>(std::int64_t)>& position) {
  const auto arrow = [&](std::int64_t node) {
    const std::span<const double> p = position(node);
    return std::array<double, 3>{p[0] - from[0], p[1] - from[1], p[2] - from[2]};
  };
  const auto a = arrow(face[0]);
  double sum = 0;
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    const auto b = arrow(face[i]);
    const auto c = arrow(face[i + 1]);
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

using Edge = std::pair<std::int64_t, std::int64_t>;

/// The faces at every edge, in whichever direction they run along it.
std::map<Edge, std::vector<std::size_t>> faces_at_edges(const std::vector<FaceNodes>& faces) {
  std::map<Edge, std::vector<std::size_t>> at;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t i = 0; i < faces[f].size(); ++i) {
      const std::int64_t a = faces[f][i];
      const std::int64_t b = faces[f][(i + 1) % faces[f].size()];
      at[{std::min(a, b), std::max(a, b)}].push_back(f);
    }
  return at;
}

bool goes_along(const FaceNodes& face, std::int64_t a, std::int64_t b) {
  for (std::size_t i = 0; i < face.size(); ++i)
    if (face[i] == a && face[(i + 1) % face.size()] == b) return true;
  return false;
}

}  // namespace

std::vector<FaceNodes> faces_of(const ForeignPolyhedra& polyhedra, std::size_t place,
                                const std::string& subject) {
  std::vector<FaceNodes> faces;
  std::size_t at = place == 0 ? 0 : polyhedra.ends[place - 1];
  const std::size_t end = polyhedra.ends[place];
  while (at < end) {
    const std::int64_t count = polyhedra.faces[at++];
    if (count < 3 || static_cast<std::uint64_t>(count) > end - at)
      throw InputError(subject, fmt::format("cell {}: a face of {} nodes (3 and more expected, as "
                                            "many as there are)",
                                            polyhedra.cells[place], count));
    const auto first = polyhedra.faces.begin() + static_cast<std::ptrdiff_t>(at);
    faces.emplace_back(first, first + count);
    at += static_cast<std::size_t>(count);
  }
  return faces;
}

std::optional<std::vector<FaceNodes>> turned_outward(
    std::vector<FaceNodes> faces,
    const std::function<std::span<const double>(std::int64_t node)>& position) {
  if (faces.size() < 4) return std::nullopt;
  const auto at_edge = faces_at_edges(faces);
  for (const auto& [edge, sharing] : at_edge)
    if (sharing.size() != 2 || edge.first == edge.second) return std::nullopt;
  std::vector<bool> turned(faces.size(), false);
  std::vector<std::size_t> queue{0};
  turned[0] = true;
  while (!queue.empty()) {
    const FaceNodes face = faces[queue.back()];
    const std::size_t own = queue.back();
    queue.pop_back();
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::int64_t a = face[i];
      const std::int64_t b = face[(i + 1) % face.size()];
      const auto& sharing = at_edge.at({std::min(a, b), std::max(a, b)});
      const std::size_t other = sharing[0] == own ? sharing[1] : sharing[0];
      const bool same_way = goes_along(faces[other], a, b);
      if (turned[other] && same_way) return std::nullopt;
      if (turned[other]) continue;
      if (same_way) std::reverse(faces[other].begin(), faces[other].end());
      turned[other] = true;
      queue.push_back(other);
    }
  }
  if (std::find(turned.begin(), turned.end(), false) != turned.end()) return std::nullopt;
  const std::span<const double> from = position(faces[0][0]);
  double volume = 0;
  for (const FaceNodes& face : faces) volume += volume_below(face, from, position);
  if (volume < 0)
    for (FaceNodes& face : faces) std::reverse(face.begin(), face.end());
  return faces;
}

}  // namespace hiac::formats

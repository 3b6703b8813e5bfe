#include "hiac/preview/regions/polyhedron.hpp"

#include <algorithm>
#include <cmath>

namespace hiac::preview {
namespace {

constexpr std::uint16_t kNone = 0xFFFF;

template <std::size_t N>
std::array<double, N> mixed(const std::array<double, N>& a, const std::array<double, N>& b,
                            double share) {
  std::array<double, N> result;
  for (std::size_t c = 0; c < N; ++c) result[c] = (1 - share) * a[c] + share * b[c];
  return result;
}

}  // namespace

void Polyhedron::clear() {
  camera.clear();
  shares.clear();
  points.clear();
  depths.clear();
  corners.clear();
  first.assign(1, 0);
}

void edges_of(const Polyhedron& polyhedron, std::vector<PolyhedronEdge>& edges) {
  edges.clear();
  for (std::size_t f = 0; f < polyhedron.face_count(); ++f) {
    const auto face = polyhedron.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint16_t a = face[k], b = face[k + 1 == face.size() ? 0 : k + 1];
      if (a < b) edges.push_back({a, b});
    }
  }
}

std::uint16_t PolyhedronCutter::keep(const Polyhedron& whole, std::size_t vertex, double value,
                                     Part& part) {
  std::uint16_t& number = (*part.number)[vertex];
  if (number != kNone) return number;
  number = static_cast<std::uint16_t>(part.polyhedron->size());
  part.polyhedron->camera.push_back(whole.camera[vertex]);
  part.polyhedron->shares.push_back(whole.shares[vertex]);
  part.polyhedron->points.push_back(whole.points[vertex]);
  part.polyhedron->depths.push_back(whole.depths[vertex]);
  part.values->push_back(value);
  return number;
}

const PolyhedronCutter::NewVertex& PolyhedronCutter::on_edge(const Polyhedron& whole,
                                                             std::span<const double> values,
                                                             double level, std::uint16_t i,
                                                             std::uint16_t k, Part& below,
                                                             Part& above) {
  if (values[i] > values[k]) std::swap(i, k);
  for (const NewVertex& made : new_)
    if (made.low == i && made.high == k) return made;
  const double share = (level - values[i]) / (values[k] - values[i]);
  NewVertex made{i, k, 0, 0};
  for (Part* part : {&below, &above}) {
    (part == &below ? made.below : made.above) =
        static_cast<std::uint16_t>(part->polyhedron->size());
    part->polyhedron->camera.push_back(mixed(whole.camera[i], whole.camera[k], share));
    part->polyhedron->shares.push_back(mixed(whole.shares[i], whole.shares[k], share));
    part->polyhedron->points.push_back({NAN, NAN});
    part->polyhedron->depths.push_back(NAN);
    part->values->push_back(level);
  }
  on_plane_.push_back({made.below, made.above});
  new_.push_back(made);
  return new_.back();
}

// The parts of a face, and the side of the cut that it leaves in the plane.
void PolyhedronCutter::cut_face(const Polyhedron& whole, std::span<const double> values,
                                double level, std::span<const std::uint16_t> face, Part& below,
                                Part& above) {
  bool any_below = false, any_above = false;
  for (const std::uint16_t v : face) {
    any_below |= values[v] < level;
    any_above |= values[v] > level;
  }
  std::uint16_t enters = kNone, leaves = kNone;  // of the part below, through the plane
  int times = 0, meetings = 0;                   // it leaves; the border meets the plane
  for (std::size_t n = 0; n < face.size(); ++n) {
    const std::uint16_t v = face[n], next = face[n + 1 == face.size() ? 0 : n + 1];
    const std::uint16_t before = face[n == 0 ? face.size() - 1 : n - 1];
    if (any_below && values[v] <= level)
      below.polyhedron->corners.push_back(keep(whole, v, values[v], below));
    if (any_above && values[v] >= level)
      above.polyhedron->corners.push_back(keep(whole, v, values[v], above));
    meetings += values[v] == level ? 1 : 0;
    if (any_below && values[v] == level) {
      if (values[before] < level) {
        leaves = (*below.number)[v];
        ++times;
      }
      if (values[next] < level) enters = (*below.number)[v];
    }
    const bool crosses =
        (values[v] < level && values[next] > level) || (values[v] > level && values[next] < level);
    if (!crosses) continue;
    const NewVertex& made = on_edge(whole, values, level, v, next, below, above);
    below.polyhedron->corners.push_back(made.below);
    above.polyhedron->corners.push_back(made.above);
    (values[v] < level ? leaves : enters) = made.below;
    times += values[v] < level ? 1 : 0;
    ++meetings;
  }
  for (Part* part : {&below, &above})
    if (part->polyhedron->corners.size() > part->polyhedron->first.back())
      part->polyhedron->first.push_back(
          static_cast<std::uint16_t>(part->polyhedron->corners.size()));
  // a convex face that lies not in the plane meets it at two points of its border, or along a side
  if (times > 1 || ((any_below || any_above) && meetings > 2)) contradictory_ = true;
  // a side of the polygon runs the other way than in the face
  if (leaves != kNone && enters != kNone && leaves != enters) sides_.push_back({enters, leaves});
}

// Links the sides to the polygon, which becomes a face of both parts.
bool PolyhedronCutter::close(Part& below, Part& above) {
  polygon.clear();
  if (contradictory_ || sides_.size() < 3) return false;
  std::uint16_t at = sides_.front()[0];
  for (std::size_t n = 0; n < sides_.size(); ++n) {
    polygon.push_back(at);
    std::uint16_t next = kNone;
    for (const auto& side : sides_)
      if (side[0] == at) {
        if (next != kNone) return false;
        next = side[1];
      }
    if (next == kNone) return false;
    at = next;
    if (at == polygon.front() && n + 1 < sides_.size()) return false;
  }
  if (at != polygon.front()) return false;
  auto& corners = below.polyhedron->corners;
  corners.insert(corners.end(), polygon.begin(), polygon.end());
  below.polyhedron->first.push_back(static_cast<std::uint16_t>(corners.size()));
  for (std::size_t n = polygon.size(); n-- > 0;)
    for (const auto& both : on_plane_)
      if (both[0] == polygon[n]) above.polyhedron->corners.push_back(both[1]);
  above.polyhedron->first.push_back(static_cast<std::uint16_t>(above.polyhedron->corners.size()));
  return true;
}

bool PolyhedronCutter::cut(const Polyhedron& whole, std::span<const double> values, double level,
                           Polyhedron& below, Polyhedron& above) {
  below.clear();
  above.clear();
  values_below.clear();
  values_above.clear();
  polygon.clear();
  new_.clear();
  sides_.clear();
  on_plane_.clear();
  contradictory_ = false;
  std::size_t lower = 0, higher = 0;
  for (const double value : values) {
    lower += value < level ? 1 : 0;
    higher += value > level ? 1 : 0;
  }
  const auto take_whole = [&] {
    bool is_below = false;
    if (!values.empty()) {
      const auto [least, most] = std::ranges::minmax(values);
      is_below = level - least > most - level;
    }
    (is_below ? below : above) = whole;
    (is_below ? values_below : values_above).assign(values.begin(), values.end());
    polygon.clear();
  };
  if (lower == 0 || higher == 0) {
    take_whole();
    return true;
  }
  number_below_.assign(whole.size(), kNone);
  number_above_.assign(whole.size(), kNone);
  Part low{&below, &values_below, &number_below_};
  Part high{&above, &values_above, &number_above_};
  for (std::uint16_t v = 0; v < whole.size(); ++v)
    if (values[v] == level)
      on_plane_.push_back({keep(whole, v, level, low), keep(whole, v, level, high)});
  for (std::size_t f = 0; f < whole.face_count(); ++f)
    cut_face(whole, values, level, whole.face(f), low, high);
  if (close(low, high)) return true;
  below.clear();
  above.clear();
  values_below.clear();
  values_above.clear();
  take_whole();
  return false;
}

}  // namespace hiac::preview

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>

#include "formats/abaqus/inp_generation.hpp"

namespace hiac::formats::abaqus {
namespace {

/// A node takes its number and three coordinates.
constexpr std::size_t kNodeNumbers = 4;

/// The point at a fraction (0 to 1) of the way from one node to another.
using Curve = std::function<Vector(double)>;

void add_node(Part& part, std::int64_t number, const Vector& point) {
  part.node_numbers.push_back(number);
  part.xyz.insert(part.xyz.end(), point.begin(), point.end());
}

void follow_nodes(Part& part) {
  part.made = true;
  part.node_places.follow(part.node_numbers);
}

Vector position(const Part& part, std::size_t place) {
  return {part.xyz[3 * place], part.xyz[3 * place + 1], part.xyz[3 * place + 2]};
}

/// The position of the node with that number, which must be defined before this line.
Vector position_of(const Generation& g, std::string_view line, std::int64_t number) {
  const auto place = g.part.node_places.find(number);
  if (!place)
    refuse(g.cursor, line, fmt::format("*{}: a node {} before it", g.keyword.name, number));
  return position(g.part, *place);
}

Vector point_in(CommaFields& fields, const Generation& g, std::string_view line) {
  Vector point{};
  for (double& x : point)
    if (!fields.at_end()) x = real_in(fields, g.cursor, line);
  return point;
}

/// The arc round `centre` from a to b: the shorter one or, if a normal is given, the one that goes
/// counter-clockwise about it. The ends may differ slightly in their distance from the centre: the
/// radius changes gradually from one to the other.
Curve arc(const Generation& g, std::string_view line, const Vector& a, const Vector& b,
          const Vector& centre, const Vector& normal) {
  constexpr double kRoundOff = 1e-3;
  constexpr double kNoArc = 1e-9;
  const Vector from = a - centre;
  const Vector to = b - centre;
  const double first = length(from);
  const double last = length(to);
  if (!(first > 0) || !(std::abs(first - last) <= kRoundOff * first))
    refuse(g.cursor, line, "*NGEN, LINE=C: ends equally far from the centre");
  Vector axis = cross(from, to);
  double angle = std::atan2(length(axis), dot(from, to));
  if (length(normal) > 0) {
    axis = (1 / length(normal)) * normal;
    if (!(std::abs(dot(axis, from)) <= kRoundOff * first) ||
        !(std::abs(dot(axis, to)) <= kRoundOff * first))
      refuse(g.cursor, line, "*NGEN, LINE=C: a normal to the plane of the arc");
    angle = std::atan2(dot(axis, cross(from, to)), dot(from, to));
    if (angle < kNoArc) angle += 2 * std::numbers::pi;
  } else if (angle < kNoArc || angle > std::numbers::pi - kNoArc) {
    refuse(g.cursor, line, "*NGEN, LINE=C: a normal, for an arc of 180 degrees or a circle,");
  }
  const Vector x = (1 / first) * from;
  const Vector across = cross(axis, x);
  const Vector y = (1 / length(across)) * across;
  return [=](double s) {
    const double radius = first + s * (last - first);
    return centre + radius * (std::cos(s * angle) * x + std::sin(s * angle) * y);
  };
}

/// The extra point of a curve: a node, or coordinates in the system of the parameter SYSTEM.
Vector extra_point(CommaFields& fields, const Generation& g, std::string_view line) {
  const std::int64_t node = whole_in(fields, g.cursor, line, "*NGEN: a node number", 0);
  Vector point = point_in(fields, g, line);
  if (node != 0) return position_of(g, line, node);
  if (g.system) not_supported(g, "*NGEN with the coordinates of a point under *SYSTEM");
  to_rectangular(kind_of_system(g.keyword), point);
  return point;
}

Curve curve_of(char kind, CommaFields& fields, const Generation& g, std::string_view line,
               const Vector& a, const Vector& b) {
  if (kind == 'C') {
    const Vector centre = extra_point(fields, g, line);
    return arc(g, line, a, b, centre, point_in(fields, g, line));
  }
  if (kind == 'P') {
    const Vector middle = extra_point(fields, g, line);
    return [=](double s) {
      return (1 - s) * (1 - 2 * s) * a + 4 * s * (1 - s) * middle + s * (2 * s - 1) * b;
    };
  }
  return [=](double s) { return (1 - s) * a + s * b; };
}

/// 'L', 'P' or 'C'.
char kind_of_line(const Generation& g) {
  const std::string* line = g.keyword.value("LINE");
  if (line == nullptr) return 'L';
  if (upper(*line) == "P") return 'P';
  if (upper(*line) != "C") refuse(g.cursor, keyword_line(g), "*NGEN: LINE=P or LINE=C");
  return 'C';
}

void add_to_set(const Generation& g, std::string_view parameter,
                const std::vector<NumberRange>& numbers) {
  const std::string* set = g.keyword.value(parameter);
  if (set != nullptr && !set->empty()) add_ranges(numbers, set_named(g.part.node_sets, *set));
}

/// *NGEN: nodes between two nodes.
void generate_lines(const Generation& g) {
  const char kind = kind_of_line(g);
  std::vector<NumberRange> numbers;
  while (const auto line = data_line(g.cursor)) {
    follow_nodes(g.part);
    CommaFields fields(*line);
    const std::int64_t first = whole_in(fields, g.cursor, *line, "*NGEN: a node number");
    const std::int64_t last = whole_in(fields, g.cursor, *line, "*NGEN: a node number");
    std::int64_t step = std::abs(whole_in(fields, g.cursor, *line, "*NGEN: an increment", 1));
    if (step == 0) step = 1;
    if ((last - first) % step != 0)
      refuse(g.cursor, *line, "*NGEN: an increment that leads from the first node to the last");
    const std::int64_t intervals = std::abs(last - first) / step;
    const Vector a = position_of(g, *line, first);
    const Vector b = position_of(g, *line, last);
    const Curve curve = curve_of(kind, fields, g, *line, a, b);
    take(g, *line, kNodeNumbers * static_cast<std::size_t>(intervals));
    if (last < first) step = -step;
    for (std::int64_t k = 1; k < intervals; ++k)
      add_node(g.part, first + k * step,
               curve(static_cast<double>(k) / static_cast<double>(intervals)));
    for (std::int64_t k = 0; k <= intervals; ++k) add_number(first + k * step, numbers);
  }
  add_to_set(g, "NSET", numbers);
}

/// The numbers of a node set, which must be defined before this line and have no unknown members.
std::vector<std::int64_t> nodes_of(const Generation& g, std::string_view line,
                                   const std::string& name) {
  const auto found = g.part.node_sets.find(upper(name));
  if (found == g.part.node_sets.end())
    refuse(g.cursor, line,
           fmt::format("*{}: a node set {} before it", g.keyword.name, shown(name)));
  if (!found->second.unknown.empty())
    refuse(g.cursor, line,
           fmt::format("*{}: of the node set {} nodes that are listed, not {},", g.keyword.name,
                       shown(name), found->second.unknown));
  auto members =
      members_of(found->second, g.part.node_places, g.part.node_numbers, g.made.looked_at);
  take(g, line, 0);
  return members;
}

/// How *NFILL divides its lines: the ends, from 0 to 1, of all intervals but the last. Each
/// interval is `bias` times as long as the next one; with `pairs`, each pair of intervals is.
std::vector<double> divisions(std::size_t intervals, double bias, bool pairs) {
  const std::size_t parts = pairs ? intervals / 2 : intervals;
  // the longest interval is 1, so that powers do not overflow
  const double ratio = bias < 1 ? bias : 1 / bias;
  std::vector<double> lengths(intervals);
  double sum = 0;
  for (std::size_t i = 0; i < intervals; ++i) {
    const std::size_t part = pairs ? i / 2 : i;
    const std::size_t power = bias < 1 ? parts - 1 - part : part;
    lengths[i] = std::pow(ratio, static_cast<double>(power));
    sum += lengths[i];
  }
  std::vector<double> ends;
  double end = 0;
  for (std::size_t i = 0; i + 1 < intervals; ++i)
    ends.push_back(bias == 1 ? static_cast<double>(i + 1) / static_cast<double>(intervals)
                             : (end += lengths[i]) / sum);
  return ends;
}

/// *NFILL: nodes between the nodes of two sets.
void fill(const Generation& g) {
  if (g.keyword.has("SINGULAR")) not_supported(g, "*NFILL, SINGULAR");
  double bias = 1;
  if (const std::string* text = g.keyword.value("BIAS")) bias = to_real(*text).value_or(0);
  if (!(bias > 0) || !std::isfinite(bias))
    refuse(g.cursor, keyword_line(g), "*NFILL: a BIAS above 0");
  const bool pairs = g.keyword.has_flag("TWOSTEP");
  std::vector<NumberRange> numbers;
  while (const auto line = data_line(g.cursor)) {
    follow_nodes(g.part);
    CommaFields fields(*line);
    const auto from = nodes_of(g, *line, std::string(fields.field()));
    const auto to = nodes_of(g, *line, std::string(fields.field()));
    const std::int64_t intervals =
        whole_in(fields, g.cursor, *line, "*NFILL: a number of intervals");
    const std::int64_t step =
        whole_in(fields, g.cursor, *line, "*NFILL: an increment of node numbers");
    if (intervals < 1 || (pairs && intervals % 2 != 0))
      refuse(
          g.cursor, *line,
          pairs ? "*NFILL, TWO STEP: an even number of intervals" : "*NFILL: 1 interval or more");
    // surplus nodes of the larger set are not joined to anything
    const std::size_t lines = std::min(from.size(), to.size());
    take(g, *line, kNodeNumbers * static_cast<std::size_t>(intervals));
    take(g, *line, kNodeNumbers * static_cast<std::size_t>(intervals) * lines);
    const std::vector<double> ends = divisions(static_cast<std::size_t>(intervals), bias, pairs);
    for (std::size_t i = 0; i < lines; ++i) {
      const Vector a = position_of(g, *line, from[i]);
      const Vector b = position_of(g, *line, to[i]);
      std::int64_t number = checked_number(g, from[i]);
      for (const double s : ends) {
        add_node(g.part, number += step, (1 - s) * a + s * b);
        add_number(number, numbers);
      }
    }
    for (const auto* set : {&from, &to})
      for (const std::int64_t number : *set) add_number(number, numbers);
  }
  add_to_set(g, "NSET", numbers);
}

/// SHIFT: a translation, and a rotation about the line through two points, MULTIPLE times.
Placement shift(const Generation& g) {
  Placement placement;
  const auto first = data_line_or_blank(g.cursor);
  if (!first)
    refuse(g.cursor, keyword_line(g), "*NCOPY, SHIFT: a line with a translation behind it");
  CommaFields fields(*first);
  placement.translation = point_in(fields, g, *first);
  const auto second = data_line_or_blank(g.cursor);
  if (!second) return placement;
  std::array<double, 7> data{};
  CommaFields more(*second);
  for (double& x : data)
    if (!more.at_end()) x = real_in(more, g.cursor, *second);
  if (data[6] == 0) return placement;
  if (data[0] == data[3] && data[1] == data[4] && data[2] == data[5])
    refuse(g.cursor, *second, "*NCOPY, SHIFT: two points on the axis of the rotation");
  if (g.keyword.has("MULTIPLE")) data[6] *= static_cast<double>(whole_parameter(g, "MULTIPLE"));
  rotate(data, placement);
  return placement;
}

/// REFLECT: at a point, a line or a plane. x -> 2 p - x, where p is the foot of x on it.
Placement reflect(const Generation& g) {
  const std::string kind = upper(required(g.keyword, "REFLECT", g.cursor));
  if (kind != "POINT" && kind != "LINE" && kind != "MIRROR")
    refuse(g.cursor, keyword_line(g), "*NCOPY: REFLECT=POINT, LINE or MIRROR");
  const auto first = data_line(g.cursor);
  if (!first) refuse(g.cursor, keyword_line(g), "*NCOPY, REFLECT: a line with points behind it");
  CommaFields fields(*first);
  const Vector a = point_in(fields, g, *first);
  Placement placement;
  placement.rotation = {-1, 0, 0, 0, -1, 0, 0, 0, -1};
  Vector axis{};
  if (kind != "POINT") axis = point_in(fields, g, *first) - a;
  std::string_view last = *first;
  if (kind == "MIRROR") {
    const auto second = data_line(g.cursor);
    if (!second)
      refuse(g.cursor, *first, "*NCOPY, REFLECT=MIRROR: a line with a third point behind it");
    last = *second;
    CommaFields more(last);
    axis = cross(axis, point_in(more, g, last) - a);
    for (std::size_t i = 0; i < 3; ++i) placement.rotation[4 * i] = 1;
  }
  if (kind != "POINT") {
    const double size = length(axis);
    if (!(size > 0))
      refuse(g.cursor, last, "*NCOPY, REFLECT: points that differ, not on one line,");
    axis = (1 / size) * axis;
    const double sign = kind == "MIRROR" ? -2 : 2;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) placement.rotation[3 * i + j] += sign * axis[i] * axis[j];
  }
  placement.translation = a - placed(placement, a.data());
  return placement;
}

/// *NCOPY: copies the nodes of a set to another place.
void copy_nodes(const Generation& g) {
  if (g.keyword.has("POLE")) not_supported(g, "*NCOPY, POLE");
  if (g.system) not_supported(g, "*NCOPY under *SYSTEM");
  if (!g.keyword.has_flag("SHIFT") && !g.keyword.has("REFLECT"))
    refuse(g.cursor, keyword_line(g), "*NCOPY: SHIFT or REFLECT");
  const std::int64_t change = whole_parameter(g, "CHANGENUMBER");
  const std::string name = required(g.keyword, "OLDSET", g.cursor);
  const std::string_view line = keyword_line(g);
  const Placement placement = g.keyword.has_flag("SHIFT") ? shift(g) : reflect(g);
  follow_nodes(g.part);
  const auto old = nodes_of(g, line, name);
  take(g, line, kNodeNumbers * old.size());
  std::vector<NumberRange> numbers;
  for (const std::int64_t number : old) {
    const std::int64_t copy = checked_number(g, number) + change;
    add_node(g.part, copy, placed(placement, position_of(g, line, number).data()));
    add_number(copy, numbers);
  }
  const std::string* set = g.keyword.value("NEWSET");
  if (set == nullptr || set->empty()) return;
  const bool made = !g.part.node_sets.contains(upper(*set));
  NumberSet& into = set_named(g.part.node_sets, *set);
  if (made) into.unsorted = g.part.node_sets.at(upper(name)).unsorted;
  add_ranges(numbers, into);
}

}  // namespace

void generate_nodes(const Generation& generation) {
  if (generation.keyword.name == "NGEN") return generate_lines(generation);
  if (generation.keyword.name == "NFILL") return fill(generation);
  copy_nodes(generation);
}

}  // namespace hiac::formats::abaqus

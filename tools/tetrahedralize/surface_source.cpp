#include "tools/tetrahedralize/surface_source.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/surface/surface_file.hpp"
#include "hiac/base/error.hpp"
#include "hiac/tetrahedralize/meshing/fill_surface.hpp"
#include "hiac/tetrahedralize/meshing/surface_defects.hpp"
#include "hiac/tetrahedralize/weld_surface.hpp"
#include "hiac/tetrahedralize/winding_number.hpp"
#include "tools/common/as_option.hpp"
#include "tools/common/mesh_io.hpp"

namespace hiac::tools {
namespace {

using Json = nlohmann::ordered_json;

// The first few of a list, and how many more there are.
template <typename List, typename Text>
std::string listed(const List& list, std::size_t most, const Text& text) {
  std::vector<std::string> shown;
  for (std::size_t k = 0; k < std::min(most, list.size()); ++k) shown.push_back(text(list[k]));
  std::string line = fmt::format("{}", fmt::join(shown, ", "));
  if (list.size() > most) line += fmt::format(" and {} more", list.size() - most);
  return line;
}

// Defects are told one kind a line, all of them; then the surface is refused.
void judge(Tool& tool, const std::string& input, const SurfaceOptions& options,
           const SurfaceDefects& defects) {
  Json& facts = tool.facts()["surface_defects"];
  facts = {{"open_edges", Json::array()},
           {"intersecting_triangles", Json::array()},
           {"degenerate_triangles", defects.degenerate}};
  for (const auto& edge : defects.open)
    facts["open_edges"].push_back({{"points", edge.points}, {"triangle", edge.triangle}});
  for (const auto& [a, b] : defects.intersecting) facts["intersecting_triangles"].push_back({a, b});
  if (defects.none()) return;
  std::vector<std::string> kinds;
  const auto tell = [&](const std::string& what, const auto& list, const auto& text) {
    if (list.empty()) return;
    kinds.push_back(fmt::format("{} {}", list.size(), what));
    tool.print(fmt::format("{}: {}\n", what, listed(list, options.max_ids, text)));
  };
  tell("open edges", defects.open, [](const SurfaceDefects::Edge& e) {
    return fmt::format("{}-{} of triangle {}", e.points[0], e.points[1], e.triangle);
  });
  tell("pairs of triangles that intersect", defects.intersecting,
       [](const auto& pair) { return fmt::format("{} and {}", pair.first, pair.second); });
  tell("triangles without area", defects.degenerate,
       [](std::uint32_t triangle) { return fmt::format("{}", triangle); });
  const char* const help =
      defects.open.empty() || options.weld ? "" : "; --weld TOL joins points that are doubled";
  throw JudgementError(fmt::format("{}: the surface is not closed and free of intersections ({}{})",
                                   input, fmt::join(kinds, ", "), help));
}

// X,Y,Z
std::array<double, 3> point_of(const std::string& text) {
  std::array<double, 3> point{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t c = 0; c < 3; ++c) {
    if (c > 0 && (at == end || *at++ != ',')) at = nullptr;
    const auto [next, error] = std::from_chars(at, at == nullptr ? nullptr : end, point[c]);
    if (error != std::errc() || !std::isfinite(point[c]) || (c == 2 && next != end))
      throw UsageError(fmt::format("--hole: expected X,Y,Z (found {})", text));
    at = next;
  }
  return point;
}

void weld(Tool& tool, double tolerance, Surface& surface) {
  const WeldCounts counts = tool.timed("weld", [&] { return weld_surface(surface, tolerance); });
  tool.facts()["weld"] = {{"tolerance", tolerance},
                          {"points", counts.points},
                          {"facets", counts.facets},
                          {"farthest", counts.farthest}};
  tool.note(fmt::format("{} points became others, at most {:.3g} away; {} facets are gone by that",
                        counts.points, counts.farthest, counts.facets));
}

std::string at_point(const FilledPart& part) {
  return fmt::format("the one around {:.6g},{:.6g},{:.6g}", part.point[0], part.point[1],
                     part.point[2]);
}

// What is enclosed, and what is surprising about it. `oriented`: facets have an orientation.
void report_parts(Tool& tool, const SurfaceOptions& options, const Surface& surface, bool oriented,
                  const std::vector<FilledPart>& parts) {
  if (parts.empty()) return;
  Json& facts = tool.facts()["parts"] = Json::array();
  std::vector<FilledPart> turned, nested;
  std::size_t empty = 0;
  for (const FilledPart& part : parts) {
    facts.push_back({{"point", part.point}, {"volume", part.volume}});
    if (part.winding) facts.back()["winding"] = *part.winding;
    if (part.region) facts.back()["region"] = *part.region;
    empty += part.region ? 0 : 1;
    if (part.region && part.winding < 0) turned.push_back(part);
    if (part.region && part.winding > 1) nested.push_back(part);
  }
  if (parts.size() > 1)
    tool.note(fmt::format("the surface encloses {} parts: {} are filled, {} stay empty",
                          parts.size(), parts.size() - empty, empty));
  if (!nested.empty())
    tool.note(
        fmt::format("{} parts are in shells within shells that are oriented alike, and are "
                    "filled: {}",
                    nested.size(), listed(nested, options.max_ids, at_point)));
  if (!turned.empty())
    tool.warn(
        fmt::format("{} parts are in shells that are oriented inwards, and are filled all "
                    "the same: {}",
                    turned.size(), listed(turned, options.max_ids, at_point)));
  if (parts.size() < 2 || !oriented || parts.front().winding) return;
  tool.warn(
      fmt::format("{} edges have triangles that are oriented against one another: orientation does "
                  "not decide what is empty, and all parts without a --hole are filled",
                  surface_orientation(surface).opposed_edges));
}

}  // namespace

ZooFile mesh_of_surface(Tool& tool, const std::string& input, const SurfaceOptions& options) {
  EmptyParts empty;
  for (const std::string& hole : options.holes) empty.around.push_back(point_of(hole));
  formats::SurfaceReading reading =
      tool.timed("read", [&] { return formats::read_surface(input); });
  for (const std::string& note : reading.notes) tool.note(note);
  if (options.weld) weld(tool, *options.weld, reading.surface);
  const Surface& surface = reading.surface;
  tool.facts()["surface"] = {{"points", surface.points.size()}, {"facets", surface.facets.size()}};
  // of facets with several polygons and holes TetGen itself tells
  if (surface.triangulated()) {
    SurfaceDefects defects = tool.timed("check", [&] { return find_surface_defects(surface); });
    if (reading.inner_facets) defects.open.clear();
    judge(tool, input, options, defects);
  }
  // facets of TetGen's files have no orientation: their holes are listed
  empty.by_orientation = !reading.inner_facets;
  try {
    FilledSurface filled = tool.timed("mesh", [&] {
      return as_option("--", [&] { return fill_surface(surface, options.meshing, empty); });
    });
    report_parts(tool, options, surface, empty.by_orientation, filled.parts);
    return {std::move(filled.mesh), {}};
  } catch (const JudgementError& e) {
    throw JudgementError(fmt::format("{}: {}", input, e.what()));
  }
}

}  // namespace hiac::tools

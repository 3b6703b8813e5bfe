#include "hiac/tetrahedralize/meshing/surface_meshing.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#define TETLIBRARY
#include <tetgen.h>

#include "hiac/base/error.hpp"
#include "hiac/base/process/child_process.hpp"
#include "hiac/geometry/predicates.hpp"
#include "hiac/tetrahedralize/enclosed_parts.hpp"

namespace hiac {
namespace {

// Allocated with new[], as TetGen deletes its arrays itself.
REAL* copied(const std::vector<std::array<double, 3>>& points) {
  auto* values = new REAL[3 * std::max<std::size_t>(points.size(), 1)];
  for (std::size_t i = 0; i < points.size(); ++i) std::ranges::copy(points[i], values + 3 * i);
  return values;
}

void fill_facet(const Facet& from, tetgenio::facet& to) {
  tetgenio::init(&to);
  to.numberofpolygons = static_cast<int>(from.polygons.size());
  to.polygonlist = new tetgenio::polygon[from.polygons.size()];
  for (std::size_t k = 0; k < from.polygons.size(); ++k) {
    tetgenio::polygon& polygon = to.polygonlist[k];
    tetgenio::init(&polygon);
    polygon.numberofvertices = static_cast<int>(from.polygons[k].size());
    polygon.vertexlist = new int[from.polygons[k].size()];
    std::ranges::transform(from.polygons[k], polygon.vertexlist,
                           [](std::uint32_t corner) { return static_cast<int>(corner); });
  }
  to.numberofholes = static_cast<int>(from.holes.size());
  if (!from.holes.empty()) to.holelist = copied(from.holes);
}

void fill(const Surface& surface, tetgenio& in) {
  in.firstnumber = 0;
  in.numberofpoints = static_cast<int>(surface.points.size());
  in.pointlist = copied(surface.points);
  in.numberoffacets = static_cast<int>(surface.facets.size());
  in.facetlist = new tetgenio::facet[surface.facets.size()];
  for (std::size_t f = 0; f < surface.facets.size(); ++f)
    fill_facet(surface.facets[f], in.facetlist[f]);
  in.numberofholes = static_cast<int>(surface.holes.size());
  if (!surface.holes.empty()) in.holelist = copied(surface.holes);
  in.numberofregions = static_cast<int>(surface.regions.size());
  if (!surface.regions.empty()) in.regionlist = new REAL[5 * surface.regions.size()];
  for (std::size_t r = 0; r < surface.regions.size(); ++r) {
    const Region& region = surface.regions[r];
    std::ranges::copy(region.point, in.regionlist + 5 * r);
    in.regionlist[5 * r + 3] = region.attribute;
    in.regionlist[5 * r + 4] = region.max_volume;
  }
}

std::string switches(const Surface& surface, const SurfaceMeshing& how) {
  std::string text = "pQ";
  if (how.quality) text += fmt::format("q{}", *how.quality);
  const bool bounded =
      std::ranges::any_of(surface.regions, [](const Region& r) { return r.max_volume > 0; });
  if (bounded) text += "a";
  if (how.max_volume) text += fmt::format("a{:.17f}", *how.max_volume);
  if (how.preserve_surface) text += "Y";
  return text + "A";
}

// Translates the codes that terminatetetgen() of TetGen 1.5 throws.
[[noreturn]] void fail(int code) {
  switch (code) {
    case 1:
      throw Error(ExitCode::internal, "TetGen: out of memory");
    case 3:
      throw JudgementError("the surface intersects itself (found by TetGen)");
    case 4:
      throw JudgementError("the surface has a feature too small for TetGen's arithmetic");
    case 5:
      throw JudgementError("the surface has two facets too close to one another for TetGen");
    case 10:
      throw JudgementError(
          "TetGen cannot use the surface (its facets are not planar, or not "
          "connected as it needs them)");
    default:
      throw Error(ExitCode::internal, fmt::format("TetGen failed (code {})", code));
  }
}

// TetGen's result as the child process returns it.
struct Answer {
  int code = 0;  // the code that terminatetetgen() threw, or 0
  std::vector<double> xyz;
  std::vector<NodeId> nodes;
  std::vector<double> regions;  // of the tetrahedra
};

template <typename T>
void append(const std::vector<T>& values, std::string& bytes) {
  const std::uint64_t count = values.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

// Reads what `append` wrote; returns false if the bytes end before.
template <typename T>
bool take(std::string_view& bytes, std::vector<T>& values) {
  std::uint64_t count = 0;
  if (bytes.size() < sizeof count) return false;
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes.remove_prefix(sizeof count);
  if (bytes.size() / sizeof(T) < count) return false;
  values.resize(count);
  std::memcpy(values.data(), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
  return true;
}

std::string run_tetgen(const Surface& surface, const SurfaceMeshing& how) {
  tetgenio in, out;
  fill(surface, in);
  std::string text = switches(surface, how);
  std::vector<int> code{0};
  try {
    tetrahedralize(text.data(), &in, &out);
  } catch (const int thrown) {
    code[0] = thrown;
  }
  std::string bytes;
  append(code, bytes);
  if (code[0] != 0) return bytes;
  const auto count = static_cast<std::size_t>(out.numberoftetrahedra);
  append(std::vector<double>(out.pointlist, out.pointlist + 3 * out.numberofpoints), bytes);
  append(std::vector<NodeId>(out.tetrahedronlist, out.tetrahedronlist + 4 * count), bytes);
  std::vector<double> regions;
  if (const auto width = static_cast<std::size_t>(out.numberoftetrahedronattributes); width > 0)
    for (std::size_t cell = 0; cell < count; ++cell)
      regions.push_back(out.tetrahedronattributelist[cell * width]);
  append(regions, bytes);
  return bytes;
}

Answer ask_tetgen(const Surface& surface, const SurfaceMeshing& how) {
  const auto bytes = in_child_process([&] { return run_tetgen(surface, how); });
  if (!bytes)
    throw JudgementError(
        "TetGen broke down over the surface (facets that intersect, or are not "
        "planar, may be the cause)");
  Answer answer;
  std::string_view rest = *bytes;
  std::vector<int> code;
  const bool told = take(rest, code) && code.size() == 1;
  if (told && code[0] != 0) fail(code[0]);
  if (!told || !take(rest, answer.xyz) || !take(rest, answer.nodes) ||
      !take(rest, answer.regions) || 4 * answer.regions.size() != answer.nodes.size())
    throw Error(ExitCode::internal, "TetGen's answer is incomplete");
  return answer;
}

ZooMesh mesh_from(const Surface& surface, Answer&& answer) {
  ZooMesh mesh;
  mesh.xyz = std::move(answer.xyz);
  const std::size_t count = answer.nodes.size() / 4;
  std::vector<std::uint64_t> elems{0};
  for (std::size_t cell = 0; cell < count; ++cell) {
    const auto corners = std::span(answer.nodes).subspan(4 * cell, 4);
    const auto at = [&](std::size_t k) { return mesh.position(corners[k]); };
    if (orientation(at(0), at(1), at(2), at(3)) < 0) std::swap(corners[2], corners[3]);
    elems.push_back(4 * (cell + 1));
  }
  mesh.nodes = std::move(answer.nodes);
  mesh.elems = std::move(elems);
  mesh.kinds = std::vector<CellKind>(count, CellKind::tetrahedron4);
  if (surface.regions.empty()) number_parts(mesh, surface.points, answer.regions);
  mesh.fields.push_back({kRegionField, "", FieldLocation::cell, 1, std::move(answer.regions)});
  return mesh;
}

}  // namespace

ZooMesh mesh_surface(const Surface& surface, const SurfaceMeshing& how) {
  constexpr std::size_t kMost = std::size_t{1} << 30;  // TetGen counts in int
  if (surface.points.size() > kMost || surface.facets.size() > kMost)
    throw InputError("surface",
                     fmt::format("too many points or facets (at most {} expected)", kMost));
  Answer answer = ask_tetgen(surface, how);
  if (answer.nodes.empty())
    throw JudgementError("the surface encloses nothing (a closed surface expected)");
  return mesh_from(surface, std::move(answer));
}

}  // namespace hiac

#include "hiac/tetrahedralize/meshing/fill_surface.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/tetrahedralize/enclosed_parts.hpp"
#include "hiac/tetrahedralize/winding_number.hpp"

namespace hiac {
namespace {

using Position = std::array<double, 3>;

std::vector<FilledPart> parts_of(const ZooMesh& mesh) {
  std::vector<FilledPart> parts;
  for (const EnclosedPart& part : enclosed_parts(mesh))
    parts.push_back({part.point, part.volume, std::nullopt, static_cast<int>(parts.size() + 1)});
  return parts;
}

// The place in the list of the part around a point.
std::size_t part_around(const ZooMesh& mesh, const Position& point) {
  const std::vector<std::uint32_t> parts = parts_at(mesh, point);
  if (parts.size() == 1) return parts.front() - 1;
  throw UsageError(fmt::format(
      "hole {},{},{}: the point {} (a point inside a part that the surface "
      "encloses expected)",
      point[0], point[1], point[2], parts.empty() ? "is outside" : "is on the surface"));
}

// Numbers those that are not empty; returns how many these are.
int number_filled(std::vector<FilledPart>& parts) {
  int count = 0;
  for (FilledPart& part : parts)
    if (part.region) part.region = ++count;
  return count;
}

}  // namespace

FilledSurface fill_surface(const Surface& surface, const SurfaceMeshing& how,
                           const EmptyParts& empty) {
  SurfaceOrientation orientation;
  if (empty.by_orientation) orientation = surface_orientation(surface);
  const bool oriented = empty.by_orientation && orientation.opposed_edges == 0;
  const auto wind = [&](std::vector<FilledPart>& parts) {
    if (!oriented) return;
    for (FilledPart& part : parts) part.winding = winding_number(surface, part.point);
  };
  const bool own_regions = !surface.regions.empty();
  if (empty.around.empty() && (!oriented || orientation.single_shell)) {
    FilledSurface filled{mesh_surface(surface, how), {}};
    if (!own_regions) filled.parts = parts_of(filled.mesh);
    wind(filled.parts);
    return filled;
  }

  // a mesh without further points shows the parts; the tetrahedra asked for fill those that stay
  Surface chosen = surface;
  chosen.regions.clear();
  FilledSurface filled{mesh_surface(chosen, {std::nullopt, std::nullopt, how.preserve_surface}),
                       {}};
  std::vector<FilledPart> parts = parts_of(filled.mesh);
  wind(parts);
  for (FilledPart& part : parts)
    if (part.winding == 0) part.region.reset();
  for (const Position& point : empty.around) parts[part_around(filled.mesh, point)].region.reset();
  const auto filled_count = static_cast<std::size_t>(number_filled(parts));
  if (filled_count == 0)
    throw JudgementError("all parts that the surface encloses are holes: nothing is left to fill");
  chosen.regions = surface.regions;
  for (const FilledPart& part : parts)
    if (!part.region) chosen.holes.push_back(part.point);
  if (filled_count < parts.size() || how.quality || how.max_volume || own_regions)
    filled.mesh = mesh_surface(chosen, how);
  if (!own_regions) filled.parts = std::move(parts);
  return filled;
}

}  // namespace hiac

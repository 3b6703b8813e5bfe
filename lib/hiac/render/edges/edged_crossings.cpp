#include "hiac/render/edges/edged_crossings.hpp"

#include <cmath>

#include "hiac/mesh/parted/whole_corners.hpp"

namespace hiac {
namespace {

std::array<std::uint64_t, 4> numbered_corners(const ZooMesh& mesh, CellId cell, std::uint8_t face,
                                              std::span<const std::uint64_t> numbers) {
  if (!numbers.empty()) return whole_corners(mesh, numbers, cell, face);
  std::array<std::uint64_t, 4> corners;
  corners.fill(kNoCorner);
  const ShapeFace& shape = topology_of(mesh.kinds[cell]).faces[face];
  for (std::size_t k = 0; k < shape.corner_count; ++k)
    corners[k] = mesh.cell_nodes(cell)[shape.corners[k]];
  return corners;
}

}  // namespace

void EdgedCrossings::add(const Frame& frame, CellId cell, const CellCrossing& ray,
                         const TileRect& tile, double front, double back,
                         std::span<const std::uint64_t> numbers) {
  const auto stop = [&](double t, std::uint8_t face, const std::array<double, 3>& reference) {
    return EdgeStop{t, face, numbered_corners(frame.mesh, cell, face, numbers), reference};
  };
  const CellKind kind = frame.mesh.kinds[cell];
  EdgedCrossing& way = rays.emplace_back(EdgedCrossing{
      static_cast<std::uint32_t>(tile.index(ray.x, ray.y)), EdgedCrossing::kPlanar, kind,
      0.5 * (ray.front + ray.back), stop(front, ray.front_face, ray.front_reference),
      stop(back, ray.back_face, ray.back_reference)});
  if (std::isnan(ray.front_reference[0]) && std::isnan(ray.back_reference[0])) return;
  if (shaped != cell) {
    shapes.push_back({kind, relative_positions(frame.mesh, cell, frame.projector)});
    shaped = cell;
  }
  way.shape = static_cast<std::uint32_t>(shapes.size() - 1);
}

bool lies_on(const EdgedCrossings& crossings, const EdgedCrossing& ray, const EdgeStop& stop,
             const EdgePlace<std::uint64_t>& place, const Projector& projector,
             const TileRect& tile) {
  if (!lies_on_face(stop.corners, place)) return false;
  if (std::isnan(stop.reference[0])) return true;
  return is_one_side(projector, crossings.shapes[ray.shape], stop.face, stop.reference,
                     reference_on(ray.kind, stop.face, stop.corners, place), tile.column(ray.pixel),
                     tile.row(ray.pixel));
}

}  // namespace hiac

#include "hiac/render/cells/cell_scan.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/cells/cell_scan.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/render/cells/scan_beside_eye-inl.hpp"
#include "hiac/render/cells/screen_scan-inl.hpp"

// Compiled once for every instruction set, although little of it is vectorized: where the
// tetrahedron kernel uses fused operations, this code must use them too.

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {

void scan_projected(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                    const TileRect& tile, CrossingRuns* runs, std::vector<CellCrossing>& crossings,
                    const PixelMask* only) {
  ScreenScan(frame, surface, curved, tile, runs, only).scan(crossings);
}

void scan_beside_eye(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                     const TileRect& tile, std::vector<CellCrossing>& crossings,
                     const PixelMask* only) {
  LineScan(frame, surface, curved, tile, only).scan(crossings);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(scan_projected);
HWY_EXPORT(scan_beside_eye);

void scan_projected_cell(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                         const TileRect& tile, std::vector<CellCrossing>& crossings,
                         const PixelMask* only) {
  HWY_DYNAMIC_DISPATCH(scan_projected)(frame, surface, curved, tile, nullptr, crossings, only);
}

void scan_projected_runs(const Frame& frame, const CellSurface& surface, const TileRect& tile,
                         CrossingRuns& runs, std::vector<CellCrossing>& others) {
  HWY_DYNAMIC_DISPATCH(scan_projected)(frame, surface, nullptr, tile, &runs, others, nullptr);
}

void scan_cell_beside_eye(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                          const TileRect& tile, std::vector<CellCrossing>& crossings,
                          const PixelMask* only) {
  HWY_DYNAMIC_DISPATCH(scan_beside_eye)(frame, surface, curved, tile, crossings, only);
}

bool is_projectable(const Frame& frame, const CellSurface& surface) {
  return std::none_of(surface.nodes.begin(),
                      surface.nodes.begin() + static_cast<std::ptrdiff_t>(surface.corner_count),
                      [&](NodeId node) { return std::isnan(frame.nodes[node].depth); });
}

void scan_cell(const Frame& frame, CellId cell, const TileRect& tile,
               std::vector<CellCrossing>& crossings, const PixelMask* only) {
  const CellSurface surface = cell_surface(frame.mesh.kinds[cell], frame.mesh.cell_nodes(cell));
  const auto scan = is_projectable(frame, surface) ? scan_projected_cell : scan_cell_beside_eye;
  if (!frame.is_curved(cell)) return scan(frame, surface, nullptr, tile, crossings, only);
  CurvedFaces curved(frame, cell, surface);
  scan(frame, surface, &curved, tile, crossings, only);
}

}  // namespace hiac
#endif

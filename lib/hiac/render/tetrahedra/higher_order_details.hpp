#pragma once

#include <array>
#include <optional>

#include "hiac/element/field_along_ray.hpp"
#include "hiac/render/bounds/cell_errors.hpp"
#include "hiac/render/cells/volume_along_ray.hpp"
#include "hiac/render/pixels/pixel_details.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// Details of the segments in quadratic and cubic tetrahedra, if channels are requested. The kernel
/// that draws the segments (higher_order_kernel.hpp) computes no bounds; for the channel `error`
/// each segment is integrated again by itself, with bounds, and the difference of the two results
/// is added to them.
class HigherOrderDetails {
 public:
  /// The frame must outlive this object. Needs Frame::with_details.
  HigherOrderDetails(const Frame& frame, const TileRect& tile);

  /// Selects a cell that the kernel draws.
  void enter(CellId cell);

  /// A segment as drawn by the kernel: ray parameters, world length per unit of these, the
  /// transparency in front, and the segment's radiance.
  struct Segment {
    int x, y;
    double front, back, scale, visible;
    PlainRadiance radiance;
  };
  [[nodiscard]] SegmentDetails describe(const Segment& segment);

 private:
  const Frame& frame_;
  VolumeAlongRay volume_;
  CellErrors errors_;
  // of the current cell
  std::array<CellMap::Point, CellMap::kMostNodes> nodes_{};
  std::optional<CellMap> map_;
  std::optional<FieldAlongRay> field_;
};

}  // namespace hiac

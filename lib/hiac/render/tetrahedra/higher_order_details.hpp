#pragma once

#include <array>
#include <optional>

#include "hiac/element/field_along_ray.hpp"
#include "hiac/render/bounds/cell_errors.hpp"
#include "hiac/render/cells/volume_along_ray.hpp"
#include "hiac/render/pixels/pixel_details.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// What the segments in quadratic and cubic tetrahedra tell of themselves where channels are asked
/// for. The kernel, which claims no bounds, draws them (higher_order_kernel.hpp); for the channel
/// `error` each is integrated once more by itself, with bounds, and how far both are apart is added
/// to these.
class HigherOrderDetails {
 public:
  /// The frame must outlive it. Needs Frame::with_details.
  HigherOrderDetails(const Frame& frame, const TileRect& tile);

  /// Takes a cell that the kernel is for.
  void enter(CellId cell);

  /// A segment as the kernel has drawn it: ray parameters, world length per unit of these, the
  /// transparency in front, and what the segment does to the light.
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
  // of the cell at hand
  std::array<CellMap::Point, CellMap::kMostNodes> nodes_{};
  std::optional<CellMap> map_;
  std::optional<FieldAlongRay> field_;
};

}  // namespace hiac

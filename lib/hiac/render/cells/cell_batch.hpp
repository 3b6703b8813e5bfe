#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "hiac/geometry/inverse_map.hpp"
#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/cells/cell_segments.hpp"
#include "hiac/render/cells/volume_along_ray.hpp"

namespace hiac {

/// Segments of one cell that are integrated, or cut by surfaces, many at a time.
class CellBatch {
 public:
  /// `volume` is that of the current cell. Both arguments must outlive the batch.
  CellBatch(const TileTarget& to, const VolumeAlongRay& volume) : to_(to), volume_(volume) {}

  /// Selects a cell; `curved`: whether it has curved faces. `nodes`: its relative_positions. The
  /// nodes and the map must outlive every later call for this cell.
  void enter(CellKind kind, bool curved, std::span<const CellMap::Point, CellMap::kMostNodes> nodes,
             const CellMap& map);

  [[nodiscard]] CellSegments& segments() { return segments_; }
  [[nodiscard]] const CellSegments& segments() const { return segments_; }
  /// Empties the batch and reserves space for `most` segments.
  void start(std::size_t most) { segments_.start(most, curved_); }
  /// Appends the visible segments of runs (collect_runs).
  void append_runs(const CrossingRuns& runs);
  /// Appends the segments of those crossings that are visible and have a length above 0.
  void append_crossings(std::span<const CellCrossing> crossings);
  /// Appends the part of a crossing from `front` to `back`.
  void append(const CellCrossing& crossing, double front, double back);
  void integrate();

  /// The indices of the crossings that the last call of append_crossings appended.
  [[nodiscard]] const std::vector<std::size_t>& kept() const { return kept_; }
  [[nodiscard]] bool is_done(std::size_t k) const { return segments_.done[k] != 0; }
  [[nodiscard]] PlainRadiance radiance(std::size_t k) const {
    return {{segments_.red[k], segments_.green[k], segments_.blue[k]}, segments_.transparency[k]};
  }

 private:
  // The allowed error of a fully visible segment of one unit of the ray parameter.
  [[nodiscard]] double allowed() const { return volume_.allowed_error(0, 1, 1); }

  TileTarget to_;
  const VolumeAlongRay& volume_;
  CellKind kind_{};
  bool curved_ = false;
  std::span<const CellMap::Point> nodes_;
  const CellMap* map_ = nullptr;
  CellSegments segments_;
  std::vector<std::size_t> kept_;
};

}  // namespace hiac

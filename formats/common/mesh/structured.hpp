#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// A structured block: its numbers of points along i, j, k; i is fastest.
struct StructuredBlock {
  std::array<std::size_t, 3> points{};

  /// Throws InputError(subject, ...) when there are more than `limit` points.
  [[nodiscard]] std::size_t point_count() const { return points[0] * points[1] * points[2]; }
  /// 0 when the block is a surface or a line.
  [[nodiscard]] std::size_t cell_count() const;
};

/// The block with the extents that a file declares. Throws InputError(subject, ...) when one is not
/// positive, or when there are more than `limit` points, the most that the file can hold.
StructuredBlock structured_block(std::span<const std::int64_t> extents, std::size_t limit,
                                 const std::string& subject);

/// Adds the block's bricks, whose points are (or will be) numbered from `first_point` on, and the
/// block under `name` unless that is empty. Bricks with a hidden point are left out: `hidden` has a
/// flag for every point of the block, or is empty. Returns which of the block's cells were added,
/// in order; empty means all. A surface (one point along an axis) adds no cell.
std::vector<std::size_t> add_bricks(ForeignMesh& mesh, const StructuredBlock& block,
                                    std::size_t first_point, const std::vector<bool>& hidden,
                                    const std::string& name);

}  // namespace hiac::formats

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/frame/projection.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/mesh/cell_kind.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/cells/face_normals.hpp"
#include "hiac/render/edges/edge_place.hpp"

namespace hiac {

/// One end of a ray's way through a cell.
struct EdgeStop {
  double t;  ///< ray parameter
  std::uint8_t face;
  std::array<std::uint64_t, 4> corners;  ///< of the face, in its own order
  std::array<double, 3> reference;       ///< of the point if the face is curved, otherwise NaN
};

/// A ray's way through a cell on which edges may lie.
struct EdgedCrossing {
  /// No curved cell.
  static constexpr std::uint32_t kPlanar = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t pixel;  ///< index into the tile's planes
  std::uint32_t shape;  ///< among the shapes if a face at either end is curved, or kPlanar
  CellKind kind;
  double middle;  ///< of the way: cells do not overlap, so it sorts them, whatever rounding does to
                  ///< the ends at which they touch
  EdgeStop front, back;
};

/// Ways of a tile's rays, of which the order is found later: in groups of cells, and among parts of
/// a mesh.
struct EdgedCrossings {
  std::vector<EdgedCrossing> rays;
  std::vector<MappedCell> shapes;  ///< of curved cells
  std::optional<CellId> shaped;    ///< the cell of the last of them

  /// Adds a ray's way through a cell of the frame's mesh, from `front` to `back`. `numbers`: of the
  /// mesh's nodes; empty where nodes are known by their own.
  void add(const Frame& frame, CellId cell, const CellCrossing& ray, const TileRect& tile,
           double front, double back, std::span<const std::uint64_t> numbers);
};

/// Whether a place on an edge is met at an end of a ray's way: it lies on the face there and, if
/// that is curved, the face does not bend back between.
bool lies_on(const EdgedCrossings& crossings, const EdgedCrossing& ray, const EdgeStop& stop,
             const EdgePlace<std::uint64_t>& place, const Projector& projector,
             const TileRect& tile);

}  // namespace hiac

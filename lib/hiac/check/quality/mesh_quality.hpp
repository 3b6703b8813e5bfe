#pragma once

#include <cstdint>
#include <vector>

#include "hiac/check/quality/cell_quality.hpp"
#include "hiac/check/quality/distribution.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The distribution of a figure over the cells of one kind; `least_at` and `largest_at` are cells.
struct FigureDistribution {
  QualityFigure figure;
  Distribution distribution;
};

/// The figures of the cells of one kind.
struct KindQuality {
  CellKind kind;
  std::uint64_t cells = 0;
  double volume = 0;  ///< the sum of the cells' volumes, world units cubed
  std::vector<FigureDistribution> figures;
};

/// Returns the figures of every kind that the mesh has, in the kinds' order. Histograms have fixed
/// edges, those of volumes are parts of
/// the magnitude of the kind's mean. `hand` as for quality_of.
///
/// Linear in the number of cells, in parallel, one figure at a time: 12 bytes a cell. The result
/// does not depend on the number of threads. Throws Cancelled.
std::vector<KindQuality> mesh_quality(const ZooMesh& mesh, int hand);

}  // namespace hiac

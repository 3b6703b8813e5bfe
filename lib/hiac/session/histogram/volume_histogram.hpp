#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/transfer_scale.hpp"

namespace hiac {

/// How much of a mesh's volume has which values of a field.
struct VolumeHistogram {
  std::vector<double> edges;        ///< of the bins, ascending
  std::vector<double> volumes;      ///< world units cubed; one less than edges
  std::array<double, 2> outside{};  ///< volume with values below and above all bins
  double without_value = 0;         ///< volume of the cells with a value that is not finite
};

/// The edges of `count` bins that divide [low, high] evenly, or evenly in the logarithm. low <
/// high, for the logarithm both positive; count is positive.
std::vector<double> bin_edges(double low, double high, std::size_t count, TransferScale scale);

/// Measures where a scalar field of a mesh lies in which bin: [edges[k], edges[k + 1]), the last
/// bin closed. `edges`: ascending, at least two.
///
/// Linear tetrahedra are exact (tetrahedron_shares.hpp), as are fields that are constant in cells.
/// Other cells are measured by tetrahedra between points at which their isoparametric map and field
/// are exact (cell_pieces.hpp says how many), scaled to the cell's volume; the error of the shares
/// falls with the square of the cells' size. Cells count by the magnitude of their volume, so that
/// all entries together are the mesh's volume.
///
/// The result does not depend on the number of threads.
VolumeHistogram volume_histogram(const ZooMesh& mesh, const Field& field,
                                 std::span<const double> edges);

}  // namespace hiac

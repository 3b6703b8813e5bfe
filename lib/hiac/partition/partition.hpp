#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Divides the cells of a mesh into parts of nearly equal weight (parted/cell_weight.hpp) that have
/// few faces in common, and returns the part of every cell. Cells that share a face are neighbours;
/// cells that touch across a gap are not. Every part has cells. The same mesh gives the same parts.
///
/// By METIS: G. Karypis, V. Kumar: A Fast and High Quality Multilevel Scheme for Partitioning
/// Irregular Graphs, SIAM J. Sci. Comput. 20 (1998) 359-392; its k-way method.
///
/// Throws UsageError when there are no or more parts than cells, InputError(subject, ...) when the
/// mesh has too many faces for METIS's numbers of 32 bits.
std::vector<std::uint32_t> partition_cells(const ZooMesh& mesh, std::size_t parts,
                                           const std::string& subject);

/// "METIS 5.1.0"
std::string partitioner_version();

}  // namespace hiac

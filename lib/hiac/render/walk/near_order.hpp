#pragma once

#include <cstdint>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The nodes and the cells of a mesh in an order in which those that are near one another in space
/// are so in memory.
struct NearOrder {
  std::vector<NodeId> nodes;  ///< along Morton's curve
  std::vector<CellId> cells;  ///< by the first of their nodes there
};

/// A node's place on Morton's curve through a cube that is cut into 1024 parts along each axis:
/// the bits of the three parts in turns, that of x being the lowest (G. M. Morton, "A Computer
/// Oriented Geodetic Data Base", 1966).
std::uint32_t morton_code(std::uint32_t x, std::uint32_t y, std::uint32_t z);

/// Sorts the nodes and the cells of a mesh. Nodes in one part of the cube, and cells with one first
/// node, keep the order that they have in the mesh. Takes n log n time for nodes, linear time for
/// cells; the result does not depend on the number of threads. Throws Cancelled.
NearOrder near_order(const ZooMesh& mesh);

/// The inverse of an order: number[order[n]] == n.
std::vector<std::uint32_t> numbers_in(const std::vector<std::uint32_t>& order);

}  // namespace hiac

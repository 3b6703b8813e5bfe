#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "tests/order/order_meshes.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {

/// How one cube of a mesh of blocks is made: of one brick, six tetrahedra, two prisms, six pyramids
/// or two 7-node wedges; and whether first halved along each axis, so that nodes hang in the middle
/// of its neighbours' faces.
struct Block {
  CellShape shape;
  bool halved = false;
};
using BlockAt = std::function<std::optional<Block>(int i, int j, int k)>;

/// n^3 cubes with sides of 4, each as `at` says, or none. Coordinates are integers, nodes at one
/// place are one node. Cubes of one shape match at their common faces: wedges are mirrored from
/// cube to cube for that.
ZooMesh blocks(int n, const BlockAt& at);

/// The same cells after a map that keeps every plane of a mesh of blocks a plane to the last bit:
/// cubes stretched along each axis by factors of their own, then everything mapped by a matrix of
/// small integers. Coordinates stay binary fractions of few bits.
ZooMesh distorted(const ZooMesh& blocks, std::uint64_t seed);

/// Eyes outside and inside of cells, on vertices, edges and faces, in their planes and in line with
/// them; parallel rays along axes, edges, face diagonals and anywhere: of random cells.
std::vector<NamedView> special_views(const ZooMesh& mesh, std::uint64_t seed);

/// How the nodes of a collapsed edge are stored.
enum class Collapse { coincident, merged };

/// A fan of sectors x rings x layers cells about the z axis, of which a quarter turn is missing: a
/// structured grid whose edges along the axis are collapsed into it, so that the innermost ring's
/// cells are triangular. `coincident`: all cells are bricks, and each sector has nodes of its own
/// on the axis, at the same place; `merged`: the innermost are prisms. Sides are planar to the last
/// bit.
ZooMesh collapsed_fan(int sectors, int rings, int layers, Collapse collapse);

/// n tetrahedra (long sticks) in a ring about the z axis, of radius about 1 and height `height`,
/// centred at the origin: seen along the axis, each lies over the next at a corner of a regular
/// polygon.
ZooMesh ring_of_sticks(int n, double height);

/// n^3 bricks of the unit cube, every inner node pushed along each axis by up to `amplitude` times
/// the bricks' size; nodes on the outside stay on it.
ZooMesh jittered_bricks(std::size_t n, double amplitude, std::uint64_t seed);

}  // namespace hiac::test

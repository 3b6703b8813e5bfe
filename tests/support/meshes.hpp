#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::test {

using Position = std::array<double, 3>;
using ScalarFunction = std::function<double(const Position&)>;

/// One cell to be put into a mesh.
struct Cell {
  CellKind kind;
  std::vector<NodeId> nodes;
};

ZooMesh make_mesh(const std::vector<Position>& positions, const std::vector<Cell>& cells);

/// What make_mesh made a mesh of.
std::vector<Position> positions_of(const ZooMesh& mesh);
std::vector<Cell> cells_of(const ZooMesh& mesh);

/// Adds fields of every location, "n", "c" and "k", of 2, 3 and 1 components, whose values count
/// from 0 and so tell where they come from.
void add_counted_fields(ZooMesh& mesh);

/// Adds a scalar field at the nodes: the function's value there.
void add_node_field(ZooMesh& mesh, const std::string& name, const ScalarFunction& function);

/// Delaunay tetrahedra of random points of the unit cube, with points on its faces, edges and
/// corners so that the cube is filled. Slivers included, as Delaunay makes them.
ZooMesh random_delaunay(std::size_t points, std::uint64_t seed);

/// n^3 cubes of the unit cube; of bricks, or each cut in six tetrahedra around a diagonal, in two
/// prisms, or in six pyramids.
enum class Cut { bricks, tetrahedra, prisms, pyramids };
ZooMesh structured(std::size_t n, Cut cut);

/// The cells of a mesh that `keep` wants, by centroid and number; nodes stay as they are.
ZooMesh keep_cells(const ZooMesh& mesh,
                   const std::function<bool(const Position& centroid, CellId cell)>& keep);

/// Both meshes in one, sharing no node.
ZooMesh side_by_side(const ZooMesh& a, const ZooMesh& b);

/// Every position replaced by `map` of it; all else stays.
ZooMesh moved(const ZooMesh& mesh, const std::function<Position(const Position&)>& map);

/// A smooth field between 0 and 1 with hills and hollows.
double smooth_field(const Position& p);

}  // namespace hiac::test

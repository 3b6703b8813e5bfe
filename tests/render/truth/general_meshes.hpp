#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hiac/render/engine.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {

/// An affine map, far from orthogonal.
Position sheared(const Position& p);

/// A projective map of the unit cube: planes stay planes, bricks become frusta and worse.
Position tapered(const Position& p);

/// Moves points inside the unit cube by up to `by` in every coordinate, at random: quadrilaterals
/// between them are no longer planar. Points of the cube's surface stay.
Position warped(const Position& p, double by);

/// Moves points inside the unit cube smoothly: nodes of higher order then bend edges and faces.
Position bent(const Position& p);

/// Moves points smoothly by up to `by` in every coordinate, also those of the unit cube's surface:
/// bilinear faces become twisted, nodes of higher order bend edges and faces, seen from outside,
/// too.
Position rippled(const Position& p, double by);

/// One cell with these corners and straight edges; its nodes are numbered as the kind's.
ZooMesh one_cell(CellKind kind, const std::vector<Position>& corners);

/// Two 7-node wedges that share a quadrilateral face, as large as the unit cube.
ZooMesh two_wedges();

/// The unit cube as n x n x n cubes of two wedges each, mirrored from cube to cube so that they are
/// conforming.
ZooMesh wedge_grid(std::size_t n);

/// n x n columns of the unit cube: prisms below; above them transition cubes, each two tetrahedra
/// and five pyramids; above these bricks. Conforming, with every pair of these kinds that can share
/// a face sharing one.
ZooMesh mixed_columns(std::size_t n);

/// A linear mesh with nodes added on straight edges (and in the faces of cubic tetrahedra), shared
/// by the cells around them. Without fields.
ZooMesh of_order(const ZooMesh& mesh, CellOrder order);

/// All fifteen kinds of cells.
std::vector<CellKind> all_kinds();

/// The unit cube cut into straight-edged cells of one kind, `per_edge` cubes to an edge; of wedges
/// two_wedges(). Without fields.
ZooMesh straight_mesh(CellKind kind, std::size_t per_edge = 1);

/// straight_mesh(kind) rippled by as much as keeps its cells valid, 0.06 at most.
ZooMesh curved_mesh(CellKind kind);

/// straight_mesh() bent to an arch of so many degrees around the y axis, with the inner radius 0.5:
/// faces across it that a ray meets twice.
ZooMesh arch(CellKind kind, double degrees, std::size_t per_edge = 1);

/// A field of random numbers in [0, 1].
void add_random_field(ZooMesh& mesh, const std::string& name, FieldLocation location,
                      std::uint64_t seed);

/// A scene that looks at the unit cube from outside, with a few bends in its transfer functions of
/// the field "f", to a tolerance of 1e-13.
Scene cube_scene(Projection projection, std::uint32_t width, std::uint32_t height);

/// Extinction 1.5 and one colour everywhere.
void make_uniform(Scene& scene);

/// The exact order for the scene's camera.
VisibilityOrder sorted(const ZooMesh& mesh, const Scene& scene);

/// Sorts and renders.
RenderResult draw(const ZooMesh& mesh, const Scene& scene);

}  // namespace hiac::test

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/preview/context.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::test {

/// Largest error of any channel of any pixel of some pictures, and the largest root mean square
/// error of one of them.
struct SweepError {
  double largest = 0, rms = 0;
  void include(const SweepError& other);
};

/// A mesh whose pictures by the preview's method `exact` were compared with the accurate engine's.
struct SweepRow {
  std::string name;
  std::size_t cells = 0;
  SweepError single, fine;  ///< single and double precision along rays
  std::size_t pictures = 0;
  std::size_t empty = 0;      ///< pictures that show nothing, by both engines
  std::size_t in_groups = 0;  ///< pictures that are not compared: cells in visibility cycles
};

/// Draws the scene from all cameras by both engines in the exact order. `invalid`: cells that both
/// leave out. The mesh is of linear tetrahedra.
SweepRow sweep(const preview::Context& context, const std::string& name, const ZooMesh& mesh,
               const std::vector<Scene>& scenes, const std::vector<CellId>& invalid = {});

/// A row of the table for docs/preview.md; `first`: behind the table's head.
void print_row(const SweepRow& row, bool first);

/// Five views of a mesh: parallel, in perspective and with either glow, along two of its axes, and
/// from a place inside; with every other glow too where `both_glows`.
std::vector<Scene> views_of(const ZooMesh& mesh, const Scene& scene, bool both_glows);

}  // namespace hiac::test

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"
#include "tests/render/truth/curved_cell_truth.hpp"

namespace hiac::test {

/// The picture of a mesh's skin by brute force, in extended precision: the faces of every cell
/// against every ray (CurvedCellTruth, also for planar faces), those that only one cell has, sorted
/// by depth and shaded by the book. A uniform medium lies between them, if the scene has one: the
/// first value of its transfer functions counts. Shares nothing with the engine but the shape
/// functions and the topology.
class SkinTruth {
 public:
  using Real = long double;

  /// Both must outlive it. The scene has a skin.
  SkinTruth(const ZooMesh& mesh, const Scene& scene);

  /// Red, green, blue without background, and alpha; not numbers where a crossing was missed.
  [[nodiscard]] std::array<Real, 4> pixel(std::uint32_t x, std::uint32_t y) const;

 private:
  using Vec = std::array<Real, 3>;
  struct Cell {
    CellKind kind;
    CurvedCellTruth surface;
    std::vector<Vec> nodes;     // relative to the eye
    std::vector<Real> values;   // of the skin's field
    std::vector<bool> on_skin;  // of every face
  };
  struct Met {
    Real t;
    const Cell* cell;
    std::size_t face;
    Vec reference;
  };

  [[nodiscard]] std::vector<Real> values_of(CellId cell) const;
  [[nodiscard]] static std::size_t face_at(CellKind kind, const Vec& reference);
  [[nodiscard]] Isosurface look_at(const Met& met) const;

  const ZooMesh& mesh_;
  const Scene& scene_;
  Vec eye_, right_, up_, forward_;
  Real per_pixel_;
  std::vector<Cell> cells_;  // with faces of the skin
};

}  // namespace hiac::test

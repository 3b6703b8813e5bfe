#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"
#include "tests/render/truth/chebyshev_series.hpp"
#include "tests/render/truth/curved_cell_truth.hpp"
#include "tests/render/truth/volume_truth.hpp"

namespace hiac::test {

/// The pictures that exact arithmetic would make of meshes of any cells, in extended precision (64
/// bits) and fast enough for millions of pixels.
///
/// In the camera's frame every cell with planar faces (nodes off their places by no more than 1e-12
/// of its size) is clipped to the ray by the planes of its faces (of quadrilaterals: through their
/// centre, along their diagonals); of others rays cross the parametric faces (CurvedCellTruth).
/// Along a segment the fields are polynomials: linear in linear tetrahedra; in other cells as many
/// Chebyshev interpolants as it takes to have them to 1e-18 of their values (in curved cells
/// 1e-16), by Newton's inverse map from many places. Segments are cut where transfer functions bend
/// or jump and at isosurfaces; VolumeTruth has the light of the pieces. Shares nothing with the
/// engine but the shape functions and the definitions of transfer functions and topology.
class SceneTruth {
 public:
  using Real = long double;
  using Vec = std::array<Real, 3>;

  /// Both must outlive it. Integration "exact", no splats.
  SceneTruth(const ZooMesh& mesh, const Scene& scene);

  /// Red, green, blue without background, and transparency; not numbers where a crossing of a
  /// curved face was missed.
  [[nodiscard]] std::array<Real, 4> pixel(std::uint32_t x, std::uint32_t y) const;

 private:
  using NodeValues = std::array<Real, kMaxNodesPerCell>;
  struct Plane {  // inside where normal . p <= offset
    Vec normal;
    Real offset;
  };
  struct RoughPlane {  // the same, rounded
    std::array<double, 3> normal;
    double offset;
  };
  struct Cell {
    CellKind kind{};
    std::size_t count = 0;
    std::array<Vec, kMaxNodesPerCell> nodes{};  // camera frame
    std::vector<Plane> planes;
    std::vector<RoughPlane> rough_planes;
    std::vector<NodeValues> fields;
    std::vector<std::uint8_t> constant;
    // of tetrahedra: gradient[k] . p + value[k] is corner k's barycentric coordinate
    std::array<Vec, 4> gradient{};
    std::array<Real, 4> value{};
    std::optional<CurvedCellTruth> curved;
    Real size = 0;  // of its nodes, from the first
  };
  struct Ray {
    Vec origin, direction;  // camera frame; along the view direction by 1
    Real from, to, unit;    // world length per unit
  };
  // Where a ray is in a cell; `guess`: reference coordinates near its begin.
  struct Segment {
    const Cell* cell;
    Real from, to;
    Vec guess;
  };
  // A stretch of a ray in one cell on which fields are polynomials.
  struct Stretch {
    const Cell* cell;
    Real from, to;
    std::vector<ChebyshevSeries> fields;
    Vec guess;  // reference coordinates near its begin
  };
  using Light = VolumeTruth::Light;

  static bool is_curved(const Cell& cell);
  void add_cell(CellId id);
  void add_to_pixels(std::uint32_t cell);
  [[nodiscard]] Ray ray_of(std::uint32_t x, std::uint32_t y) const;
  static bool misses(const Cell& cell, const Ray& ray);
  [[nodiscard]] bool clip(const Cell& cell, const Ray& ray, Real& from, Real& to) const;
  void append_segments(const Cell& cell, const Ray& ray, std::vector<Segment>& segments) const;
  void append_stretches(const Cell& cell, const Ray& ray, Real from, Real to, int halvings,
                        Vec& guess, std::vector<Stretch>& stretches) const;
  static bool newton(const Cell& cell, const Vec& point, Vec& guess);
  void fields_at(const Cell& cell, const Vec& point, Vec& guess, std::vector<Real>& values) const;
  void add(const Stretch& stretch, const Ray& ray, Light& light) const;
  void add_piece(const Stretch& stretch, const Ray& ray, Real from, Real to, Light& light) const;
  void add_surface(const Stretch& stretch, const Ray& ray, std::size_t surface, Real t,
                   Light& light) const;

  const ZooMesh& mesh_;
  const Scene& scene_;
  Vec eye_, right_, up_, forward_;  // `eye_`: what the camera frame is relative to
  Real per_pixel_;                  // slope, or world units
  VolumeTruth volume_;
  std::size_t color_field_ = 0, extinction_field_ = 0;
  std::vector<std::size_t> surface_fields_;
  std::vector<Field> fields_;
  std::vector<Cell> cells_;
  std::vector<std::vector<std::uint32_t>> in_pixel_;  // cells that may be seen there
};

}  // namespace hiac::test

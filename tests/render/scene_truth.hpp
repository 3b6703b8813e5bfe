#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"
#include "tests/render/chebyshev_series.hpp"

namespace hiac::test {

/// The pictures that exact arithmetic would make of meshes of linear cells, in extended precision
/// (64 bits) and fast enough for millions of pixels.
///
/// In the camera's frame every cell is clipped to the ray by the planes of its faces (of
/// quadrilaterals: through their centre, along their diagonals). Along a segment the fields are
/// polynomials: linear in tetrahedra; in other cells as many Chebyshev interpolants as it takes to
/// have them to 1e-18 of their values, by Newton's inverse map. Segments are cut where transfer
/// functions bend or jump and at isosurfaces; on pieces the optical depth is a polynomial, and the
/// radiance is summed up by Gauss-Legendre rules that are exact to 1e-19. Shares nothing with the
/// engine but the shape functions and the definitions of transfer functions and topology.
class SceneTruth {
 public:
  using Real = long double;
  using Vec = std::array<Real, 3>;

  /// Both must outlive it. Integration "exact", no splats.
  SceneTruth(const ZooMesh& mesh, const Scene& scene);

  /// Red, green, blue without background, and transparency.
  [[nodiscard]] std::array<Real, 4> pixel(std::uint32_t x, std::uint32_t y) const;

 private:
  using Corners = std::array<Real, 8>;
  struct Plane {  // inside where normal . p <= offset
    Vec normal;
    Real offset;
  };
  struct RoughPlane {  // the same, rounded
    std::array<double, 3> normal;
    double offset;
  };
  struct Cell {
    CellKind kind;
    std::size_t count;
    std::array<Vec, 8> corners;  // camera frame
    std::vector<Plane> planes;
    std::vector<RoughPlane> rough_planes;
    std::vector<Corners> fields;
    std::vector<std::uint8_t> constant;
    // of tetrahedra: gradient[k] . p + value[k] is corner k's barycentric coordinate
    std::array<Vec, 4> gradient{};
    std::array<Real, 4> value{};
  };
  struct Ray {
    Vec origin, direction;  // camera frame; along the view direction by 1
    Real from, to, unit;    // world length per unit
  };
  // A stretch of a ray in one cell on which fields are polynomials.
  struct Stretch {
    const Cell* cell;
    Real from, to;
    std::vector<ChebyshevSeries> fields;
  };
  struct Light {
    std::array<Real, 3> rgb{};
    Real transparency = 1;
  };

  void add_cell(CellId id);
  void add_to_pixels(std::uint32_t cell);
  [[nodiscard]] Ray ray_of(std::uint32_t x, std::uint32_t y) const;
  static bool misses(const Cell& cell, const Ray& ray);
  [[nodiscard]] bool clip(const Cell& cell, const Ray& ray, Real& from, Real& to) const;
  void append_stretches(const Cell& cell, const Ray& ray, Real from, Real to, int halvings,
                        Vec& guess, std::vector<Stretch>& stretches) const;
  void fields_at(const Cell& cell, const Vec& point, Vec& guess, std::vector<Real>& values) const;
  void add(const Stretch& stretch, const Ray& ray, Light& light) const;
  void add_linear_piece(const Stretch& stretch, Real from, Real to, Real length,
                        Light& light) const;
  void add_piece(const Stretch& stretch, const Ray& ray, Real from, Real to, Light& light) const;
  void add_surface(const Stretch& stretch, const Ray& ray, std::size_t surface, Real t,
                   Light& light) const;

  const ZooMesh& mesh_;
  const Scene& scene_;
  Vec eye_, right_, up_, forward_;  // `eye_`: what the camera frame is relative to
  Real per_pixel_;                  // slope, or world units
  PiecewiseLinear<3> color_;
  PiecewiseLinear<1> extinction_;
  std::size_t color_field_ = 0, extinction_field_ = 0;
  std::vector<std::size_t> surface_fields_;
  std::vector<Field> fields_;
  std::vector<Cell> cells_;
  std::vector<std::vector<std::uint32_t>> in_pixel_;  // cells that may be seen there
};

}  // namespace hiac::test

#pragma once

#include <array>
#include <span>
#include <vector>

#include "hiac/preview/methods/lit_surface.hpp"
#include "hiac/preview/methods/region_filler.hpp"
#include "hiac/preview/regions/polyhedron.hpp"
#include "hiac/preview/regions/projected_tetrahedron.hpp"
#include "hiac/preview/regions/sheets.hpp"
#include "hiac/preview/regions/slabs.hpp"

namespace hiac::preview {

/// The triangles of one cell after the other, for one thread (RegionFiller).
class CellTriangles {
 public:
  CellTriangles(const RegionFiller& filler, TriangleBuffer& triangles, RegionCounts& counts);

  void add(CellId cell);
  void finish() { counts_.uncut += slicer_.uncut(); }

 private:
  // A vertex of a polyhedron, or a point of its surface: what is affine on the screen.
  struct Attributes {
    double w;  // 1 / t; 1 in parallel projection
    double tau_w;
    std::array<double, 3> color_w;
  };
  // A tetrahedron of the mesh.
  struct Cell {
    CellId id;
    std::array<NodeId, 4> nodes;
    std::array<ScreenPoint, 4> points;
    std::array<double, 4> depths, extinction, color;
    bool unclipped;
  };

  // What the slabs of a tetrahedron have in common, with fields less `zero`.
  struct Chords {
    double zero = 0;
    float length = 0, rate = 0;  // as in kChord
    bool falls_away = false;     // the field is less the farther from the eye
    ProjectedTetrahedron shape{};
    std::array<TriangleBuffer::Corner, 4> rim{};
    TriangleBuffer::Corner thickest{};
  };

  [[nodiscard]] bool gather(CellId id, Cell& cell) const;
  [[nodiscard]] bool add_whole(const Cell& cell);
  void add_chords(const Cell& cell);
  [[nodiscard]] bool is_invisible(std::size_t interval) const;
  [[nodiscard]] Chords chords_of(const Cell& cell, const ProjectedTetrahedron& shape) const;
  [[nodiscard]] static bool is_in(const Chords& chords, const std::array<std::uint8_t, 3>& outline,
                                  const std::array<float, 2>& range, std::array<double, 3>& least);
  void add_chord(const Chords& chords, std::size_t interval, const std::array<float, 2>& range);
  void add_sliced(const Cell& cell);
  bool make_polyhedron(const Cell& cell);
  void clip(const std::array<double, 4>& plane);
  void clip_all();
  void find_families(const Cell& cell);
  void add_breakpoints(const std::array<double, 4>& values, std::span<const double> upper,
                       std::size_t least_interval);
  void add_slab(const Cell& cell, const Polyhedron& slab, std::span<const std::size_t> part);
  void add_polygon(const Polyhedron& owner, std::span<const std::uint16_t> polygon,
                   std::size_t family, std::size_t level);
  void add_surface(const Polyhedron& owner, std::span<const std::uint16_t> polygon,
                   std::uint32_t surface, const std::array<double, 3>& normal);
  void add_tetrahedron(std::span<const ScreenPoint, 4> points, std::span<const double, 4> depths,
                       std::span<const Attributes, 4> corners);
  void add_regions(const Polyhedron& slab);

  void project(Polyhedron& polyhedron) const;
  [[nodiscard]] Attributes attributes(double depth, double tau,
                                      const std::array<double, 3>& color) const;
  [[nodiscard]] static Attributes mean(std::span<const Attributes> corners,
                                       const SurfacePoint& point);
  [[nodiscard]] TriangleBuffer::Corner corner(const ScreenPoint& at, const Attributes& front,
                                              const Attributes& back, double thickness);
  [[nodiscard]] TriangleBuffer::Corner surface_corner(const ScreenPoint& at, const LitSurface& lit,
                                                      double facing) const;

  const RegionFiller& filler_;
  const Frame& frame_;
  TriangleBuffer& triangles_;
  RegionCounts& counts_;
  bool perspective_;

  Slicer slicer_;
  PolyhedronCutter cutter_;
  Subdivision subdivision_;
  Sheets sheets_;
  Polyhedron polyhedron_, below_, above_, slab_;
  std::array<std::array<double, 3>, 4> camera_;
  std::vector<double> plane_values_;
  std::vector<PlaneFamily> families_;
  // of the families of isosurfaces, which come first: surfaces by level
  std::vector<std::vector<std::vector<std::uint32_t>>> surfaces_;
  std::size_t extinction_interval_ = 0, color_interval_ = 0;  // of the least values
  std::vector<PolyhedronEdge> edges_;
  std::vector<RayThrough> rays_;
  std::vector<Attributes> vertex_attributes_;
  std::vector<TriangleBuffer::Corner> corners_;
};

}  // namespace hiac::preview

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/preview/regions/screen_predicates.hpp"
#include "hiac/preview/regions/subdivision.hpp"

namespace hiac::preview {

/// A part of a tetrahedron: a convex polyhedron between planes. Arrays have an entry a vertex.
struct Polyhedron {
  std::vector<std::array<double, 3>> camera;  ///< right, up, forward, as Projector has them
  std::vector<std::array<double, 4>> shares;  ///< barycentric coordinates in the tetrahedron
  /// As ProjectedNode: pixels; t or, in perspective, -1 / t. Set by `project`, and for the
  /// tetrahedron's own corners.
  std::vector<ScreenPoint> points;
  std::vector<double> depths;
  /// Corners of face f: corners[first[f]] to corners[first[f + 1]], counter-clockwise seen from
  /// outside in a positively oriented cell (clockwise in a negative one; all alike).
  std::vector<std::uint16_t> corners;
  std::vector<std::uint16_t> first;

  [[nodiscard]] std::size_t size() const { return camera.size(); }
  [[nodiscard]] std::size_t face_count() const { return first.empty() ? 0 : first.size() - 1; }
  [[nodiscard]] std::span<const std::uint16_t> face(std::size_t f) const {
    return std::span(corners).subspan(first[f], std::size_t{first[f + 1]} - first[f]);
  }
  void clear();
};

/// Every edge once.
void edges_of(const Polyhedron& polyhedron, std::vector<PolyhedronEdge>& edges);

/// Cuts a polyhedron by the plane on which a linear function is `level`. `values`: of the function
/// at the vertices. Each part has the vertices on its side and on the plane; a part without a
/// vertex strictly on its side is empty. New vertices depend on the edge that they are on and the
/// values at its ends alone, so that neighbours have the same. `cut`: the polygon in the plane, as
/// indices into the vertices of `below`, empty where the plane does not cut.
///
/// Rounded values of vertices that other planes have cut may contradict one another, in parts thin
/// as a rounding error; such a polyhedron is not cut (false) and goes to the side that it reaches
/// farther into.
class PolyhedronCutter {
 public:
  bool cut(const Polyhedron& whole, std::span<const double> values, double level, Polyhedron& below,
           Polyhedron& above);
  /// Of the last cut: by vertex of `below` and `above`, the values, `level` on the plane.
  std::vector<double> values_below, values_above;
  std::vector<std::uint16_t> polygon;

 private:
  struct Part {
    Polyhedron* polyhedron;
    std::vector<double>* values;
    std::vector<std::uint16_t>* number;  // of the whole's vertices in the part
  };
  struct NewVertex {
    std::uint16_t low, high, below, above;
  };

  std::uint16_t keep(const Polyhedron& whole, std::size_t vertex, double value, Part& part);
  const NewVertex& on_edge(const Polyhedron& whole, std::span<const double> values, double level,
                           std::uint16_t i, std::uint16_t k, Part& below, Part& above);
  void cut_face(const Polyhedron& whole, std::span<const double> values, double level,
                std::span<const std::uint16_t> face, Part& below, Part& above);
  bool close(Part& below, Part& above);

  std::vector<std::uint16_t> number_below_, number_above_;
  std::vector<NewVertex> new_;
  bool contradictory_ = false;  // a face meets the plane as no convex one does
  // the sides of the polygon in the plane, as `below` has it: pairs of its vertices
  std::vector<std::array<std::uint16_t, 2>> sides_;
  std::vector<std::array<std::uint16_t, 2>> on_plane_;  // vertices on the plane: below, above
};

}  // namespace hiac::preview

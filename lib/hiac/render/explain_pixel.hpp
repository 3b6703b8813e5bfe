#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/render/pixels/pixel_details.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// An end of a ray segment, seen from inside its cell.
struct SegmentEnd {
  double depth = 0;  ///< distance from the eye plane along the view direction
  double color_field = 0, extinction_field = 0;
  Color kappa{};   ///< value of the colour function: chromaticity, or emission
  double tau = 0;  ///< extinction coefficient per world unit of length
};

/// An isosurface where the ray meets it.
struct MetIsosurface {
  std::size_t surface = 0;  ///< index into Scene::isosurfaces
  double depth = 0;         ///< as SegmentEnd::depth
  Color color{};            ///< its light, premultiplied by its opacity
  double opacity = 0;       ///< at the angle at which it is seen
};

/// The part of a ray inside one cell, or where it meets the skin or an edge on a cell: then
/// front.depth is its depth, of an edge the depth at which it is drawn among the segments, and
/// `light` and `opacity` are what is seen there.
struct PixelSegment {
  RayPart part = RayPart::inside;
  CellId cell = 0;  ///< kNoCell for edges beside all cells that the ray passes
  CellKind kind{};
  bool in_group = false;      ///< the cell's place was found pixel by pixel (CellGroup)
  bool out_of_order = false;  ///< the segment begins before the end of the one in front
  SegmentEnd front, back;
  double length = 0;  ///< world units
  /// Psi = int_0^1 exp(-A(u)) du of the segment's volume, u its part from the front and A(u) the
  /// optical depth of that part: the mean transparency (linear_piece.hpp). Of the fields
  /// themselves, whatever the scene's integration, and without isosurfaces.
  double psi = 1;
  std::vector<MetIsosurface> surfaces;  ///< front to back
  Color light{};                        ///< of skin and edges, premultiplied by the opacity
  double opacity = 0;                   ///< of skin and edges; of edges times the pixel's share
  // of all that is in front of the segment's back end
  double transparency = 1;
  Color color{};                ///< premultiplied, without background
  std::optional<double> error;  ///< bound (pixel_error); none where none is claimed
};

/// How one pixel is computed.
struct PixelExplanation {
  std::uint32_t x = 0, y = 0;
  std::vector<PixelSegment> segments;  ///< front to back, as they were composited
  bool ended = false;                  ///< the transparency of the segments is too small to go on
  double transparency = 1;
  Color background{};  ///< behind; black without one
  /// "R" "G" "B" "A" of the picture.
  std::array<double, 4> rgba{};
  /// Bound, of every channel of rgba; none where none is claimed: of other integrations and
  /// interpolations than the exact and isoparametric ones.
  std::optional<double> error;
};

/// Follows the ray of one pixel as the engine does: the same code renders the same cells in the
/// same order, one by one, and what the pixel holds after each of them is noted. So `rgba` and
/// `error` are the picture's, to the last bit. Ends, fields and
/// isosurfaces are those that the engine finds in cells of every kind (general_cells.hpp); in
/// tetrahedra they
/// are those of its kernel to within rounding. Cells without extinction (nor emission) are empty
/// space, and no segments, unless an isosurface crosses them.
///
/// Requires what check_renderable (renderable.hpp) lets pass. Throws UsageError if the pixel is not
/// in the picture, or if cells are splatted: splats are no segments.
PixelExplanation explain_pixel(const ZooMesh& mesh, const VisibilityOrder& order,
                               const Scene& scene, std::uint32_t x, std::uint32_t y,
                               bool with_background);

}  // namespace hiac

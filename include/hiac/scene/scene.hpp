#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hiac/base/transfer_function.hpp"

namespace hiac {

/// Value types of an image specification: everything that decides a picture except the mesh.
///
/// Colours are linear RGB, not negative, of order 1 but free to exceed it. Lengths are in the
/// mesh's world units. Member initializers are the defaults of a specification file; every
/// `operator==` compares to the bit.

using Color = std::array<double, 3>;

/// Largest component of a colour: image files store 32-bit numbers.
inline constexpr double kLargestColor = 1e30;
/// Largest magnitude of other numbers except extinctions, which have no limit; its reciprocal is
/// the smallest positive number. Differences and products of such numbers do not overflow.
inline constexpr double kLargestNumber = 1e100;
/// Narrowest vertical angle of an image, degrees.
inline constexpr double kLeastFov = 1e-9;

/// Largest number of pixels along one side of an image, and in the whole image.
inline constexpr std::uint32_t kMaxImageSide = 65536;
inline constexpr std::uint64_t kMaxImagePixels = std::uint64_t{1} << 30;

/// Pixel (i, j), i from the left, j from the top, is sampled at its centre.
struct ImageSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;

  bool operator==(const ImageSize&) const = default;
};

enum class Projection : std::uint8_t { perspective, orthographic };

/// A right-handed camera: it looks from `eye` to `look_at`, the image's centre, and `up` points up.
struct Camera {
  Projection projection = Projection::perspective;
  std::array<double, 3> eye{};
  std::array<double, 3> look_at{};  ///< differs from `eye`
  std::array<double, 3> up{};       ///< any length, not parallel to the view direction
  double fov = 0;     ///< perspective: the image's vertical angle, degrees, inside (0, 180)
  double height = 0;  ///< orthographic: the image's vertical extent, world units, positive
  /// Near and far plane: distances from the eye plane along the view direction, near < far; near is
  /// not negative in perspective, far may be infinite. None: everything in front of the
  /// eye (perspective) or everything (orthographic).
  std::optional<std::array<double, 2>> clip;
  /// Where the line of sight meets the picture: pixels to the right of its middle, and below it.
  /// No key of a specification sets it.
  std::array<double, 2> shift{};

  bool operator==(const Camera&) const = default;
};

/// Largest number of frames of an animation.
inline constexpr std::uint32_t kMaxFrames = 100000;

/// The camera at one frame of an animation.
struct Keyframe {
  std::uint32_t frame = 0;
  Camera camera;

  bool operator==(const Keyframe&) const = default;
};

/// How eye and look_at move between keyframes (camera_path.hpp).
enum class PathInterpolation : std::uint8_t { catmull_rom, linear };

/// A camera that passes through keyframes.
struct KeyframePath {
  /// At least one, the first at frame 0, frames ascending; all of one projection, all with a
  /// clipping slab or none.
  std::vector<Keyframe> keyframes;
  PathInterpolation interpolation = PathInterpolation::catmull_rom;

  bool operator==(const KeyframePath&) const = default;
};

/// A camera that circles its look_at and always looks at it.
struct Turntable {
  std::uint32_t frames = 1;
  double degrees = 360;  ///< from frame 0 to the frame after the last: 360 makes a seamless loop
  std::optional<std::array<double, 3>> axis;  ///< any length but 0; none: the camera's `up`

  bool operator==(const Turntable&) const = default;
};

using CameraPath = std::variant<KeyframePath, Turntable>;

/// A piecewise-linear function of one scalar field of the mesh.
template <std::size_t N>
struct TransferFunction {
  using Point = typename PiecewiseLinear<N>::Point;

  std::string field;          ///< as scalar_field accepts it: "pressure", "velocity:magnitude"
  std::vector<Point> points;  ///< at least one, scalars not decreasing

  [[nodiscard]] PiecewiseLinear<N> function() const { return PiecewiseLinear<N>(points); }

  friend bool operator==(const TransferFunction& a, const TransferFunction& b) {
    const auto same = [](const Point& p, const Point& q) {
      return p.scalar == q.scalar && p.value == q.value;
    };
    return a.field == b.field &&
           std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same);
  }
};

/// Colour by scalar: chromaticity, or emission per world unit of length (Glow).
using ColorTransfer = TransferFunction<3>;
/// Extinction coefficient per world unit of length by scalar; not negative.
using ExtinctionTransfer = TransferFunction<1>;

/// Without `color` the volume does not glow; without `extinction` it does not absorb.
struct Volume {
  Glow glow = Glow::chromaticity;
  std::optional<ColorTransfer> color;
  std::optional<ExtinctionTransfer> extinction;

  bool operator==(const Volume&) const = default;
};

/// The surface on which a field has one value.
struct Isosurface {
  std::string field;
  double value = 0;
  Color color{1, 1, 1};
  /// Seen face-on, in [0, 1]; at an angle it is 1 - (1 - opacity)^(1/|n.v|).
  double opacity = 1;
  double ambient = 0.2;
  double diffuse = 0.7;
  double specular = 0.3;
  double shininess = 30;

  bool operator==(const Isosurface&) const = default;
};

/// The mesh's boundary as a lit surface: the faces that no other cell has. Opacity and shares of
/// light are those of an isosurface.
struct Skin {
  Color color{0.7, 0.7, 0.7};
  /// Colour by a field, which replaces `color`.
  std::optional<ColorTransfer> color_by;
  double opacity = 1;
  double ambient = 0.2;
  double diffuse = 0.7;
  double specular = 0.3;
  double shininess = 30;

  bool operator==(const Skin&) const = default;
};

/// Which of a mesh's edges are drawn: those of the boundary at which it bends, all of the boundary,
/// or all edges of all cells.
enum class EdgeChoice : std::uint8_t { feature, boundary, all };

/// Edges of the mesh as lines. They are not lit.
struct Edges {
  EdgeChoice show = EdgeChoice::feature;
  double angle = 30;   ///< feature: degrees between the faces beside an edge, above which it shows
  double width = 1.5;  ///< pixels
  Color color{0, 0, 0};
  double opacity = 1;

  bool operator==(const Edges&) const = default;
};

/// A light infinitely far away.
struct Light {
  /// Towards the light, any length but 0; none: a headlight at the eye.
  std::optional<std::array<double, 3>> direction;
  Color color{1, 1, 1};

  bool operator==(const Light&) const = default;
};

enum class BackgroundPattern : std::uint8_t { solid, checker, grid, gradient };

/// The image that is composited behind everything.
struct Background {
  BackgroundPattern pattern = BackgroundPattern::solid;
  Color color{0, 0, 0};   ///< solid; one field of the checker; between the grid's lines; top
  Color color2{0, 0, 0};  ///< other fields of the checker; the grid's lines; bottom
  double size = 32;       ///< checker and grid: pixels along a field's side

  bool operator==(const Background&) const = default;
};

/// How radiance along a ray is integrated (Williams, Max, Stein 1998, section 4).
enum class Integration : std::uint8_t { exact, gauss5, approximate, approximate_unsliced };

/// How a field is interpolated in cells: by the finite element's shape functions, or by polynomials
/// in world coordinates, which are those of the paper (section 3) where it defines them.
enum class Interpolation : std::uint8_t { isoparametric, polynomial };

struct RenderSettings {
  Integration integration = Integration::exact;
  Interpolation interpolation = Interpolation::isoparametric;
  /// Absolute error allowed per pixel and channel, for images whose colours are of order 1.
  double tolerance = 1e-9;
  /// Cells that cover fewer pixel centres are splatted (section 5.3); 0: none.
  std::uint32_t splat_below = 0;
  /// A quadrilateral face whose deviation from a plane is below this times its size is planar.
  double planarity = 1e-10;

  bool operator==(const RenderSettings&) const = default;
};

/// One image specification.
struct Scene {
  ImageSize image;
  Camera camera;                   ///< if there is a path, that of frame 0
  std::optional<CameraPath> path;  ///< none: one view, not an animation
  Volume volume;
  std::vector<Isosurface> isosurfaces;
  std::optional<Skin> skin;            ///< none: the boundary is not drawn
  std::optional<Edges> edges;          ///< none: no edges are drawn
  std::vector<Light> lights{Light{}};  ///< a white headlight if a file specifies none
  Background background;
  RenderSettings render;

  bool operator==(const Scene&) const = default;
};

/// Returns look_at - eye, each component rounded once, not normalised: the only view direction that
/// ordering and rendering use.
std::array<double, 3> view_direction(const Camera& camera);

/// Returns a hash (128 bits, 32 hexadecimal digits) of everything that decides the visibility order
/// of a mesh: the projection; the eye (perspective) or the view direction without its length
/// (orthographic); and the deviation below which a face counts as planar. Two scenes with the same
/// hash order every mesh alike.
std::string view_hash(const Scene& scene);

}  // namespace hiac

#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "hiac/frame/crop.hpp"

namespace hiac::preview {

/// What shaders get of a triangle. Of each corner two floats, its place in a larger triangle (see
/// kGrowth) for the rasteriser; of the whole triangle a record of floats, in this order:
///
///     a.x a.y b.x b.y   corners, pixels from the part's corner on: multiples of kCoarse
///     the same          what is missing of them, multiples of kFine
///     c.x c.y           and what is missing of them
///     least x 3         0 or the least float: a pixel's centre on the side opposite the corner
///                       belongs to the triangle from that value of the edge function on
///     steep x 3         the height of the peak is the least of steep[k] w[k], where w are the
///     shares
///                       of the corners; kOpen where it does not fall towards the side
///     values x 4        of a less c, b less c, c, and of the peak less what a, b and c have there
///     rest              what is the same at every pixel
///
/// Rasterisers move corners to a grid of 1/256 pixel. So a triangle larger by kGrowth is drawn, and
/// the shader decides, by edge functions that the neighbour evaluates in just the same way, whether
/// a pixel's centre lies in the triangle: no pixel is left out or drawn twice along an edge, and no
/// value is extrapolated, however narrow a triangle is. The distance of a pixel's centre from a
/// corner is known to half of kFine, and depends on these two alone.
///
/// Values are linear on the screen, or where there is a peak in each of the triangles between it
/// and two of the corners.
inline constexpr double kGrowth = 0x1p-7;
inline constexpr double kCoarse = 0x1p-4, kFine = 0x1p-20;
/// Where in a record things begin.
inline constexpr std::size_t kLeast = 12, kSteep = 15, kFirstValue = 18;
/// Shaders add 1e-20 to a share before they multiply it by this.
inline constexpr float kOpen = 1e30F;

/// How many values and how much of the rest a record has.
struct RecordShape {
  std::size_t values, rest;

  /// A multiple of three, so that a record spans its triangle's three vertices.
  [[nodiscard]] constexpr std::size_t floats() const {
    return (kFirstValue + 4 * values + rest + 2) / 3 * 3;
  }
  bool operator==(const RecordShape&) const = default;
};
/// M0; parallel projection: two numbers (length and mean extinction; with M0 alpha and 0) and a
/// colour.
inline constexpr RecordShape kFlat{5, 0};
/// Perspective: the difference of 1 / t at the ends, 1 / t at the front and the back, extinction /
/// t there, and the colour / t, t in the mean.
inline constexpr RecordShape kPerspective{8, 0};
/// A slab of a tetrahedron in parallel projection, drawn as the tetrahedron's outline. The value is
/// the transfer functions' field, less what it is at some corner: at the corners on one side of the
/// tetrahedron, at the peak on the other. The rest: the length at the peak; how far one goes from
/// that side for the field to grow by 1; the slab's range of the field; extinction and half its
/// slope; colour and half its slope.
inline constexpr RecordShape kChord{1, 12};
inline constexpr std::size_t kMostValues = 8;

/// Of a triangle with kChord, where its slab lies.
struct SlabLimits {
  std::array<double, 3> least_shares{};  ///< that the corners have there
  std::span<const float> rest;           ///< of the record
};

/// Triangles in the order in which they are to be drawn.
class TriangleBuffer {
 public:
  using Values = std::array<float, kMostValues>;

  /// `part`: what is drawn of the picture, from whose corner the shaders' places count. So they
  /// need no uniform for it, which Mesa's llvmpipe reads pixel by pixel.
  explicit TriangleBuffer(RecordShape shape, const PixelRect& part = {})
      : shape_(shape), origin_{double(part.x), double(part.y)} {}

  struct Corner {
    double x, y;
    Values values;
  };
  /// Adds a triangle, counter-clockwise with y up, whichever way it is given; none where its
  /// corners, rounded to kFine, lie on a line, or where it contains no pixel's centre.
  void add(const Corner& a, const Corner& b, const Corner& c) { add(a, b, c, nullptr, {}); }
  /// The same with a peak, a point of the triangle: values are linear in the triangles that it
  /// makes with two corners. It is taken to lie on a side, or at a corner, that is nearer than
  /// kFine.
  void add(const Corner& a, const Corner& b, const Corner& c, const Corner& peak,
           const SlabLimits& limits = {}) {
    add(a, b, c, &peak, limits);
  }

  void clear() { triangles_ = 0; }
  /// Two a vertex, six a triangle.
  [[nodiscard]] std::span<const float> places() const {
    return std::span(places_).first(6 * triangles_);
  }
  /// RecordShape::floats() a triangle.
  [[nodiscard]] std::span<const float> records() const {
    return std::span(records_).first(shape_.floats() * triangles_);
  }
  [[nodiscard]] std::size_t triangles() const { return triangles_; }
  [[nodiscard]] RecordShape shape() const { return shape_; }

 private:
  using Place = std::array<double, 2>;
  // Counter-clockwise, rounded to kFine.
  struct Triangle {
    std::array<Place, 3> at;
    std::array<const Values*, 3> values;
  };
  void add(const Corner& a, const Corner& b, const Corner& c, const Corner* peak,
           const SlabLimits& limits);
  void make_room();
  void set_triangle(float* record, const Triangle& triangle) const;
  void set_flat(float* record) const;
  void set_peak(float* record, const Triangle& triangle, const Corner& peak) const;

  RecordShape shape_;
  Place origin_;
  std::vector<float> places_, records_;  // with room for more triangles than there are
  std::size_t triangles_ = 0;
};

/// A triangle that contains a given one (counter-clockwise) with a margin of kGrowth around it.
std::array<std::array<double, 2>, 3> grown(const std::array<std::array<double, 2>, 3>& corners);

}  // namespace hiac::preview

#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace hiac::preview {

/// What a shader gets of a corner of a region's triangle, in this order, as floats:
///
///     grown x, y      the corner of a triangle around it, for the rasteriser
///     x, y            pixel coordinates of the frame: multiples of kCoarse
///     fine x, y       what is missing of them: two 16-bit numbers of kFine
///     values          kFlatValues or kPerspectiveValues of them
///
/// Rasterisers move corners to a grid of 1/256 pixel. So a triangle larger by kGrowth is drawn, and
/// the shader decides, by edge functions that the neighbour evaluates in just the same way, whether
/// a pixel's centre lies in the triangle: no pixel is left out or drawn twice along an edge, and no
/// value is extrapolated, however narrow a triangle is. The distance of a pixel's centre from a
/// corner is known to half of kFine, and depends on these two alone.
///
/// Values are linear on the screen. Flat (M0; parallel projection): two numbers (length and mean
/// extinction; with M0 alpha and 0) and a colour. Perspective: the difference of 1 / t at the ends,
/// 1 / t at the front and the back, extinction / t there, and the colour / t, t in the mean.
inline constexpr std::size_t kFlatValues = 5;
inline constexpr std::size_t kPerspectiveValues = 8;
inline constexpr double kGrowth = 0x1p-7;
inline constexpr double kCoarse = 0x1p-4, kFine = 0x1p-20;
inline constexpr std::size_t kFirstValue = 5;

/// Triangles in the order in which they are to be drawn.
class TriangleBuffer {
 public:
  explicit TriangleBuffer(std::size_t values) : values_(values) {}

  struct Corner {
    double x, y;
    std::array<float, kPerspectiveValues> values;
  };
  /// Adds a triangle, counter-clockwise with y up, whichever way it is given; none where its
  /// corners, rounded to kFine, lie on a line, or where it contains no pixel's centre.
  void add(const Corner& a, const Corner& b, const Corner& c);

  void clear() { floats_.clear(); }
  [[nodiscard]] std::span<const float> floats() const { return floats_; }
  [[nodiscard]] std::size_t floats_per_vertex() const { return kFirstValue + values_; }
  [[nodiscard]] std::size_t triangles() const { return floats_.size() / (3 * floats_per_vertex()); }

 private:
  std::size_t values_;
  std::vector<float> floats_;
};

/// A triangle that contains a given one (counter-clockwise) with a margin of kGrowth around it.
std::array<std::array<double, 2>, 3> grown(const std::array<std::array<double, 2>, 3>& corners);

}  // namespace hiac::preview

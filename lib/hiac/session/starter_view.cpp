#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/image/heat_map.hpp"
#include "hiac/image/srgb.hpp"
#include "hiac/session/session.hpp"

namespace hiac {
namespace {

using Vec = std::array<double, 3>;

Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec operator*(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec unit(const Vec& a) { return (1 / std::sqrt(dot(a, a))) * a; }

Vec position(const ZooMesh& mesh, NodeId node) {
  const auto p = mesh.position(node);
  return {p[0], p[1], p[2]};
}

// The camera --------------------------------------------------------------------------------------

constexpr double kFov = 30;
/// The fraction of the image that the model may fill; curved cells can bulge a little beyond their
/// nodes.
constexpr double kFilled = 0.94;
constexpr Vec kTowardsEye{0.55, -0.75, 0.45};
constexpr Vec kUp{0, 0, 1};

/// An orthonormal frame that looks along `ahead`.
struct Frame {
  Vec right, up, ahead;
};

Frame frame_of(const Vec& view_direction) {
  const Vec ahead = unit(view_direction);
  const Vec right = unit(cross(ahead, kUp));
  return {right, cross(right, ahead), ahead};
}

/// A number rounded to a multiple of a power of ten that is at most a thousandth of `scale`.
double rounded(double value, double scale) {
  const int digits = 3 - static_cast<int>(std::floor(std::log10(scale)));
  if (digits > 0) return std::stod(fmt::format("{:.{}f}", value, digits));
  const double step = std::pow(10, -digits);
  return std::round(value / step) * step;
}

Vec rounded(const Vec& v, double scale) {
  return {rounded(v[0], scale), rounded(v[1], scale), rounded(v[2], scale)};
}

/// The box around the nodes of all cells.
std::array<Vec, 2> bounds(const ZooMesh& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<Vec, 2> box{Vec{kInfinity, kInfinity, kInfinity},
                         Vec{-kInfinity, -kInfinity, -kInfinity}};
  for (const NodeId node : mesh.nodes) {
    const auto p = mesh.position(node);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box[0][axis] = std::min(box[0][axis], p[axis]);
      box[1][axis] = std::max(box[1][axis], p[axis]);
    }
  }
  return box;
}

Camera camera_for(const ZooMesh& mesh, const ImageSize& image) {
  const auto [low, high] = bounds(mesh);
  const Vec center = 0.5 * low + 0.5 * high;
  const Vec extent = high - low;
  const double size = std::max({extent[0], extent[1], extent[2], 1e-300});
  const Vec look_at = rounded(center, size);
  const Frame frame = frame_of(-1 * kTowardsEye);
  const double half_height = kFilled * std::tan(0.5 * kFov * std::numbers::pi / 180);
  const double half_width = half_height * image.width / image.height;
  double distance = 0.01 * size;
  for (const NodeId node : mesh.nodes) {
    const Vec p = position(mesh, node) - look_at;
    const double needed = std::max(std::fabs(dot(p, frame.up)) / half_height,
                                   std::fabs(dot(p, frame.right)) / half_width);
    distance = std::max(distance, needed - dot(p, frame.ahead));
  }
  Camera camera;
  camera.look_at = look_at;
  camera.eye = rounded(look_at - distance * frame.ahead, size);
  camera.up = kUp;
  camera.fov = kFov;
  return camera;
}

// The field ---------------------------------------------------------------------------------------

struct FieldRange {
  Field field;
  double low;
  double high;
};

std::optional<FieldRange> first_field(const ZooMesh& mesh) {
  for (const Field& candidate : mesh.fields) {
    const std::string name =
        distinct_name(mesh, candidate) + (candidate.components == 1 ? "" : ":magnitude");
    FieldRange range{scalar_field(mesh, name), std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
    range.field.name = name;
    for (const double value : range.field.values) {
      if (!std::isfinite(value)) continue;
      range.low = std::min(range.low, value);
      range.high = std::max(range.high, value);
    }
    if (range.low <= range.high) return range;
  }
  return std::nullopt;
}

/// The mean of the values at a cell's conventional nodes.
double cell_value(const ZooMesh& mesh, const Field& field, CellId cell) {
  if (field.location == FieldLocation::cell) return field.values[cell];
  const std::size_t corners = corner_count(mesh.kinds[cell]);
  double sum = 0;
  for (std::size_t i = 0; i < corners; ++i)
    sum += field.location == FieldLocation::node ? field.values[mesh.cell_nodes(cell)[i]]
                                                 : field.values[mesh.elems[cell] + i];
  return sum / static_cast<double>(corners);
}

// Optical depth -----------------------------------------------------------------------------------

/// Calls visit(a, b, c) with the corner positions of triangles that together form the cell's faces.
template <typename Visit>
void for_each_triangle(const ZooMesh& mesh, CellId cell, const Visit& visit) {
  const auto nodes = mesh.cell_nodes(cell);
  for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces) {
    const Vec a = position(mesh, nodes[face.corners[0]]);
    for (std::size_t i = 2; i < face.corner_count; ++i)
      visit(a, position(mesh, nodes[face.corners[i - 1]]), position(mesh, nodes[face.corners[i]]));
  }
}

/// A coarse image, used only for the share of it that is covered and for sums over its pixels.
class Silhouette {
 public:
  Silhouette(const Camera& camera, const ImageSize& size)
      : eye_(camera.eye), frame_(frame_of(view_direction(camera))), covered_(kWidth * kHeight) {
    focal_ = 0.5 * kHeight / std::tan(0.5 * camera.fov * std::numbers::pi / 180);
    // the rows span the height of the image, and the width of a pixel follows from its aspect
    stretch_ = static_cast<double>(kWidth) * size.height / (kHeight * double{1} * size.width);
  }

  /// Marks the pixels whose centres the triangle covers.
  void cover(const Vec& a, const Vec& b, const Vec& c) {
    const Pixel p = project(a), q = project(b), r = project(c);
    const auto first = [](double v, int limit) {
      return static_cast<int>(std::clamp(std::ceil(v - 0.5), 0.0, double(limit)));
    };
    const auto [left, right] = std::minmax({p.x, q.x, r.x});
    const auto [top, bottom] = std::minmax({p.y, q.y, r.y});
    for (int y = first(top, kHeight); y < kHeight && y + 0.5 <= bottom; ++y)
      for (int x = first(left, kWidth); x < kWidth && x + 0.5 <= right; ++x)
        if (inside({x + 0.5, y + 0.5}, p, q, r))
          covered_[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)].store(
              1, std::memory_order_relaxed);
  }

  /// The length of ray in a unit of volume at a point, summed over the pixels.
  [[nodiscard]] double length_per_volume(const Vec& point) const {
    const Vec towards = point - eye_;
    const double depth = dot(towards, frame_.ahead);
    const double cosine = depth / std::sqrt(dot(towards, towards));
    return focal_ * focal_ * stretch_ / (depth * depth * cosine);
  }

  [[nodiscard]] double covered_pixels() const {
    double count = 0;
    for (const auto& pixel : covered_) count += pixel.load(std::memory_order_relaxed);
    return count;
  }

 private:
  static constexpr int kWidth = 512;
  static constexpr int kHeight = 512;
  struct Pixel {
    double x, y;
  };

  [[nodiscard]] Pixel project(const Vec& point) const {
    const Vec towards = point - eye_;
    const double scale = focal_ / dot(towards, frame_.ahead);
    return {0.5 * kWidth + stretch_ * scale * dot(towards, frame_.right),
            0.5 * kHeight - scale * dot(towards, frame_.up)};
  }
  static double side(const Pixel& o, const Pixel& a, const Pixel& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  }
  static bool inside(const Pixel& s, const Pixel& a, const Pixel& b, const Pixel& c) {
    const double u = side(s, a, b), v = side(s, b, c), w = side(s, c, a);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  }

  Vec eye_;
  Frame frame_;
  double focal_;
  double stretch_;
  std::vector<std::atomic<unsigned char>> covered_;
};

/// What one cell contributes to the optical depth summed over the pixels, for extinction `weight`.
double cell_depth(const ZooMesh& mesh, CellId cell, double weight, Silhouette& silhouette) {
  const auto nodes = mesh.cell_nodes(cell);
  const std::size_t corners = corner_count(mesh.kinds[cell]);
  const Vec anchor = position(mesh, nodes[0]);
  Vec center = anchor;
  for (std::size_t i = 0; i < corners; ++i)
    center = center + (1 / static_cast<double>(corners)) * (position(mesh, nodes[i]) - anchor);
  double volume = 0;
  for_each_triangle(mesh, cell, [&](const Vec& a, const Vec& b, const Vec& c) {
    volume += dot(a - center, cross(b - center, c - center)) / 6;
    silhouette.cover(a, b, c);
  });
  return std::isfinite(weight) ? weight * std::fabs(volume) * silhouette.length_per_volume(center)
                               : 0;
}

/// The mean over the covered pixels of the optical depth of an extinction that grows from 0 at the
/// field's lowest value to 1 at its highest (1 everywhere when these are equal).
double mean_optical_depth(const ZooMesh& mesh, const FieldRange& range, Silhouette& silhouette) {
  constexpr std::size_t kGrain = 4096;
  const double extent = range.high - range.low;
  std::vector<double> partial((mesh.cell_count() + kGrain - 1) / kGrain);
  parallel_for(mesh.cell_count(), kGrain, [&](IndexRange cells) {
    double sum = 0;
    for (std::size_t i = cells.begin; i < cells.end; ++i) {
      const auto cell = static_cast<CellId>(i);
      const double value = cell_value(mesh, range.field, cell);
      sum += cell_depth(mesh, cell, extent > 0 ? (value - range.low) / extent : 1, silhouette);
    }
    partial[cells.begin / kGrain] = sum;
  });
  double sum = 0;
  for (const double part : partial) sum += part;
  return sum / std::max(1.0, silhouette.covered_pixels());
}

// The transfer functions --------------------------------------------------------------------------

Color linear_color(const std::array<int, 3>& srgb) {
  Color color;
  for (std::size_t c = 0; c < 3; ++c) color[c] = rounded(srgb_decode(srgb[c] / 255.0), 1);
  return color;
}

ColorTransfer color_over(const FieldRange& range) {
  ColorTransfer transfer{range.field.name, {}};
  if (!(range.low < range.high)) {
    transfer.points.push_back({range.low, linear_color(kViridis[3])});
    return transfer;
  }
  constexpr std::size_t kLast = kViridis.size() - 1;
  for (std::size_t i = 0; i <= kLast; ++i) {
    const double t = static_cast<double>(i) / kLast;
    transfer.points.push_back({(1 - t) * range.low + t * range.high, linear_color(kViridis[i])});
  }
  return transfer;
}

ExtinctionTransfer extinction_over(const FieldRange& range, double largest) {
  if (!(range.low < range.high)) return {range.field.name, {{range.low, {largest}}}};
  return {range.field.name, {{range.low, {0}}, {range.high, {largest}}}};
}

}  // namespace

Scene starter_view(const ZooMesh& mesh, const std::string& subject) {
  if (mesh.cell_count() == 0) throw InputError(subject, "no cells to look at");
  const std::optional<FieldRange> range = first_field(mesh);
  if (!range)
    throw InputError(subject, mesh.fields.empty() ? "no field to look at (the mesh has none)"
                                                  : "no field to look at (none has finite values)");
  Scene scene;
  scene.image = {1024, 768};
  scene.camera = camera_for(mesh, scene.image);
  if (scene.camera.eye == scene.camera.look_at)
    throw InputError(subject, "nothing to look at (all nodes lie at one point)");
  Silhouette silhouette(scene.camera, scene.image);
  const double depth = mean_optical_depth(mesh, *range, silhouette);
  // a field that is at its lowest almost everywhere absorbs almost nothing: leave it at 1
  const double largest = depth > 0 && std::isfinite(1 / depth) ? rounded(1 / depth, 1 / depth) : 1;
  scene.volume.color = color_over(*range);
  scene.volume.extinction = extinction_over(*range, largest);
  scene.background.color = {1, 1, 1};
  return scene;
}

}  // namespace hiac

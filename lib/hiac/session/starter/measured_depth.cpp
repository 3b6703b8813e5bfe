#include "hiac/session/starter/measured_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "hiac/base/parallel.hpp"
#include "hiac/session/starter/starter_camera.hpp"

namespace hiac::starter {
namespace {

constexpr int kColumns = 96, kRows = 72;
constexpr std::size_t kRays = std::size_t{kColumns} * kRows;

/// A corner of a tetrahedron, and the extinction there.
struct Corner {
  Vec at;  ///< relative to the eye
  double extinction;
};

using Tetrahedron = std::array<Corner, 4>;

/// The rays, by their column and row.
class RayGrid {
 public:
  RayGrid(const Camera& camera, const ImageSize& size) : frame_(frame_of(camera)) {
    half_height_ = std::tan(0.5 * camera.fov * std::numbers::pi / 180);
    half_width_ = half_height_ * size.width / size.height;
  }

  /// The direction of a ray, whose component along the view direction is 1.
  [[nodiscard]] Vec direction(int column, int row) const {
    const double x = (2 * (column + 0.5) / kColumns - 1) * half_width_;
    const double y = (1 - 2 * (row + 0.5) / kRows) * half_height_;
    return frame_.ahead + (x * frame_.right + y * frame_.up);
  }

  /// Calls visit(column, row) for the rays that may meet the tetrahedron.
  template <typename Visit>
  void for_rays_near(const Tetrahedron& tetrahedron, const Visit& visit) const {
    double left = kColumns, right = 0, top = kRows, bottom = 0;
    for (const Corner& corner : tetrahedron) {
      const double depth = dot(corner.at, frame_.ahead);
      if (!(depth > 0)) return;  // the camera keeps all of the mesh before the eye
      const double x = (dot(corner.at, frame_.right) / (depth * half_width_) + 1) * kColumns / 2;
      const double y = (1 - dot(corner.at, frame_.up) / (depth * half_height_)) * kRows / 2;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
    const auto first = [](double v, int most) {
      return static_cast<int>(std::clamp(std::ceil(v - 0.5), 0.0, double(most)));
    };
    for (int row = first(top, kRows); row < kRows && row + 0.5 <= bottom; ++row)
      for (int column = first(left, kColumns); column < kColumns && column + 0.5 <= right; ++column)
        visit(column, row);
  }

 private:
  Frame frame_;
  double half_width_, half_height_;
};

/// The integral of the extinction along the ray t -> t d from the eye inside a tetrahedron.
/// Barycentric coordinates are linear in t; the integral of a linear function is its middle value
/// times the length.
double integral_in(const Tetrahedron& tetrahedron, const Vec& d) {
  const Vec& a = tetrahedron[0].at;
  const std::array<Vec, 3> edges{tetrahedron[1].at - a, tetrahedron[2].at - a,
                                 tetrahedron[3].at - a};
  const double volume = dot(edges[0], cross(edges[1], edges[2]));
  if (volume == 0) return 0;
  std::array<double, 4> at_eye{1, 0, 0, 0}, slope{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec normal = (1 / volume) * cross(edges[(i + 1) % 3], edges[(i + 2) % 3]);
    at_eye[i + 1] = -dot(a, normal);
    slope[i + 1] = dot(d, normal);
    at_eye[0] -= at_eye[i + 1];
    slope[0] -= slope[i + 1];
  }
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    if (slope[i] > 0)
      enter = std::max(enter, -at_eye[i] / slope[i]);
    else if (slope[i] < 0)
      leave = std::min(leave, -at_eye[i] / slope[i]);
    else if (at_eye[i] < 0)
      return 0;
  }
  if (!(enter < leave) || !std::isfinite(leave)) return 0;
  const double middle = 0.5 * (enter + leave);
  double extinction = 0;
  for (std::size_t i = 0; i < 4; ++i)
    extinction += (at_eye[i] + middle * slope[i]) * tetrahedron[i].extinction;
  return extinction * (leave - enter) * std::sqrt(dot(d, d));
}

/// Calls visit(tetrahedron) for the tetrahedra that a cell counts as.
template <typename Visit>
void for_each_tetrahedron(const ZooMesh& mesh, CellId cell, const Vec& eye,
                          const std::function<double(CellId, std::size_t)>& extinction,
                          const Visit& visit) {
  const auto nodes = mesh.cell_nodes(cell);
  const std::size_t count = corner_count(mesh.kinds[cell]);
  std::array<Corner, 8> corners{};
  Corner center{{}, 0};
  const double share = 1 / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    corners[i] = {position(mesh, nodes[i]) - eye, extinction(cell, i)};
    center.at = center.at + share * corners[i].at;
    center.extinction += share * corners[i].extinction;
  }
  if (!std::isfinite(center.extinction)) return;
  for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces)
    for (std::size_t i = 2; i < face.corner_count; ++i)
      visit(Tetrahedron{center, corners[face.corners[0]], corners[face.corners[i - 1]],
                        corners[face.corners[i]]});
}

/// Adds the depths of one cell, and behind them a 1 for each ray that meets it.
void add_cell(const ZooMesh& mesh, CellId cell, const Vec& eye, const RayGrid& grid,
              const std::function<double(CellId, std::size_t)>& extinction,
              std::vector<double>& depths) {
  for_each_tetrahedron(mesh, cell, eye, extinction, [&](const Tetrahedron& t) {
    grid.for_rays_near(t, [&](int column, int row) {
      const double depth = integral_in(t, grid.direction(column, row));
      const auto ray = static_cast<std::size_t>(row * kColumns + column);
      depths[ray] += depth;
      if (depth > 0) depths[kRays + ray] = 1;
    });
  });
}

}  // namespace

MeasuredDepth measure_depth(const ZooMesh& mesh, const Camera& camera, const ImageSize& size,
                            const std::function<double(CellId, std::size_t)>& extinction) {
  // parts of a fixed number: their sums do not depend on the number of threads
  constexpr std::size_t kParts = 64;
  const RayGrid grid(camera, size);
  const std::size_t share = mesh.cell_count() / kParts + 1;
  std::vector<std::vector<double>> parts(kParts, std::vector<double>(2 * kRays));
  parallel_for(kParts, 1, [&](IndexRange range) {
    for (std::size_t part = range.begin; part < range.end; ++part)
      for (std::size_t cell = part * share; cell < std::min((part + 1) * share, mesh.cell_count());
           ++cell)
        add_cell(mesh, static_cast<CellId>(cell), camera.eye, grid, extinction, parts[part]);
  });
  MeasuredDepth measured;
  double sum = 0, covered = 0;
  for (std::size_t ray = 0; ray < kRays; ++ray) {
    double met = 0;
    for (const std::vector<double>& depths : parts) {
      sum += depths[ray];
      met = std::max(met, depths[kRays + ray]);
    }
    covered += met;
  }
  measured.coverage = covered / static_cast<double>(kRays);
  measured.mean = covered > 0 ? sum / covered : 0;
  return measured;
}

}  // namespace hiac::starter

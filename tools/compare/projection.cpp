#include "tools/compare/projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/geometry/vector.hpp"
#include "hiac/scene/camera_motion.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::tools {
namespace {

// Pixels along the longer side of the small pictures that decide, and rays along a side of each.
constexpr std::uint32_t kSmallSide = 96, kSmallSamples = 2;
// A difference this small (root mean square) is what rounding to 8 bits and the like make.
constexpr double kLeastDifference = 2e-3;
// A projection is reported if it leaves at most this share of the difference.
constexpr double kClearlyBetter = 0.5;
// A scale that is further from 1 is a projection's; windows and samples make smaller ones.
constexpr double kLeastOwnScale = 0.02;
// Where the search begins: view angles in degrees (0: parallel), and sizes.
constexpr std::array kAngles{0.0, 8.0, 15.0, 22.0, 30.0, 38.0, 46.0, 56.0, 68.0, 82.0, 100.0};
constexpr std::array kSizes{0.25, 0.35, 0.5, 0.6,  0.7, 0.8, 0.9,
                            1.1,  1.25, 1.4, 1.65, 2.0, 3.0, 4.0};
// The search ends at this share of the interval that it began with.
constexpr double kNarrow = 1e-3;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// Half the height of what is seen at look_at, as a share of the eye's distance from there.
double half_height(const Camera& camera) {
  if (camera.projection == Projection::perspective) return std::tan(radians(camera.fov) / 2);
  return camera.height / 2 / length(view_direction(camera));
}

void set_angle(Camera& camera, double angle) {
  camera.projection = Projection::perspective;
  camera.fov = angle;
  camera.height = 0;
}

// The eye where it is; what is at look_at becomes larger or smaller.
Camera from_there(Camera camera, double angle) {
  set_angle(camera, angle);
  return camera;
}

Camera enlarged(Camera camera, double size) {
  camera.height /= size;
  return camera;
}

// What is at look_at keeps its size; the eye moves towards it or away. Planes of the slab stay.
Camera framed(Camera camera, double angle) {
  const std::array<double, 3> ahead = view_direction(camera);
  const double share = half_height(camera);  // of the distance
  if (angle == 0) {
    camera.projection = Projection::orthographic;
    camera.height = 2 * share * length(ahead);
    camera.fov = 0;
    return camera;
  }
  const double farther = share / std::tan(radians(angle) / 2);
  for (std::size_t c = 0; c < 3; ++c) camera.eye[c] = camera.look_at[c] - farther * ahead[c];
  if (camera.clip) {
    for (double& plane : *camera.clip) plane += (farther - 1) * length(ahead);
    (*camera.clip)[0] = std::max((*camera.clip)[0], 0.0);
  }
  set_angle(camera, angle);
  return camera;
}

// Cameras that differ by one number.
struct Family {
  Camera (*camera_of)(Camera view, double parameter);
  std::vector<double> parameters;  // ascending, where the search begins
};

std::vector<Family> families_of(const Camera& view) {
  std::vector<Family> families{{framed, {kAngles.begin(), kAngles.end()}},
                               {from_there, {kAngles.begin() + 1, kAngles.end()}}};
  if (view.projection == Projection::orthographic)
    families.push_back({enlarged, {kSizes.begin(), kSizes.end()}});
  return families;
}

// What is left of the difference in its place, without a misfit's orientation and encoding.
double left_in_place(const Misfit& misfit) {
  if (misfit.encoding) return misfit.encoding->rmse;
  return misfit.orientation ? misfit.orientation->rmse : misfit.rmse;
}

// The same without a shift and a scale.
double left_by(const Misfit& misfit) {
  double left = left_in_place(misfit);
  if (misfit.place) left *= misfit.place->rmse / misfit.place->rmse_before;
  return left;
}

// The same, but with the difference that a projection may explain in place of a scale.
double left_for_projection(Misfit misfit) {
  if (misfit.place && std::abs(misfit.place->scale - 1) >= kLeastOwnScale) misfit.place.reset();
  return left_by(misfit);
}

// Small pictures ----------------------------------------------------------------------------------

// How many pixels a side of a small picture's pixel has, and how many of these the picture has.
struct Blocks {
  std::uint32_t side, width, height;

  explicit Blocks(const Image& picture) {
    const auto w = static_cast<std::uint32_t>(picture.width());
    const auto h = static_cast<std::uint32_t>(picture.height());
    side = std::min({(std::max(w, h) + kSmallSide - 1) / kSmallSide, w, h});
    width = w / side;
    height = h / side;
  }
};

// How much of every pixel of a line belongs to a block that begins at `from`.
std::vector<std::pair<std::size_t, double>> shares(double from, double size) {
  std::vector<std::pair<std::size_t, double>> found;
  for (double at = std::floor(from); at < from + size; ++at) {
    const double share = std::min(at + 1, from + size) - std::max(at, from);
    if (share > 0) found.emplace_back(static_cast<std::size_t>(at), share / size);
  }
  return found;
}

// The means of blocks, of which as many as fit lie around the middle.
Image means_of(const Image& picture, const Blocks& blocks) {
  Image small(blocks.width, blocks.height, {picture.channels().begin(), picture.channels().end()});
  const double side = blocks.side;
  const double left = (static_cast<double>(picture.width()) - side * blocks.width) / 2;
  const double top = (static_cast<double>(picture.height()) - side * blocks.height) / 2;
  for (std::size_t j = 0; j < blocks.height; ++j) {
    const auto rows = shares(top + side * static_cast<double>(j), side);
    for (std::size_t i = 0; i < blocks.width; ++i) {
      const auto columns = shares(left + side * static_cast<double>(i), side);
      for (std::size_t c = 0; c < picture.channel_count(); ++c) {
        double sum = 0;
        for (const auto& [y, down] : rows)
          for (const auto& [x, across] : columns) sum += down * across * picture.at(x, y, c);
        small.at(i, j, c) = sum;
      }
    }
  }
  return small;
}

// The camera of the blocks, which together may be lower than the picture.
Camera of_blocks(const Camera& camera, const Image& picture, const Blocks& blocks) {
  return widened(camera, static_cast<double>(blocks.side) * blocks.height /
                             static_cast<double>(picture.height()));
}

// The search --------------------------------------------------------------------------------------

struct Found {
  double parameter;
  double left;
};

// The least value between two parameters, by golden sections (J. Kiefer, 1953).
template <typename Left>
Found least_between(double low, double high, const Left& left) {
  const double ratio = (std::sqrt(5.0) - 1) / 2, narrow = kNarrow * (high - low);
  Found a{high - ratio * (high - low), 0}, b{low + ratio * (high - low), 0};
  a.left = left(a.parameter);
  b.left = left(b.parameter);
  while (high - low > narrow) {
    if (a.left <= b.left) {
      high = b.parameter;
      b = a;
      a.parameter = high - ratio * (high - low);
      a.left = left(a.parameter);
    } else {
      low = a.parameter;
      a = b;
      b.parameter = low + ratio * (high - low);
      b.left = left(b.parameter);
    }
  }
  return a.left <= b.left ? a : b;
}

// The best one of a family: of the parameters where the search begins, then around that.
template <typename Left>
Found best_of(const std::vector<double>& parameters, const Left& left) {
  std::vector<double> values;
  for (const double parameter : parameters) values.push_back(left(parameter));
  const auto at = static_cast<std::size_t>(std::ranges::min_element(values) - values.begin());
  const Found first{parameters[at], values[at]};
  const double low = parameters[at == 0 ? 0 : at - 1];
  const double high = parameters[std::min(at + 1, parameters.size() - 1)];
  // parallel is no limit of small angles, from far away
  const double least = low == 0 ? parameters[1] / 4 : low;
  const Found refined = least_between(least, high, left);
  return refined.left < first.left ? refined : first;
}

}  // namespace

std::optional<ProjectionFit> find_projection(const Camera& view, const Image& picture,
                                             const Misfit& misfit, const DrawTruth& draw) {
  const double before = left_for_projection(misfit);
  if (!(before > kLeastDifference)) return std::nullopt;
  const Blocks blocks(picture);
  const Image small = means_of(picture, blocks);
  std::optional<Camera> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Family& family : families_of(view)) {
    const Found found = best_of(family.parameters, [&](double parameter) {
      const Camera camera = of_blocks(family.camera_of(view, parameter), picture, blocks);
      // in its place: a scale would make up for every view angle
      return left_in_place(
          find_misfit(small, draw(camera, {blocks.width, blocks.height}, kSmallSamples)));
    });
    if (found.left >= least) continue;
    least = found.left;
    best = family.camera_of(view, found.parameter);
  }
  if (!best || least > kClearlyBetter * before) return std::nullopt;
  const ImageSize size{static_cast<std::uint32_t>(picture.width()),
                       static_cast<std::uint32_t>(picture.height())};
  ProjectionFit fit{*best, find_misfit(picture, draw(*best, size, 1))};
  if (left_by(fit.misfit) > kClearlyBetter * before) return std::nullopt;
  return fit;
}

std::string line_of(const Camera& view, const ProjectionFit& fit, double rmse) {
  const Camera& found = fit.camera;
  const bool is_parallel = found.projection == Projection::orthographic;
  const double distance = length(view_direction(found));
  std::string what;
  if (is_parallel)
    what = fmt::format("in parallel projection, {:.4g} high", found.height);
  else
    what = fmt::format(
        "in perspective with a view angle of {:.1f} degrees, the eye {:.4g} from "
        "look_at",
        found.fov, distance);
  const std::string there =
      view.projection == Projection::orthographic
          ? fmt::format("parallel, {:.4g} high", view.height)
          : fmt::format("of {:.1f} degrees, from {:.4g}", view.fov, length(view_direction(view)));
  return fmt::format(
      "the picture is {} (the view is {}): RMSE {:.3g} as it is, {:.3g} against that", what, there,
      rmse, fit.misfit.rmse);
}

void put_into(nlohmann::ordered_json& facts, const ProjectionFit& fit, double rmse) {
  const bool is_parallel = fit.camera.projection == Projection::orthographic;
  facts["misfit"]["rmse"] = rmse;
  auto& found = facts["misfit"]["projection"];
  found = {{"name", is_parallel ? "orthographic" : "perspective"}};
  if (is_parallel)
    found["height"] = fit.camera.height;
  else
    found["fov"] = fit.camera.fov;
  found["eye"] = fit.camera.eye;
  found["rmse_without"] = fit.misfit.rmse;
}

}  // namespace hiac::tools

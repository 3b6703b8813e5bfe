#include "hiac/annotate/orientation_axes.hpp"

#include <memory>
#include <numeric>

#include "hiac/frame/projection.hpp"

namespace hiac {
namespace {

using Axes = std::array<SeenAxis, 3>;

/// Below this length of a unit vector on the screen an arrow has no direction that the eye could
/// see.
constexpr double kDot = 0.04;

/// Display values of the axes x, y, z: on a dark ground and on a light one.
constexpr std::array<Color, 3> kLight{{{1, 0.42, 0.38}, {0.45, 0.85, 0.42}, {0.5, 0.68, 1}}};
constexpr std::array<Color, 3> kDark{{{0.78, 0.08, 0.08}, {0.05, 0.45, 0.1}, {0.1, 0.2, 0.85}}};

/// Where an arrow's name is, from its tip: onwards, or where it is a dot away from the other
/// arrows.
CanvasPoint name_direction(const Axes& axes, std::size_t k) {
  double x = axes[k].x, y = axes[k].y;
  if (std::hypot(x, y) < kDot) {
    x = y = 0;
    for (std::size_t other = 0; other < 3; ++other)
      if (other != k) {
        x -= axes[other].x;
        y -= axes[other].y;
      }
  }
  const double size = std::hypot(x, y);
  return {x / size, y / size};
}

void draw_arrow(Canvas& canvas, CanvasPoint from, const SeenAxis& axis, double length,
                double thickness, const Color& color) {
  const double seen = std::hypot(axis.x, axis.y);
  if (seen < kDot) {
    canvas.segment(from, from, 2.6 * thickness, color);
    return;
  }
  const CanvasPoint along{axis.x / seen, axis.y / seen};
  const CanvasPoint tip{from.x + length * axis.x, from.y + length * axis.y};
  const double head = std::min(4.5 * thickness, 0.8 * length * seen), half = 0.42 * head;
  const CanvasPoint neck{tip.x - head * along.x, tip.y - head * along.y};
  canvas.segment(from, {neck.x + 0.1 * head * along.x, neck.y + 0.1 * head * along.y}, thickness,
                 color);
  const CanvasPoint corners[] = {tip,
                                 {neck.x - half * along.y, neck.y + half * along.x},
                                 {neck.x + half * along.y, neck.y - half * along.x}};
  canvas.polygon(corners, color);
}

}  // namespace

Axes seen_axes(const Camera& camera, ImageSize size) {
  const Projector projector(camera, size);
  Axes axes{};
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> unit{};
    unit[k] = 1;
    const auto [right, up, forward] = projector.camera_vector(unit);
    axes[k] = {right, -up, forward};
  }
  return axes;
}

AnnotationPart orientation_axes(const AxesAnnotation& wanted, const Scene& scene,
                                Lettering lettering) {
  const int side = std::max(1, static_cast<int>(std::lround(wanted.size.pixels(scene.image))));
  // names are at most a fifth of the square
  const int em = std::max(1, std::min(lettering.em, side / 5));
  const auto text = std::make_shared<const Text>(em);
  const Axes axes = seen_axes(scene.camera, scene.image);
  return {"axes", wanted.place, side, side, [=](Canvas& canvas, const Ink& ink) {
            const double middle = side / 2.0;
            const double length = middle - 1.05 * em - lettering.halo();
            const double thickness = std::max(1.5, side / 45.0);
            std::array<std::size_t, 3> order{};
            std::iota(order.begin(), order.end(), std::size_t{0});
            std::ranges::sort(order, [&](auto a, auto b) { return axes[a].away > axes[b].away; });
            for (const std::size_t k : order) {
              const Color& color = (ink.is_light ? kLight : kDark)[k];
              draw_arrow(canvas, {middle, middle}, axes[k], length, thickness, color);
              const CanvasPoint to = name_direction(axes, k);
              const double x = middle + length * axes[k].x + 0.6 * em * to.x;
              const double y = middle + length * axes[k].y + 0.6 * em * to.y;
              // lower-case letters are half an em high
              canvas.write(*text, x, 0.5, static_cast<int>(std::lround(y + 0.27 * em)),
                           std::string(1, "xyz"[k]), ink.text);
            }
          }};
}

}  // namespace hiac

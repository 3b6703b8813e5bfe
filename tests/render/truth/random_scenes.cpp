#include "tests/render/truth/random_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "hiac/frame/renderable.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac::test {
namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  // Even between two bounds.
  double real(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  // Even in the logarithm.
  double scale(double low, double high) { return std::exp(real(std::log(low), std::log(high))); }
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_);
  }
  bool chance(double probability) { return real(0, 1) < probability; }

 private:
  std::mt19937_64 engine_;
};

// Of any kind and order, bent as far as keeps the cells the right way out.
ZooMesh random_curved_mesh(Dice& dice) {
  ZooMesh mesh = [&] {
    switch (dice.below(6)) {
      case 0:
        return structured(1, Cut::bricks);
      case 1:
        return structured(1, Cut::prisms);
      case 2:
        return structured(1, Cut::pyramids);
      case 3:
        return two_wedges();
      case 4:
        return structured(1, Cut::tetrahedra);
      default:
        return mixed_columns(1);
    }
  }();
  const auto order = static_cast<CellOrder>(1 + dice.below(3));
  if (order != CellOrder::linear) mesh = of_order(mesh, order);
  for (double by = dice.scale(0.001, 0.08);; by *= 0.7) {
    const ZooMesh bent = moved(mesh, [by](const Position& p) { return rippled(p, by); });
    if (invalid_cells(bent, Scene{}.render.planarity).empty()) return bent;
  }
}

ZooMesh random_mesh(SceneCells cells, Dice& dice, std::uint64_t seed) {
  if (cells == SceneCells::curved) return random_curved_mesh(dice);
  if (cells == SceneCells::tetrahedra) {
    if (dice.chance(0.8)) return random_delaunay(8 + dice.below(dice.chance(0.2) ? 300 : 60), seed);
    return moved(structured(1 + dice.below(3), Cut::tetrahedra),
                 dice.chance(0.5) ? sheared : tapered);
  }
  const auto map = dice.chance(0.4) ? sheared : tapered;
  switch (dice.below(5)) {
    case 0:
      return moved(structured(1 + dice.below(3), Cut::bricks), map);
    case 1:
      return moved(structured(1 + dice.below(3), Cut::prisms), map);
    case 2:
      return moved(structured(1 + dice.below(2), Cut::pyramids), map);
    case 3:
      return moved(two_wedges(), map);
    default:
      return moved(mixed_columns(1 + dice.below(2)), map);
  }
}

// What the unit cube becomes.
struct Placement {
  Position shift;
  Position scale;

  [[nodiscard]] Position operator()(const Position& p) const {
    return {shift[0] + scale[0] * p[0], shift[1] + scale[1] * p[1], shift[2] + scale[2] * p[2]};
  }
};

// Other kinds' faces have to stay planar to within `planarity` when their corners are rounded.
Placement random_placement(SceneCells cells, Dice& dice) {
  const double size = dice.chance(0.7) ? 1 : dice.scale(1e-3, 1e3);
  Placement placement{{}, {size, size, size}};
  if (dice.chance(0.2)) placement.scale[dice.below(3)] *= dice.scale(1e-2, 1);
  if (dice.chance(0.35)) {
    const double far = size * dice.scale(1, cells == SceneCells::tetrahedra ? 1e6 : 1e3);
    for (double& x : placement.shift) x = far * dice.real(-1, 1);
  }
  return placement;
}

const std::array<std::string, 6> kFields{"f", "node", "cell", "corner", "far", "plane"};

void add_fields(ZooMesh& mesh, std::uint64_t seed) {
  add_node_field(mesh, "f", smooth_field);
  add_random_field(mesh, "node", FieldLocation::node, seed + 1);
  add_random_field(mesh, "cell", FieldLocation::cell, seed + 2);
  add_random_field(mesh, "corner", FieldLocation::corner, seed + 3);
  add_node_field(mesh, "plane", [](const Position& p) { return (p[0] + p[1] + 0.3 * p[2]) / 2.3; });
  add_node_field(mesh, "far", [](const Position& p) {
    return 300 + smooth_field({p[2], p[0], p[1]});
  });
}

double origin_of(const std::string& field) { return field == "far" ? 300 : 0; }

template <std::size_t N>
TransferFunction<N> random_function(const std::string& field, Dice& dice, double most) {
  TransferFunction<N> function{field, {}};
  const std::size_t count = 1 + dice.below(5);
  std::vector<double> scalars;
  for (std::size_t k = 0; k < count; ++k)
    scalars.push_back(origin_of(field) + dice.real(-0.1, 1.1));
  std::ranges::sort(scalars);
  const auto value = [&] {
    typename PiecewiseLinear<N>::Value v;
    for (double& x : v) x = dice.chance(0.15) ? 0 : dice.real(0, most);
    return v;
  };
  for (const double s : scalars) {
    function.points.push_back({s, value()});
    if (dice.chance(0.15)) function.points.push_back({s, value()});  // a jump
  }
  return function;
}

void set_camera(Scene& scene, const Placement& placement, Dice& dice) {
  Camera& camera = scene.camera;
  camera.projection = dice.chance(0.5) ? Projection::perspective : Projection::orthographic;
  const bool inside = camera.projection == Projection::perspective && dice.chance(0.12);
  const auto from_middle = [&](double reach) {
    Position p;
    for (double& x : p) x = 0.5 + dice.real(-reach, reach);
    return p;
  };
  const Position target = from_middle(0.4);
  Position eye = from_middle(inside ? 0.4 : 4);
  if (dice.chance(0.1)) {  // along an axis
    eye = target;
    eye[dice.below(3)] += dice.chance(0.5) ? 3 : -3;
  }
  camera.eye = placement(eye);
  camera.look_at = placement(target);
  camera.up = {dice.real(-1, 1), dice.real(-1, 1), dice.real(-1, 1)};
  camera.fov = inside ? 95 : dice.real(20, 70);
  const double widest = std::ranges::max(placement.scale);
  camera.height = widest * dice.real(0.8, 2);
  if (dice.chance(0.15)) {
    double away = 0;
    for (std::size_t k = 0; k < 3; ++k) away += std::pow(camera.look_at[k] - camera.eye[k], 2);
    away = std::sqrt(away);
    camera.clip = {{away * dice.real(0.7, 1), away * dice.real(1, 1.3)}};
  }
}

void add_surfaces(Scene& scene, Dice& dice) {
  const std::size_t count = 1 + dice.below(5);
  const std::array<std::string, 2> fields{kFields[dice.below(kFields.size())],
                                          kFields[dice.below(kFields.size())]};
  for (std::size_t k = 0; k < count; ++k) {
    Isosurface surface;
    surface.field = fields[dice.below(2)];
    surface.value = origin_of(surface.field) + dice.real(0, 1);
    surface.color = {dice.real(0, 1), dice.real(0, 1), dice.real(0, 1)};
    surface.opacity = dice.chance(0.1) ? 1 : dice.real(0, 1);
    if (dice.chance(0.3)) surface.specular = 0;
    surface.shininess = dice.chance(0.7) ? dice.real(1, 60) : dice.real(0.2, 1);
    scene.isosurfaces.push_back(surface);
  }
  if (dice.chance(0.3))
    scene.lights = {Light{{{dice.real(-1, 1), dice.real(-1, 1), 0.5}}, {0.9, 0.8, 0.7}},
                    Light{{}, {0.2, 0.2, 0.4}}};
}

}  // namespace

RandomScene random_scene(SceneCells cells, std::uint64_t seed, std::uint32_t side) {
  Dice dice(seed);
  RandomScene result{random_mesh(cells, dice, seed), {}};
  Scene& scene = result.scene;
  add_fields(result.mesh, seed);
  const Placement placement = random_placement(cells, dice);
  result.mesh = moved(result.mesh, placement);
  scene.image = {side, side - side / 5};
  set_camera(scene, placement, dice);
  if (dice.chance(0.4)) scene.volume.glow = Glow::emission;
  const std::string color = kFields[dice.below(kFields.size())];
  const std::string extinction = dice.chance(0.5) ? color : kFields[dice.below(kFields.size())];
  const double longest = std::ranges::max(placement.scale);
  scene.volume.color =
      random_function<3>(color, dice, scene.volume.glow == Glow::emission ? 1 / longest : 1);
  scene.volume.extinction = random_function<1>(extinction, dice, dice.scale(0.02, 300) / longest);
  if (dice.chance(0.05)) scene.volume.extinction.reset();
  if (dice.chance(0.6)) add_surfaces(scene, dice);
  scene.render.tolerance = dice.chance(0.8) ? 1e-9 : dice.scale(1e-14, 1e-3);
  scene.background.color = {dice.real(0, 1), dice.real(0, 1), dice.real(0, 1)};
  return result;
}

}  // namespace hiac::test

// How the picture of a smooth field converges as cells of every kind get smaller: the largest and
// the mean error of any channel against the field itself (cubic tetrahedra far finer than all),
// and the order of convergence from one mesh to the next.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "hiac/render/engine.hpp"
#include "tests/render/general_meshes.hpp"

namespace hiac {
namespace {

using test::Cut;

double smooth(const test::Position& p) {
  return 0.5 + 0.28 * std::sin(2.2 * p[0] + 0.7 * p[1]) * std::cos(1.7 * p[2] - 0.9 * p[1] + 0.4);
}

Image picture(std::size_t n, Cut cut, CellOrder order) {
  ZooMesh mesh = test::of_order(test::moved(test::structured(n, cut), test::sheared), order);
  test::add_node_field(mesh, "f", smooth);
  Scene scene = test::cube_scene(Projection::perspective, 64, 56);
  // without bends: they are lines that every mesh places, not errors of interpolation
  scene.volume.color->points = {{0, {0.1, 0.2, 0.9}}, {1, {0.9, 0.6, 0.1}}};
  scene.volume.extinction->points = {{0, {0.5}}, {1, {4}}};
  scene.render.tolerance = 1e-12;
  return test::draw(mesh, scene).image;
}

struct Errors {
  double largest = 0, mean = 0;
};

Errors errors_of(const Image& image, const Image& exact) {
  Errors errors;
  std::size_t covered = 0;
  for (std::uint32_t y = 0; y < image.height(); ++y)
    for (std::uint32_t x = 0; x < image.width(); ++x) {
      if (exact.at(x, y, 3) == 0) continue;
      ++covered;
      double here = 0;
      for (std::size_t c = 0; c < 4; ++c)
        here = std::max(here, std::abs(image.at(x, y, c) - exact.at(x, y, c)));
      errors.largest = std::max(errors.largest, here);
      errors.mean += here;
    }
  errors.mean /= static_cast<double>(covered);
  return errors;
}

struct Kind {
  const char* name;
  Cut cut;
};

void print_table() {
  const Image exact = picture(20, Cut::tetrahedra, CellOrder::cubic);
  constexpr std::array<Kind, 4> kKinds{{{"tetrahedra", Cut::tetrahedra},
                                        {"pyramids", Cut::pyramids},
                                        {"prisms", Cut::prisms},
                                        {"bricks", Cut::bricks}}};
  for (const auto& [name, cut] : kKinds)
    for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic, CellOrder::cubic}) {
      Errors before;
      for (const std::size_t n : {1U, 2U, 4U, 8U}) {
        const Errors e = errors_of(picture(n, cut, order), exact);
        fmt::print("| {} | {} | {} | {:.1e} | {:.1e} |", name, static_cast<int>(order), n,
                   e.largest, e.mean);
        if (n == 1)
          fmt::print(" |\n");
        else
          fmt::print(" {:.1f} |\n", std::log2(before.mean / e.mean));
        before = e;
      }
    }
}

}  // namespace
}  // namespace hiac

int main() {
  fmt::print("| cells | order | per edge | largest error | mean error | order of convergence |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  hiac::print_table();
}

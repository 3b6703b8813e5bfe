// How the picture of a smooth field converges as cells of every kind get smaller: the largest and
// the mean error of any channel against the field itself (cubic tetrahedra far finer than all),
// and the order of convergence from one mesh to the next. Then, what of it is left where bricks are
// distorted, with fields interpolated isoparametrically and by polynomials in the world.

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "hiac/render/engine.hpp"
#include "tests/render/general_meshes.hpp"

namespace hiac {
namespace {

using test::Cut;

double smooth(const test::Position& p) {
  return 0.5 + 0.28 * std::sin(2.2 * p[0] + 0.7 * p[1]) * std::cos(1.7 * p[2] - 0.9 * p[1] + 0.4);
}

Image picture(const ZooMesh& linear, CellOrder order,
              Interpolation interpolation = Interpolation::isoparametric) {
  ZooMesh mesh = test::of_order(linear, order);
  test::add_node_field(mesh, "f", smooth);
  Scene scene = test::cube_scene(Projection::perspective, 64, 56);
  // without bends: they are lines that every mesh places, not errors of interpolation
  scene.volume.color->points = {{0, {0.1, 0.2, 0.9}}, {1, {0.9, 0.6, 0.1}}};
  scene.volume.extinction->points = {{0, {0.5}}, {1, {4}}};
  scene.render.tolerance = 1e-12;
  scene.render.interpolation = interpolation;
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

ZooMesh sheared_cells(CellShape shape, std::size_t n) {
  switch (shape) {
    case CellShape::tetrahedron:
      return test::moved(test::structured(n, Cut::tetrahedra), test::sheared);
    case CellShape::pyramid:
      return test::moved(test::structured(n, Cut::pyramids), test::sheared);
    case CellShape::prism:
      return test::moved(test::structured(n, Cut::prisms), test::sheared);
    case CellShape::wedge:
      return test::moved(test::wedge_grid(n), test::sheared);
    case CellShape::brick:
      break;
  }
  return test::moved(test::structured(n, Cut::bricks), test::sheared);
}

std::string plural(CellShape shape) {
  return shape == CellShape::tetrahedron ? "tetrahedra"
                                         : fmt::format("{}s", topology_of(shape).name);
}

void print_kinds() {
  const Image exact = picture(sheared_cells(CellShape::tetrahedron, 20), CellOrder::cubic);
  fmt::print("| cells | order | per edge | largest error | mean error | order of convergence |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (std::size_t shape = 0; shape < kShapeCount; ++shape)
    for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic, CellOrder::cubic}) {
      Errors before;
      for (const std::size_t n : {1U, 2U, 4U, 8U}) {
        const auto cells = static_cast<CellShape>(shape);
        const Errors e = errors_of(picture(sheared_cells(cells, n), order), exact);
        fmt::print("| {} | {} | {} | {:.1e} | {:.1e} |", plural(cells), static_cast<int>(order), n,
                   e.largest, e.mean);
        if (n == 1)
          fmt::print(" |\n");
        else
          fmt::print(" {:.1f} |\n", std::log2(before.mean / e.mean));
        before = e;
      }
    }
}

// Bricks whose corners inside are moved by a part of their size, by both interpolations. The field
// itself, drawn from fine tetrahedra, has nothing to do with the bricks.
void print_interpolations() {
  const ZooMesh fine = test::structured(20, Cut::tetrahedra);
  const Image exact = picture(fine, CellOrder::cubic);
  fmt::print(
      "\n| order | per edge | moved by | isoparametric: largest | mean | polynomial: largest | "
      "mean "
      "|\n|---|---|---|---|---|---|---|\n");
  for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic})
    for (const std::size_t n : {2U, 4U, 8U})
      for (const double part : {0.0, 0.05, 0.15, 0.25}) {
        const ZooMesh mesh =
            test::moved(test::structured(n, Cut::bricks), [&](const test::Position& p) {
              return test::warped(p, part / static_cast<double>(n));
            });
        const Errors one = errors_of(picture(mesh, order), exact);
        const Errors other = errors_of(picture(mesh, order, Interpolation::polynomial), exact);
        fmt::print("| {} | {} | {:.0f} % | {:.1e} | {:.1e} | {:.1e} | {:.1e} |\n",
                   static_cast<int>(order), n, 100 * part, one.largest, one.mean, other.largest,
                   other.mean);
      }
}

}  // namespace
}  // namespace hiac

int main() {
  hiac::print_kinds();
  hiac::print_interpolations();
}

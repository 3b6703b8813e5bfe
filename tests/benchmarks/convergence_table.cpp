// How the picture of a smooth field converges as cells of every kind get smaller: the largest and
// the mean error of any channel against the field itself (cubic tetrahedra far finer than all),
// and the order of convergence of the mean from one mesh to the next, with fields interpolated
// isoparametrically and by polynomials in the world. Then, what of it is left where cells are
// distorted.

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include <fmt/format.h>

#include "hiac/render/engine.hpp"
#include "tests/render/truth/general_meshes.hpp"

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

ZooMesh cells_of(CellShape shape, std::size_t n) {
  switch (shape) {
    case CellShape::tetrahedron:
      return test::structured(n, Cut::tetrahedra);
    case CellShape::pyramid:
      return test::structured(n, Cut::pyramids);
    case CellShape::prism:
      return test::structured(n, Cut::prisms);
    case CellShape::wedge:
      return test::wedge_grid(n);
    case CellShape::brick:
      break;
  }
  return test::structured(n, Cut::bricks);
}

ZooMesh moved_cells(CellShape shape, std::size_t n,
                    const std::function<test::Position(const test::Position&)>& map) {
  return test::moved(cells_of(shape, n), map);
}

std::string plural(CellShape shape) {
  return shape == CellShape::tetrahedron ? "tetrahedra"
                                         : fmt::format("{}s", topology_of(shape).name);
}

// Rows of a table, one for each mesh: what they begin with, and for each interpolation the errors
// and the order of convergence.
void print_convergence(const std::string& begin, CellOrder order, const Image& exact,
                       std::span<const std::size_t> counts,
                       const std::function<ZooMesh(std::size_t)>& mesh_of) {
  constexpr std::array kInterpolations{Interpolation::isoparametric, Interpolation::polynomial};
  std::array<Errors, kInterpolations.size()> before;
  for (const std::size_t n : counts) {
    const ZooMesh mesh = mesh_of(n);
    fmt::print("| {} | {} | {} |", begin, static_cast<int>(order), n);
    for (std::size_t i = 0; i < kInterpolations.size(); ++i) {
      const Errors e = errors_of(picture(mesh, order, kInterpolations[i]), exact);
      fmt::print(" {:.1e} | {:.1e} |", e.largest, e.mean);
      if (n == counts.front())
        fmt::print(" |");
      else
        fmt::print(" {:.1f} |", std::log2(before[i].mean / e.mean));
      before[i] = e;
    }
    fmt::print("\n");
  }
}

constexpr const char* kErrors =
    "isoparametric: largest error | mean error | order of convergence | "
    "polynomial: largest error | mean error | order of convergence |";

void print_kinds() {
  constexpr std::array<std::size_t, 4> kCounts{1, 2, 4, 8};
  const Image exact =
      picture(moved_cells(CellShape::tetrahedron, 20, test::sheared), CellOrder::cubic);
  fmt::print("| cells | order | per edge | {}\n|---|---|---|---|---|---|---|---|---|\n", kErrors);
  for (std::size_t shape = 0; shape < kShapeCount; ++shape)
    for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic, CellOrder::cubic}) {
      const auto cells = static_cast<CellShape>(shape);
      print_convergence(plural(cells), order, exact, kCounts,
                        [&](std::size_t n) { return moved_cells(cells, n, test::sheared); });
    }
}

constexpr double kMoved = 0.15;

// Cells of all shapes whose corners inside are moved by a part of a cube's size.
void print_distorted_kinds() {
  constexpr std::array<std::size_t, 3> kCounts{2, 4, 8};
  const Image exact = picture(test::structured(20, Cut::tetrahedra), CellOrder::cubic);
  fmt::print(
      "\n| moved by | cells | order | per edge | {}\n|---|---|---|---|---|---|---|---|---|---|\n",
      kErrors);
  for (std::size_t shape = 0; shape < kShapeCount; ++shape)
    for (const CellOrder order : {CellOrder::quadratic, CellOrder::cubic}) {
      const auto cells = static_cast<CellShape>(shape);
      print_convergence(fmt::format("{:.0f} % | {}", 100 * kMoved, plural(cells)), order, exact,
                        kCounts, [&](std::size_t n) {
                          return moved_cells(cells, n, [&](const test::Position& p) {
                            return test::warped(p, kMoved / static_cast<double>(n));
                          });
                        });
    }
}

// Bricks whose corners inside are moved by a part of their size, by both interpolations. The field
// itself, drawn from fine tetrahedra, has nothing to do with the bricks.
void print_interpolations() {
  const ZooMesh fine = test::structured(20, Cut::tetrahedra);
  const Image exact = picture(fine, CellOrder::cubic);
  fmt::print(
      "\n| order | per edge | moved by | isoparametric: largest | mean | polynomial: largest | "
      "mean |\n"
      "|---|---|---|---|---|---|---|\n");
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
  hiac::print_distorted_kinds();
  hiac::print_interpolations();
}

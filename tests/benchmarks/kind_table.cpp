// What a ray segment costs in cells of every kind: nanoseconds of processor time, in affine cells
// and in cells that are not, and how many times as much as in linear tetrahedra. kind_table SHAPE
// has one shape's rows alone.

#include <algorithm>
#include <array>
#include <ctime>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "hiac/base/parallel.hpp"
#include "hiac/render/engine.hpp"
#include "tests/render/general_meshes.hpp"

namespace hiac {
namespace {

using test::Cut;

// Nanoseconds a segment, the least of several pictures.
double cost(const ZooMesh& linear, CellOrder order, test::Position (*map)(const test::Position&)) {
  ZooMesh mesh = test::of_order(test::moved(linear, map), order);
  test::add_node_field(mesh, "f", test::smooth_field);
  Scene scene = test::cube_scene(Projection::perspective, 384, 336);
  scene.render.tolerance = 1e-9;
  const VisibilityOrder sorted = test::sorted(mesh, scene);
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 3; ++run) {
    const std::clock_t start = std::clock();
    const auto segments = render(mesh, sorted, scene, false).statistics.segments;
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    least = std::min(least, 1e9 * seconds / static_cast<double>(segments));
  }
  return least;
}

struct Mesh {
  const char* name;
  ZooMesh mesh;
};

void print_table(const std::string& shape) {
  const ThreadLimit limit(1);
  const std::array<Mesh, 5> meshes{{{"tetrahedron", test::structured(3, Cut::tetrahedra)},
                                    {"pyramid", test::structured(3, Cut::pyramids)},
                                    {"prism", test::structured(3, Cut::prisms)},
                                    {"wedge", test::two_wedges()},
                                    {"brick", test::structured(3, Cut::bricks)}}};
  const double unit = cost(meshes[0].mesh, CellOrder::linear, test::sheared);
  for (const auto& [name, mesh] : meshes) {
    if (!shape.empty() && shape != name) continue;
    for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic, CellOrder::cubic}) {
      const double affine = cost(mesh, order, test::sheared);
      const double tapered = cost(mesh, order, test::tapered);
      fmt::print("| {} | {} | {:.0f} ns | {:.1f} | {:.0f} ns | {:.1f} |\n", name,
                 static_cast<int>(order), affine, affine / unit, tapered, tapered / unit);
    }
  }
}

}  // namespace
}  // namespace hiac

int main(int count, char** arguments) {
  fmt::print("| cell | order | affine | times | tapered | times |\n|---|---|---|---|---|---|\n");
  hiac::print_table(count > 1 ? arguments[1] : "");
}

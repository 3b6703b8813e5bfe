// What a ray segment costs in cells of every kind: nanoseconds of processor time, in affine cells
// and in cells that are not, and how many times as much as in linear tetrahedra.
//
//   kind_table [SHAPE [N]]     one shape's rows alone; N cells to an edge of the cube (3)

#include <algorithm>
#include <array>
#include <ctime>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "hiac/base/parallel.hpp"
#include "hiac/render/engine.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

using test::Cut;

// A mesh to be drawn again and again.
class Trial {
 public:
  Trial(const ZooMesh& linear, CellOrder order, test::Position (*map)(const test::Position&))
      : mesh_(test::of_order(test::moved(linear, map), order)),
        scene_(test::cube_scene(Projection::perspective, 384, 336)) {
    test::add_node_field(mesh_, "f", test::smooth_field);
    scene_.render.tolerance = 1e-9;
    order_ = test::sorted(mesh_, scene_);
  }

  void run() {
    const std::clock_t start = std::clock();
    const auto segments = render(mesh_, order_, scene_, false).statistics.segments;
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    least_ = std::min(least_, 1e9 * seconds / static_cast<double>(segments));
  }

  // Nanoseconds a segment, the least of all runs.
  [[nodiscard]] double cost() const { return least_; }

 private:
  ZooMesh mesh_;
  Scene scene_;
  VisibilityOrder order_;
  double least_ = std::numeric_limits<double>::infinity();
};

struct Mesh {
  const char* name;
  ZooMesh mesh;
};

void print_table(const std::string& shape, std::size_t n) {
  const ThreadLimit limit(1);
  const std::array<Mesh, 5> meshes{{{"tetrahedron", test::structured(n, Cut::tetrahedra)},
                                    {"pyramid", test::structured(n, Cut::pyramids)},
                                    {"prism", test::structured(n, Cut::prisms)},
                                    {"wedge", test::wedge_grid(n)},
                                    {"brick", test::structured(n, Cut::bricks)}}};
  for (const auto& [name, mesh] : meshes) {
    if (!shape.empty() && shape != name) continue;
    for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic, CellOrder::cubic}) {
      // in turn, as what else the machine does changes what all of them cost
      Trial unit(meshes[0].mesh, CellOrder::linear, test::sheared);
      Trial affine(mesh, order, test::sheared), tapered(mesh, order, test::tapered);
      for (int run = 0; run < 5; ++run)
        for (Trial* trial : {&unit, &affine, &tapered}) trial->run();
      fmt::print("| {} | {} | {:.0f} ns | {:.1f} | {:.0f} ns | {:.1f} |\n", name,
                 static_cast<int>(order), affine.cost(), affine.cost() / unit.cost(),
                 tapered.cost(), tapered.cost() / unit.cost());
    }
  }
}

}  // namespace
}  // namespace hiac

int main(int count, char** arguments) {
  fmt::print("| cell | order | affine | times | tapered | times |\n|---|---|---|---|---|---|\n");
  hiac::print_table(count > 1 ? arguments[1] : "", count > 2 ? std::stoul(arguments[2]) : 3);
}

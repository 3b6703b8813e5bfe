// A picture of one tetrahedron, by the library as it is installed: read, order, render, write.
#include "hiac/image/image_io.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/scene_parser.hpp"

int main(int, char** argv) {
  const hiac::Scene scene = hiac::read_scene(argv[1]).scene;
  hiac::ZooMesh mesh{.elems = std::vector<std::uint64_t>{0, 4},
                     .nodes = std::vector<hiac::NodeId>{0, 1, 2, 3},
                     .xyz = std::vector<double>{-1, -1, -1, 1, -1, -1, 0, 1, -1, 0, 0, 1},
                     .kinds = std::vector{hiac::CellKind::tetrahedron4}};
  mesh.fields.push_back({"s", "", hiac::FieldLocation::node, 1, std::vector<double>{0, 0, 0, 1}});
  const hiac::View view{true, scene.camera.eye, {}};
  const auto result = hiac::exact_order(mesh, hiac::build_face_adjacency(mesh), view, 1e-10);
  const auto picture = hiac::render(mesh, result.order, scene, true);
  hiac::write_image(argv[2], picture.image);
  return picture.statistics.covered_pixels > 0 ? 0 : 1;
}

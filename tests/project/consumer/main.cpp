// consumer MESH.zoo: writes a mesh of one tetrahedron by the library as it is installed, for the
// sample program to draw.
#include "hiac/base/version.hpp"
#include "hiac/mesh/zoo_container.hpp"

int main(int, char** argv) {
  if (hiac::library_version() != HIAC_VERSION) return 1;
  hiac::ZooMesh mesh{.elems = std::vector<std::uint64_t>{0, 4},
                     .nodes = std::vector<hiac::NodeId>{0, 1, 2, 3},
                     .xyz = std::vector<double>{-1, -1, -1, 1, -1, -1, 0, 1, -1, 0, 0, 1},
                     .kinds = std::vector{hiac::CellKind::tetrahedron4}};
  mesh.fields.push_back({"s", "", hiac::FieldLocation::node, 1, std::vector<double>{0, 0, 0, 1}});
  hiac::write_zoo_file(argv[1], {mesh, {}});
}

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::test {

/// Small files with three time steps: still.msh, of one geometry; moving.pvd, whose nodes move; and
/// a specification whose range is left to the values.
class StepFiles : public ToolFolder {
 protected:
  static constexpr std::size_t kSteps = 3;

  void SetUp() override {
    ToolFolder::SetUp();
    write("still.msh", msh());
    std::string sets;
    for (std::size_t k = 0; k < kSteps; ++k) {
      const double shift = 0.2 * static_cast<double>(k);
      const ZooMesh mesh = moved(mesh_of_step(k), [&](const Position& p) {
        return Position{p[0] + shift, p[1], p[2]};
      });
      const std::string name = fmt::format("part{}", k);
      write_zoo_file(file(name + ".zoo"), {mesh, {}});
      ASSERT_EQ(run(fmt::format("$CONVERT -q {0}.zoo -o {0}.vtu", name)), 0) << complaint();
      sets += fmt::format("<DataSet timestep='{}' part='0' file='{}.vtu'/>\n", time_of(k), name);
    }
    write("moving.pvd",
          "<?xml version='1.0'?>\n<VTKFile type='Collection' version='0.1'>\n<Collection>\n" +
              sets + "</Collection>\n</VTKFile>\n");
    write("view.toml", view("range = 'auto'"));
  }

  void write(const std::string& name, const std::string& text) const {
    (void)folder_.write(name, text);
  }

  /// The value of the field T at a node and a step: its range grows and shrinks.
  static double value_at(const Position& p, std::size_t step) {
    const double height = step == 1 ? 3 : 1 + static_cast<double>(step);
    return height * (p[0] + 0.3 * p[1] * p[2]) - 0.25 * static_cast<double>(step);
  }

  static double time_of(std::size_t step) { return 0.5 * static_cast<double>(step); }

  static ZooMesh mesh_of_step(std::size_t step) {
    ZooMesh mesh = structured(2, Cut::tetrahedra);
    add_node_field(mesh, "T", [&](const Position& p) { return value_at(p, step); });
    return mesh;
  }

  static std::string view(const std::string& range, const std::string& camera = "") {
    return "[image]\nwidth = 31\nheight = 22\n"
           "[camera]\nprojection = 'perspective'\neye = [2.5, -2, 1.5]\nlook_at = [0.6, 0.5, 0.5]\n"
           "up = [0, 0, 1]\nfov = 40\n" +
           camera + "[volume.color]\nfield = 'T'\npreset = 'viridis'\n" + range +
           "\n[volume.extinction]\nfield = 'T'\npoints = [[0, 0.5], [1, 4]]\n" + range +
           "\n[background]\ncolor = [0.2, 0.1, 0.4]\n";
  }

 private:
  /// Gmsh 2.2 with two groups, "left" and "right".
  static std::string msh() {
    const ZooMesh mesh = mesh_of_step(0);
    std::string text =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"left\"\n3 2 \"right\"\n"
        "$EndPhysicalNames\n";
    text += fmt::format("$Nodes\n{}\n", mesh.node_count());
    for (NodeId node = 0; node < mesh.node_count(); ++node) {
      const auto at = mesh.position(node);
      text += fmt::format("{} {} {} {}\n", node + 1, at[0], at[1], at[2]);
    }
    text += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.cell_count());
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
      const auto nodes = mesh.cell_nodes(cell);
      const int group = 2 * cell < mesh.cell_count() ? 1 : 2;
      text += fmt::format("{} 4 2 {} {} {} {} {} {}\n", cell + 1, group, group, nodes[0] + 1,
                          nodes[1] + 1, nodes[2] + 1, nodes[3] + 1);
    }
    text += "$EndElements\n";
    for (std::size_t step = 0; step < kSteps; ++step) {
      text += fmt::format("$NodeData\n1\n\"T\"\n1\n{}\n3\n{}\n1\n{}\n", time_of(step), step,
                          mesh.node_count());
      const std::vector<Position> positions = positions_of(mesh);
      for (std::size_t node = 0; node < positions.size(); ++node)
        text += fmt::format("{} {}\n", node + 1, value_at(positions[node], step));
      text += "$EndNodeData\n";
    }
    return text;
  }
};

}  // namespace hiac::test

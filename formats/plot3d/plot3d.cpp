#include "formats/plot3d/plot3d.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include <fmt/format.h>

#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/steps.hpp"
#include "formats/common/mesh/structured.hpp"
#include "formats/plot3d/index_file.hpp"
#include "formats/plot3d/sections.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

using plot3d::Grid;
using plot3d::Solution;

/// The variables of a solution that form one field: from `first` on.
struct Variables {
  std::string name;
  std::size_t first;
  std::size_t count;
};

std::vector<Variables> q_variables(std::size_t count) {
  std::vector<Variables> variables{
      {"Density", 0, 1}, {"Momentum", 1, 3}, {"StagnationEnergy", 4, 1}};
  if (count > 5) variables.push_back({"Gamma", 5, 1});
  for (std::size_t v = 6; v < count; ++v)
    variables.push_back({fmt::format("Variable {}", v + 1), v, 1});
  return variables;
}

std::vector<Variables> functions(std::size_t count, const std::vector<std::string>& names) {
  std::vector<Variables> variables;
  for (std::size_t v = 0; v < count; ++v)
    variables.push_back({v < names.size() ? names[v] : fmt::format("Function{}", v), v, 1});
  return variables;
}

void add_fields(const std::shared_ptr<const Solution>& solution,
                const std::vector<Variables>& variables, std::optional<std::size_t> step,
                ForeignMesh& mesh) {
  for (const Variables& chosen : variables) {
    ForeignField field;
    field.name = chosen.name;
    field.components = static_cast<std::uint32_t>(chosen.count);
    field.step = step;
    field.type = "real";
    field.values = [solution, chosen] {
      std::vector<double> values;
      for (std::size_t b = 0; b < solution->values.size(); ++b) {
        const std::vector<double>& all = solution->values[b];
        const std::size_t points = all.size() / solution->variables[b];
        for (std::size_t p = 0; p < points; ++p)
          for (std::size_t c = 0; c < chosen.count; ++c)
            values.push_back(all[(chosen.first + c) * points + p]);
      }
      return values;
    };
    mesh.fields.push_back(std::move(field));
  }
}

/// The number of variables that every block has.
std::size_t common_count(const Solution& solution) {
  return *std::min_element(solution.variables.begin(), solution.variables.end());
}

void add_blocks(const Grid& grid, const std::string& subject, ForeignMesh& mesh) {
  std::size_t hidden_cells = 0;
  for (std::size_t b = 0; b < grid.blocks.size(); ++b) {
    const auto& extents = grid.blocks[b];
    const StructuredBlock block{extents};
    const std::size_t points = block.point_count();
    const std::size_t first = mesh.point_count();
    if (first + points > kNoCell) throw InputError(subject, "has too many points");
    const std::vector<double>& xyz = grid.coordinates[b];
    for (std::size_t p = 0; p < points; ++p)
      mesh.xyz.insert(mesh.xyz.end(), {xyz[p], xyz[points + p], xyz[2 * points + p]});
    std::vector<bool> hidden;
    if (!grid.iblank.empty())
      for (const std::int32_t blank : grid.iblank[b]) hidden.push_back(blank == 0);
    const std::size_t cells = mesh.cell_count();
    add_bricks(mesh, block, first, hidden,
               grid.blocks.size() > 1 ? fmt::format("block {}", b + 1) : "");
    hidden_cells += block.cell_count() - (mesh.cell_count() - cells);
  }
  if (hidden_cells > 0)
    mesh.notes.push_back(fmt::format("left out {} cells that IBLANK hides", hidden_cells));
}

ForeignMesh plot3d_mesh(const std::string& path, const ReadOptions& options) {
  const plot3d::FileSet files = plot3d::files_of(path);
  ForeignMesh mesh;
  std::optional<std::size_t> step;
  if (files.steps.size() > 1)
    for (const plot3d::StepFiles& one : files.steps) mesh.times.push_back(one.time);
  if (files.steps.size() > 1)
    step = requested_step(options, mesh.times, path).value_or(files.steps.size() - 1);
  const plot3d::StepFiles& chosen = files.steps[step.value_or(0)];
  const Grid grid = plot3d::read_grid(chosen.grid);
  add_blocks(grid, chosen.grid, mesh);
  if (!chosen.q.empty()) {
    const auto q = std::make_shared<const Solution>(plot3d::read_q(chosen.q, grid.blocks));
    add_fields(q, q_variables(common_count(*q)), step, mesh);
  }
  if (!chosen.function.empty()) {
    const auto function =
        std::make_shared<const Solution>(plot3d::read_function(chosen.function, grid.blocks));
    add_fields(function, functions(common_count(*function), files.function_names), step, mesh);
  }
  return mesh;
}

}  // namespace

Format plot3d_format() {
  Format format;
  format.name = "plot3d";
  format.extensions = {".xyz", ".x", ".g", ".grd", ".p3d", ".bin", ".p3dfmt"};
  format.kinds = "brick8 and its degenerate ones";
  format.fields = "node";
  format.time_steps = "several (.p3d)";
  format.recognizes = plot3d::may_be_index;
  format.plausible = plot3d::may_be_grid;
  read_through(format, plot3d_mesh);
  return format;
}

}  // namespace hiac::formats

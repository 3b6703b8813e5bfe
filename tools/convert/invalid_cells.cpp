#include "tools/convert/invalid_cells.hpp"

#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/mesh/parts/keep_cells.hpp"
#include "hiac/tetrahedralize/cut_cells.hpp"

namespace hiac::tools {
namespace {

void refuse(const std::string& subject, const ZooMesh& mesh, double planarity) {
  try {
    require_valid_cells(mesh, planarity);
  } catch (const InvalidCellError& error) {
    throw InputError(subject, fmt::format("{}; --invalid skip leaves such cells out, --invalid cut "
                                          "divides them into tetrahedra",
                                          error.what()));
  }
}

}  // namespace

void treat_invalid_cells(Tool& tool, InvalidCellsFate fate, const std::string& subject,
                         ZooMesh& mesh) {
  // what a specification that does not say otherwise draws
  const double planarity = Scene{}.render.planarity;
  if (fate == InvalidCellsFate::refuse) return refuse(subject, mesh, planarity);
  const std::vector<CellId> cells = invalid_cells(mesh, planarity);
  auto& facts = tool.facts()["invalid_cells"];
  facts["count"] = cells.size();
  if (cells.empty()) return;
  const std::string which =
      fmt::format("{} of {} cells are partly turned inside out", cells.size(), mesh.cell_count());
  if (fate == InvalidCellsFate::skip) {
    std::vector<bool> keep(mesh.cell_count(), true);
    for (const CellId cell : cells) keep[cell] = false;
    tool.warn(fmt::format("{} and are left out, the first is cell {}: the mesh has holes there",
                          which, cells.front()));
    mesh = keep_cells(mesh, keep);
    if (mesh.cell_count() == 0) throw InputError(subject, "has no other cells");
    return;
  }
  CutMesh cut = cut_cells(mesh, cells);
  const double relative = cut.volume > 0 ? cut.volume_change / cut.volume : 0;
  tool.note(
      fmt::format("{} and became {} tetrahedra, the first is cell {}: that changes the "
                  "volume by {:.3g} in all, {:.3g} of the mesh's {:.6g}",
                  which, cut.tetrahedra, cells.front(), cut.volume_change, relative, cut.volume));
  if (cut.vanished > 0)
    tool.warn(
        fmt::format("{} of them are so tangled that no tetrahedron is left of them", cut.vanished));
  facts["tetrahedra"] = cut.tetrahedra;
  facts["volume_change"] = cut.volume_change;
  facts["relative_volume_change"] = relative;
  mesh = std::move(cut.mesh);
  if (mesh.cell_count() == 0) throw InputError(subject, "has no cells of any volume");
}

}  // namespace hiac::tools

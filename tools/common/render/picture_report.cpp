#include "tools/common/render/picture_report.hpp"

#include <string>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/finite_range.hpp"
#include "hiac/geometry/box.hpp"

namespace hiac::tools {
namespace {

// `quietly`: with --verbose alone.
void note(Tool& tool, bool quietly, const std::string& line) {
  quietly ? tool.detail(line) : tool.note(line);
}

bool hides_medium(const Scene& scene) { return scene.skin && scene.skin->opacity >= 1; }

void note_field(Tool& tool, bool quietly, const ZooMesh& mesh, const std::string& role,
                const std::string& name) {
  const Field field = scalar_field(mesh, name);
  const FiniteRange range(field.values.view());
  tool.facts()["fields"][role] = {{"name", name}, {"minimum", range.low}, {"maximum", range.high}};
  note(tool, quietly, fmt::format("{} by {} from {:g} to {:g}", role, name, range.low, range.high));
}

}  // namespace

void note_model(Tool& tool, bool one_of_many, const ZooMesh& mesh, const Scene& scene) {
  const auto& [glow, color, extinction] = scene.volume;
  const bool quietly = one_of_many || hides_medium(scene);
  if (color) note_field(tool, quietly, mesh, "colour", color->field);
  if (extinction) note_field(tool, quietly, mesh, "extinction", extinction->field);
  const double size = box_of_nodes(mesh).diagonal();
  tool.facts()["cells"] = mesh.cell_count();
  tool.facts()["diagonal"] = size;
  note(tool, one_of_many, fmt::format("diagonal {:g}", size));
}

nlohmann::ordered_json note_work(Tool& tool, bool one_of_many, const Scene& scene,
                                 const RenderStatistics& s) {
  tool.add_seconds("prepare", s.prepare_seconds);
  tool.add_seconds("tiles", s.tile_seconds);
  note(tool, one_of_many || hides_medium(scene),
       fmt::format("optical depth {:.3g} in the mean, {:.3g} at most", s.mean_optical_depth,
                   s.largest_optical_depth));
  tool.detail(fmt::format("{} segments in {:.3f} s", s.segments, s.tile_seconds));
  if (s.splatted_cells > 0)
    note(tool, one_of_many, fmt::format("{} cells splatted", s.splatted_cells));
  if (s.violations > 0)
    tool.warn(fmt::format(
        "{} ray segments were met out of order: the picture is wrong there (cells "
        "overlap, or the order does not fit; --overlap keeps the cells in order that do "
        "not overlap)",
        s.violations));
  return {{"segments", s.segments},
          {"covered_pixels", s.covered_pixels},
          {"splatted_cells", s.splatted_cells},
          {"witness_violations", s.violations},
          {"optical_depth", {{"mean", s.mean_optical_depth}, {"largest", s.largest_optical_depth}}},
          {"seconds", s.prepare_seconds + s.tile_seconds}};
}

void require_truth(const std::string& path, const RenderStatistics& statistics) {
  if (statistics.violations > 0)
    throw JudgementError(
        fmt::format("{}: not written: {} ray segments were met out of order "
                    "(--strict)",
                    path, statistics.violations));
}

}  // namespace hiac::tools

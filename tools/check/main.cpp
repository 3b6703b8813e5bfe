// hiac-check: whether a mesh is valid, and what is wrong with it.

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/check/cells.hpp"
#include "hiac/check/conformity.hpp"
#include "hiac/check/cycles.hpp"
#include "hiac/check/mesh_convexity.hpp"
#include "hiac/check/numbers.hpp"
#include "hiac/check/overlap.hpp"
#include "hiac/check/regularity.hpp"
#include "hiac/check/repair.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/order/order_basis.hpp"
#include "hiac/order/order_file.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/scene/view_of.hpp"
#include "tools/check/picture.hpp"
#include "tools/check/report.hpp"
#include "tools/common/foreign_mesh.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/picture/picture_size.hpp"
#include "tools/common/picture/specification.hpp"
#include "tools/common/tool.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;

struct Options {
  std::string input, conversion, output, view, picture, size;
  std::vector<std::string> overrides;
  std::uint32_t directions = 0;
  std::size_t max_ids = 20;
  double planarity = RenderSettings{}.planarity;
  bool overlap = false, cycles = false, quality = false, repair = false;
};

// A view that cycles are looked for in.
struct NamedView {
  std::string name;
  View view;
  double planarity;
};

std::vector<NamedView> wanted_views(const Options& options) {
  std::vector<NamedView> views;
  if (!options.view.empty()) {
    const Scene scene = read_specification(options.view, options.overrides).scene;
    for (std::uint32_t frame = 0; frame < frame_count(scene); ++frame)
      views.push_back({scene.path ? fmt::format("frame {}", frame) : options.view,
                       view_of(camera_at(scene, frame)), scene.render.planarity});
  }
  for (const View& view : spread_views(options.directions)) {
    const auto& d = view.direction;
    views.push_back(
        {fmt::format("direction {:.4f} {:.4f} {:.4f}", d[0], d[1], d[2]), view, options.planarity});
  }
  return views;
}

// Asks one mesh everything that is wanted, as far as its answers allow.
class Judge {
 public:
  Judge(Tool& tool, const Options& options, const std::vector<NamedView>& views)
      : tool_(tool), options_(options), views_(views) {}

  // False where the mesh's numbers are not fit to be asked anything else.
  bool numbers(const ZooMesh& mesh) {
    add(tool_.timed("numbers", [&] { return judge_numbers(mesh); }));
    return judgement_.findings.empty();
  }

  void repaired(const RepairCounts& counts) { judgement_.repair = counts; }

  void all_else(const ZooMesh& mesh) {
    add(tool_.timed("nodes", [&] { return judge_nodes(mesh); }));
    CellShapes shapes = tool_.timed("cells", [&] { return judge_cells(mesh, options_.planarity); });
    adjacency_ = tool_.timed("adjacency", [&] { return build_face_adjacency(mesh); });
    auto fit = tool_.timed("conformity", [&] {
      return judge_conformity(mesh, adjacency_, shapes, options_.planarity);
    });
    bool folded = false, interfaces = false;
    for (const Finding& f : fit) {
      folded = folded || f.defect == Defect::folded_face;
      interfaces = interfaces || f.defect == Defect::torn_interface ||
                   f.defect == Defect::hanging_interface || f.defect == Defect::sliding_interface ||
                   f.defect == Defect::folded_face;
    }
    judgement_.convexity =
        tool_.timed("convexity", [&] { return judge_convexity(mesh, adjacency_, interfaces); });
    add(std::exchange(shapes.findings, {}));
    add(std::move(fit));
    if (options_.overlap) overlaps(mesh, shapes, folded);
    if (options_.cycles) cycles(mesh, shapes);
    if (options_.quality) quality(mesh, shapes);
  }

  [[nodiscard]] const Judgement& judgement() const { return judgement_; }
  [[nodiscard]] const FaceAdjacency& adjacency() const { return adjacency_; }

 private:
  void add(std::vector<Finding> findings) {
    for (Finding& finding : findings) judgement_.findings.push_back(std::move(finding));
  }

  void overlaps(const ZooMesh& mesh, const CellShapes& shapes, bool folded) {
    OverlapReport report = tool_.timed("overlap", [&] {
      return find_overlaps(mesh, adjacency_, shapes, folded, options_.planarity);
    });
    judgement_.overlaps_asked = true;
    tool_.facts()["overlap"] = {{"pairs_asked", report.pairs}, {"by_boundary", report.by_boundary}};
    add(std::move(report.findings));
  }

  void cycles(const ZooMesh& mesh, const CellShapes& shapes) {
    const OrderBasis basis = tool_.timed("basis", [&] { return order_basis(mesh, adjacency_); });
    judgement_.certificate =
        judgement_.cells_overlap()
            ? Certificate{Acyclicity::unknown, Delaunay::unknown, "cells overlap"}
            : tool_.timed("certificate", [&] { return certify_acyclic(basis, shapes); });
    std::vector<Offender> cells;
    std::set<CellId> known;  // a cell counts once, whatever the number of views
    tool_.frames().begin("views", views_.size());
    for (std::uint64_t v = 0; v < views_.size(); ++v) {
      auto groups = tool_.timed(
          "cycles", [&] { return find_cycles(basis, views_[v].view, views_[v].planarity); });
      for (const VisibilityGroup& group : groups)
        for (const CellId cell : group.cells)
          if (known.insert(cell).second) cells.push_back({cell, v});
      judgement_.views.push_back({views_[v].name, std::move(groups)});
      tool_.frames().advance();
    }
    add_finding(judgement_.findings, Defect::cycle, std::move(cells));
  }

  void quality(const ZooMesh& mesh, const CellShapes& shapes) {
    const int hand = shapes.hand == Turn::left ? -1 : 1;
    judgement_.quality =
        Quality{tool_.timed("parts", [&] { return mesh_parts(mesh, adjacency_, shapes); }),
                tool_.timed("quality", [&] { return mesh_quality(mesh, hand); })};
  }

  Tool& tool_;
  const Options& options_;
  const std::vector<NamedView>& views_;
  Judgement judgement_;
  FaceAdjacency adjacency_;
};

// Whether the mesh is passed on; throws where that is asked for and cannot be.
bool passes_on(const Tool& tool, const Options& options) {
  if (!is_stdout(options.output)) return true;
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  if (options.output == "-") {
    require_binary_output(options.output);
    if (tool.common().json == "-")
      throw UsageError("--json -: stdout carries the mesh here; name a file");
  }
  return !terminal && tool.common().json != "-";
}

void repair_file(Tool& tool, ZooFile& file, Judge& judge) {
  Repaired repaired = tool.timed("repair", [&] { return repair(file.mesh); });
  judge.repaired(repaired.counts);
  if (repaired.counts.nothing()) return;
  file.mesh = std::move(repaired.mesh);
  // they belong to the mesh as it was
  const auto orders =
      std::erase_if(file.extras, [](const ExtraChunk& chunk) { return chunk.type == kOrderChunk; });
  if (orders > 0) tool.note("the file's orders do not fit the repaired mesh and are left out");
}

ImageSize picture_size(const Options& options) {
  return options.size.empty() ? ImageSize{1024, 768} : parse_size(options.size);
}

void check_options(const Options& options) {
  const bool views = !options.view.empty() || options.directions > 0;
  if (!options.cycles && views) throw UsageError("--view, --directions: only for --cycles");
  if (!options.overrides.empty() && options.view.empty())
    throw UsageError("--set: no specification to override (--view SPEC)");
  if (!options.picture.empty()) require_known_image_extension(options.picture);
  if (options.picture.empty() && !options.size.empty())
    throw UsageError("--size: only for --picture");
  picture_size(options);
}

void claim_files(Tool& tool, const Options& options) {
  // a mended mesh may replace the mesh, but not a file that hiac-convert reads
  const bool replaceable = !is_foreign_mesh(options.input);
  RunFiles files{{options.input, options.view},
                 {{"-o", options.output, FileKind::mesh, replaceable}}};
  add_image(files.outputs, "--picture", options.picture);
  tool.claim(std::move(files));
}

void check(Tool& tool, const Options& options) {
  claim_files(tool, options);
  check_options(options);
  const bool pass_on = passes_on(tool, options);
  const std::vector<NamedView> views = wanted_views(options);
  ZooFile file = tool.timed("read", [&] {
    return read_any_mesh(tool, {options.input, options.conversion}, MeshNumbers::as_given);
  });
  const std::string subject = input_name(options.input);
  Judge judge(tool, options, views);
  const bool sound = judge.numbers(file.mesh);
  if (sound && options.repair) repair_file(tool, file, judge);
  if (sound) judge.all_else(file.mesh);
  const Judgement& judgement = judge.judgement();
  tool.facts()["file"] = subject;
  tool.facts()["cells"] = file.mesh.cell_count();
  tool.facts()["nodes"] = file.mesh.node_count();
  tool.facts()["planarity"] = options.planarity;
  tool.facts().update(judgement_facts(judgement, options.max_ids));
  tool.note(subject);
  if (!tool.common().quiet) tool.print(judgement_table(file.mesh, judgement, options.max_ids));
  if (!options.picture.empty() && sound && file.mesh.cell_count() > 0)
    tool.timed("picture", [&] {
      write_defect_picture(tool, file.mesh, judge.adjacency(), judgement.findings,
                           picture_size(options), options.picture);
    });
  tool.facts()["bytes_per_cell"] =
      peak_memory_bytes() / std::max<std::uint64_t>(file.mesh.cell_count(), 1);
  if (any_invalid(judgement.findings))
    throw JudgementError(fmt::format("{}: the mesh is invalid ({})", subject, reasons(judgement)));
  if (pass_on) tool.timed("write", [&] { write_mesh(options.output, file); });
}

const char* const kMeaning =
    "\n\nInvalid (exit 1, the mesh is not passed on): node numbers out of range, coordinates that\n"
    "are not finite, cells without volume, inverted cells, cells whose Jacobian is not positive\n"
    "everywhere, faces with more than two cells, two cells on one side of their common face,\n"
    "overlapping interiors, a stored adjacency that does not match the mesh.\n"
    "Warnings (exit 0): two nodes at one place, nodes of no cell or twice in a cell; faces that "
    "are\n"
    "not planar, cells that are not convex; torn, hanging and sliding interfaces; overlaps that "
    "are\n"
    "within rounding or cannot be decided because faces are not planar; visibility cycles (the\n"
    "exact order resolves them).\n"
    "A mesh whose cells are all numbered left-handed is valid: hiac draws either hand alike.";

}  // namespace

int main(int argc, char** argv) {
  Tool tool("hiac-check", "Judges whether a mesh is valid, and names its defects.",
            std::string("  hiac-check part.zoo --overlap\n"
                        "  hiac-check part.zoo --cycles --directions 100 --json cycles.json\n"
                        "  hiac-check part.zoo --quality --json quality.json\n"
                        "  hiac-check part.zoo --repair -o mended.zoo\n"
                        "  hiac-check part.zoo --picture where.png\n"
                        "  hiac-convert part.vtu | hiac-check | hiac-sort --view view.toml | "
                        "hiac-render --view view.toml -o part.png") +
                kMeaning);
  Options options;
  auto& app = tool.app();
  app.add_option("MESH", options.input, kMeshHelp);
  add_conversion(app, options.conversion);
  app.add_option("-o,--output", options.output,
                 "Write a valid mesh here; - or none: to stdout, unless stdout is a terminal or "
                 "--json - uses it")
      ->type_name("FILE");
  app.add_flag("--overlap", options.overlap, "Look for cells whose interiors overlap");
  app.add_flag("--cycles", options.cycles,
               "Look for a proof that no view has a visibility cycle, and for cycles in the views "
               "of --view and --directions");
  app.add_flag("--quality", options.quality,
               "Tell the shapes of the cells (volumes, dihedral angles, edge, aspect and radius "
               "ratios, condition, scaled Jacobian) and count components, boundary shells, "
               "cavities and tunnels");
  app.add_option(
         "--view", options.view,
         "For --cycles: the camera of this image specification (TOML, a picture made by one, "
         "or a state or camera of ParaView), or all its frames")
      ->type_name("SPEC");
  app.add_option("--set", options.overrides, "Override KEY=VALUE of the specification; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--directions", options.directions,
                 "For --cycles: N parallel views, spread over all directions")
      ->check(CLI::Range(1U, 1000000U))
      ->type_name("N");
  app.add_option("--planarity", options.planarity,
                 "Deviation, relative to a face's size, below which a face counts as planar, two "
                 "faces as touching, and an overlap as rounding; 0 is exact")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--max-ids", options.max_ids, "How many cells or nodes to name for each defect")
      ->capture_default_str()
      ->type_name("N");
  app.add_flag("--repair", options.repair,
               "Renumber left-handed cells, drop cells without volume, merge nodes at one place "
               "that have the same values; then judge");
  app.add_option("--picture", options.picture,
                 "Draw the mesh's outline and the defective cells (" + image_extensions() + ")")
      ->type_name("FILE");
  app.add_option("--size", options.size, "Size of --picture in pixels (default: 1024x768)")
      ->type_name("WxH");
  return tool.run(argc, argv, [&] { check(tool, options); });
}

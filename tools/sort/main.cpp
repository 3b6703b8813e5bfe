// hiac-sort: the visibility order of a mesh for a view, or for each frame of a camera path.

#include <algorithm>
#include <cstdio>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/order/algorithm.hpp"
#include "hiac/order/verify_order.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/scene/view_of.hpp"
#include "hiac/session/ordering.hpp"
#include "tools/common/foreign_mesh.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/naming.hpp"
#include "tools/common/picture/frames.hpp"
#include "tools/common/picture/order_facts.hpp"
#include "tools/common/picture/specification.hpp"
#include "tools/common/tool.hpp"
#include "tools/sort/report.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;

struct Options {
  std::string input, conversion, view, output, given;
  std::vector<std::string> overrides;
  std::optional<std::uint32_t> frame;
  std::string algorithm;  // empty: the exact one
  std::string tiles;
  bool balanced = false, statistics = false, verify = false, overlap = false;
};

// How to sort, as the options say.
OrderMethod method_of(const Options& options) {
  OrderMethod method;
  if (!options.algorithm.empty())
    method.algorithm = parse_algorithm(options.algorithm, "--algorithm");
  const bool tiled = method.algorithm == OrderAlgorithm::multitiled;
  if (!tiled && (!options.tiles.empty() || options.balanced))
    throw UsageError(fmt::format("--tiles, --balanced: only for --algorithm {} (found {})",
                                 algorithm_name(OrderAlgorithm::multitiled),
                                 algorithm_name(method.algorithm)));
  method.tiling.balanced = options.balanced;
  if (options.tiles.empty()) return method;
  unsigned columns = 0, rows = 0;
  int length = 0;
  constexpr unsigned kMost = 4096;
  // NOLINTNEXTLINE(cert-err34-c): what does not fit is out of range below
  if (std::sscanf(options.tiles.c_str(), "%5ux%5u%n", &columns, &rows, &length) != 2 ||
      static_cast<std::size_t>(length) != options.tiles.size() || columns < 1 || rows < 1 ||
      columns > kMost || rows > kMost)
    throw UsageError(fmt::format(
        "--tiles: expected COLUMNSxROWS of 1 to {} each, as 8x6 (found {})", kMost, options.tiles));
  method.tiling.columns = columns;
  method.tiling.rows = rows;
  return method;
}

// The views that are wanted of a mesh, and the orders for them.
class Sorting {
 public:
  Sorting(Tool& tool, const Options& options, const Scene& scene, const ZooMesh& mesh)
      : tool_(tool),
        options_(options),
        scene_(scene),
        frames_(chosen_frames(scene, options.frame)),
        mesh_(mesh),
        method_(method_of(options)),
        ordering_(mesh, tool.monitor()) {
    if (options.overlap) ordering_.look_for_overlaps(scene.render.planarity);
    if (scene.path) tool.frames().begin("frames", frames_.size());
  }

  // Makes one order after another; none when all are made. Views that share an order have it once.
  std::optional<OrderRecord> next() {
    while (next_ < frames_.size()) {
      const std::uint32_t frame = frames_[next_++];
      const Scene scene = scene_of_frame(scene_, frame);
      std::optional<OrderRecord> record;
      if (views_.insert(view_hash(scene)).second) record = make(scene, frame);
      tool_.frames().advance();
      if (record) return record;
    }
    return std::nullopt;
  }

  // Verifies orders that were made before.
  void verify(const GivenOrders& given) {
    for (const std::uint32_t frame : frames_) {
      const Scene scene = scene_of_frame(scene_, frame);
      const VisibilityOrder order = fitting_order(given, ordering_.mesh_hash(), mesh_, scene).order;
      Json facts = order_facts(order);
      verify(scene, order, frame, facts);
      keep(std::move(facts), frame);
      tool_.frames().advance();
    }
  }

  // What was met, where it is asked for.
  void report() {
    const std::uint64_t peak = peak_memory_bytes();
    tool_.facts()["bytes_per_cell"] = peak / std::max<std::uint64_t>(mesh_.cell_count(), 1);
    if (options_.statistics)
      tool_.print(statistics_table(mesh_, reported_, tool_.facts()["seconds"], peak));
  }

 private:
  using Json = nlohmann::ordered_json;

  OrderRecord make(const Scene& scene, std::uint32_t frame) {
    const double start = seconds_now();
    MeshOrder found = made(scene, frame);
    if (const std::string line = order_line(found); !line.empty()) tool_.detail(line);
    const VisibilityOrder& order = found.record.order;
    Json facts = order_facts(found);
    OrderStatistics statistics = found.statistics.value_or(OrderStatistics{});
    statistics.cells_in_groups = facts["cells_in_groups"];
    statistics.largest_group = facts["largest_group"];
    reported_.push_back(
        {frame, order.algorithm, statistics, order.groups.size(), seconds_now() - start});
    if (options_.verify) verify(scene, order, frame, facts);
    keep(std::move(facts), frame);
    return std::move(found.record);
  }

  [[nodiscard]] std::string name_of(std::uint32_t frame) const {
    return scene_.path ? fmt::format("frame {}: ", frame) : "";
  }

  // Errors name the frame.
  MeshOrder made(const Scene& scene, std::uint32_t frame) {
    try {
      return ordering_.made_by(method_, scene);
    } catch (const JudgementError& error) {
      throw JudgementError(name_of(frame) + error.what());
    }
  }

  void verify(const Scene& scene, const VisibilityOrder& order, std::uint32_t frame, Json& facts) {
    const OrderBasis& basis = ordering_.basis();
    const OrderCheck check = tool_.timed("verify", [&] {
      return verify_order(basis, view_of(scene.camera), order, scene.render.planarity);
    });
    const std::string told = name_of(frame) + check_text(check, order);
    if (!check.right()) throw JudgementError(told);
    tool_.note(told);
    facts["verified"] = check_facts(check);
  }

  // One order is a fact of its own, those of a path are a list.
  void keep(Json facts, std::uint32_t frame) {
    if (!scene_.path) {
      tool_.facts()["order"] = std::move(facts);
      return;
    }
    facts["frame"] = frame;
    tool_.facts()["frames"].push_back(std::move(facts));
  }

  Tool& tool_;
  const Options& options_;
  const Scene& scene_;
  std::vector<std::uint32_t> frames_;
  std::size_t next_ = 0;
  const ZooMesh& mesh_;
  OrderMethod method_;
  Ordering ordering_;
  std::set<std::string> views_;  // the hashes of those that have an order
  std::vector<ReportedOrder> reported_;
};

// Where the orders go.
enum class Target { nowhere, order_file, behind_mesh };

Target target_of(const Tool& tool, const Options& options) {
  if (!options.given.empty()) return Target::nowhere;
  if (!is_stdout(options.output)) return Target::order_file;
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  if (terminal && options.output.empty() && (options.verify || options.statistics))
    return Target::nowhere;
  if (terminal)
    throw UsageError(
        "the sorted mesh is binary and is not written to a terminal: name an order file with -o, "
        "or use a pipe");
  if (tool.common().json == "-")
    throw UsageError("--json -: stdout carries the mesh here; name a file");
  return Target::behind_mesh;
}

void write_orders(Tool& tool, const Options& options, Target target, ZooFile& file,
                  Sorting& sorting) {
  if (target == Target::order_file)
    return write_order_file(options.output, [&] { return sorting.next(); });
  // the orders of one sort a stream: a later sort replaces an earlier one
  std::erase_if(file.extras, [](const ExtraChunk& c) { return c.type == kOrderChunk; });
  while (const auto record = sorting.next())
    if (target == Target::behind_mesh) file.extras.push_back(encode_order(*record));
  if (target == Target::behind_mesh) tool.timed("write", [&] { write_mesh(options.output, file); });
}

void sort(Tool& tool, const Options& options) {
  tool.claim(
      {{options.input, options.view, options.given}, {{"-o", options.output, FileKind::order}}});
  if (!options.given.empty() && !options.verify)
    throw UsageError("--order: a given order can only be verified (expected --verify)");
  const Target target = target_of(tool, options);
  method_of(options);
  const Scene scene = read_specification(options.view, options.overrides).scene;
  chosen_frames(scene, options.frame);
  ZooFile file = tool.timed("read", [&] {
    return read_any_mesh(tool, {options.input, options.conversion});
  });
  tool.facts()["cells"] = file.mesh.cell_count();
  const ZooMesh mesh = file.mesh;
  naming(input_name(options.input), options.view, {options.given, options.output, "stdout"}, [&] {
    Sorting sorting(tool, options, scene, mesh);
    if (options.given.empty())
      write_orders(tool, options, target, file, sorting);
    else
      sorting.verify({options.given, read_order_chunks(options.given)});
    sorting.report();
  });
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool(
      "hiac-sort", "Finds the visibility order of a mesh's cells for a view, front to back.",
      "  hiac-sort part.zoo --view view.toml -o part.order\n"
      "  hiac-convert part.vtu | hiac-sort --view view.toml | hiac-render --view view.toml -o "
      "part.exr\n"
      "  hiac-sort part.zoo --view turntable.toml -o part.order   # an order for every frame\n"
      "  hiac-sort part.zoo --view view.toml --order part.order --verify");
  Options options;
  auto& app = tool.app();
  app.add_option("MESH", options.input, kMeshHelp);
  add_conversion(app, options.conversion);
  app.add_option("--view", options.view,
                 "Image specification (TOML) with the camera or a camera path, a picture made by "
                 "one (.png .exr .tiff), or a state or camera of ParaView (.pvsm, .pvcc)")
      ->required()
      ->type_name("SPEC");
  app.add_option("--set", options.overrides, "Override KEY=VALUE of the specification; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--frame", options.frame,
                 "Sort for this frame of a camera path only, counted from 0")
      ->type_name("N");
  auto* algorithm =
      app.add_option(
             "--algorithm", options.algorithm,
             "exact (correct for every mesh; cycles become groups), stein or multitiled (compare "
             "pairs of cells; a cycle is an error, exit 1), mpvo or centroid (heuristics)")
          ->default_str("exact")
          ->type_name("NAME");
  app.add_option("--tiles", options.tiles,
                 "For multitiled: how many tiles the window has; default n^(1/6) each way")
      ->type_name("CxR");
  app.add_flag("--balanced", options.balanced,
               "For multitiled: tiles with equal numbers of cells, not of equal size");
  auto* output = app.add_option("-o,--output", options.output,
                                "Order file; - or none: write the mesh and its order to stdout")
                     ->type_name("FILE");
  auto* statistics =
      app.add_flag("--stats", options.statistics,
                   "Print a table: arrows by source, groups, seconds by stage, memory");
  app.add_flag("--verify", options.verify,
               fmt::format("Prove the order: test every pair of cells by brute force, to within "
                           "2 x planarity of their faces (meshes of up to {} cells), or every "
                           "arrow of the relation; exit 1 when it is wrong",
                           kMostCellsForPairs));
  app.add_flag("--overlap", options.overlap, kOverlapHelp)->excludes(algorithm);
  app.add_option("--order", options.given, "Verify the order in FILE; sort nothing")
      ->type_name("FILE")
      ->excludes(output)
      ->excludes(statistics)
      ->excludes(algorithm);
  return tool.run(argc, argv, [&] { sort(tool, options); });
}

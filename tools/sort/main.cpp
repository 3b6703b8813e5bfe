// hiac-sort: the visibility order of a mesh for a view, or for each frame of a camera path.

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/scene/scene_parser.hpp"
#include "tools/common/frames.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/ordering.hpp"
#include "tools/common/tool.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;

struct Options {
  std::string input, view, output;
  std::vector<std::string> overrides;
  std::optional<std::uint32_t> frame;
};

// The orders of all views that are wanted, one after another; views that share an order have it
// once.
class Orders {
 public:
  Orders(Tool& tool, const Options& options, const Scene& scene, const ZooMesh& mesh)
      : tool_(tool),
        scene_(scene),
        frames_(chosen_frames(scene, options.frame)),
        orderer_(tool, mesh) {
    if (scene.path) tool.frames().begin("frames", frames_.size());
  }

  // None when all are made.
  std::optional<OrderRecord> next() {
    while (next_ < frames_.size()) {
      const std::uint32_t frame = frames_[next_++];
      const Scene scene = scene_of_frame(scene_, frame);
      const bool new_view = views_.insert(view_hash(scene)).second;
      std::optional<OrderRecord> record;
      if (new_view) record = make(scene, frame);
      tool_.frames().advance();
      if (record) return record;
    }
    return std::nullopt;
  }

 private:
  OrderRecord make(const Scene& scene, std::uint32_t frame) {
    MeshOrder made = orderer_.exact(scene);
    if (scene_.path) {
      made.facts["frame"] = frame;
      tool_.facts()["frames"].push_back(made.facts);
    } else {
      tool_.facts()["order"] = made.facts;
    }
    return std::move(made.record);
  }

  Tool& tool_;
  const Scene& scene_;
  std::vector<std::uint32_t> frames_;
  std::size_t next_ = 0;
  Orderer orderer_;
  std::set<std::string> views_;  // the hashes of those that have an order
};

// Orders into a file one after another, or behind the mesh.
void write_orders(Tool& tool, const Options& options, ZooFile& file, Orders& orders) {
  if (!is_stdout(options.output))
    return write_order_file(options.output, [&] { return orders.next(); });
  // the orders of one sort a stream: a later sort replaces an earlier one
  std::erase_if(file.extras, [](const ExtraChunk& c) { return c.type == kOrderChunk; });
  while (const auto record = orders.next()) file.extras.push_back(encode_order(*record));
  tool.timed("write", [&] { write_mesh(options.output, file); });
}

void sort(Tool& tool, const Options& options) {
  const bool pass_on = is_stdout(options.output);
  if (pass_on && isatty(STDOUT_FILENO) != 0)
    throw UsageError(
        "the sorted mesh is binary and does not go to a terminal: name an order file with -o, or "
        "pipe");
  if (pass_on && tool.common().json == "-")
    throw UsageError("--json -: stdout carries the mesh here; name a file");
  const Scene scene = read_scene(options.view, options.overrides).scene;
  chosen_frames(scene, options.frame);
  ZooFile file = tool.timed("read", [&] { return read_mesh(options.input); });
  tool.facts()["cells"] = file.mesh.cell_count();
  const ZooMesh mesh = file.mesh;
  Orders orders(tool, options, scene, mesh);
  write_orders(tool, options, file, orders);
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool(
      "hiac-sort", "Finds the visibility order of a mesh's cells for a view, front to back.",
      "  hiac-sort part.zoo --view view.toml -o part.order\n"
      "  hiac-convert part.vtu | hiac-sort --view view.toml | hiac-render --view view.toml -o "
      "part.exr\n"
      "  hiac-sort part.zoo --view turntable.toml -o part.order   # an order for every frame");
  Options options;
  auto& app = tool.app();
  app.add_option("MESH", options.input, "Zoo mesh; - or none: stdin");
  app.add_option("--view", options.view,
                 "Image specification (TOML) with the camera, or with a camera path")
      ->required()
      ->type_name("SPEC");
  app.add_option("--set", options.overrides, "Override KEY=VALUE of the specification; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--frame", options.frame, "One frame of a camera path, from 0 on, instead of all")
      ->type_name("N");
  app.add_option("-o,--output", options.output,
                 "Order file; - or none: pass the mesh on to stdout with the order behind it")
      ->type_name("FILE");
  return tool.run(argc, argv, [&] { sort(tool, options); });
}

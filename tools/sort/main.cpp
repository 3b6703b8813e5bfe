// hiac-sort: the visibility order of a mesh for a view.

#include <string>
#include <vector>

#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/scene_parser.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/ordering.hpp"
#include "tools/common/tool.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;

struct Options {
  std::string input, view, output;
  std::vector<std::string> overrides;
};

void sort(Tool& tool, const Options& options) {
  const bool pass_on = is_stdout(options.output);
  if (pass_on && isatty(STDOUT_FILENO) != 0)
    throw UsageError(
        "the sorted mesh is binary and does not go to a terminal: name an order file with -o, or "
        "pipe");
  if (pass_on && tool.common().json == "-")
    throw UsageError("--json -: stdout carries the mesh here; name a file");
  const ParsedScene parsed = read_scene(options.view, options.overrides);
  ZooFile file = tool.timed("read", [&] { return read_mesh(options.input); });
  tool.facts()["cells"] = file.mesh.cell_count();
  const OrderRecord record = order_mesh(tool, file.mesh, parsed.scene);
  tool.timed("write", [&] {
    if (!pass_on) return write_order_file(options.output, record);
    // one order a stream: a later sort replaces an earlier one
    std::erase_if(file.extras, [](const ExtraChunk& c) { return c.type == kOrderChunk; });
    file.extras.push_back(encode_order(record));
    write_mesh(options.output, file);
  });
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool(
      "hiac-sort", "Finds the visibility order of a mesh's cells for a view, front to back.",
      "  hiac-sort part.zoo --view view.toml -o part.order\n"
      "  hiac-convert part.vtu | hiac-sort --view view.toml | hiac-render --view view.toml -o "
      "part.exr");
  Options options;
  tool.app().add_option("MESH", options.input, "Zoo mesh; - or none: stdin");
  tool.app()
      .add_option("--view", options.view, "Image specification (TOML) with the camera")
      ->required()
      ->type_name("SPEC");
  tool.app()
      .add_option("--set", options.overrides, "Override KEY=VALUE of the specification; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  tool.app()
      .add_option("-o,--output", options.output,
                  "Order file; - or none: pass the mesh on to stdout with the order behind it")
      ->type_name("FILE");
  return tool.run(argc, argv, [&] { sort(tool, options); });
}

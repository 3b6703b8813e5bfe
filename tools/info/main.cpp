// hiac-info: what a zoo, order or image file holds, and a first image specification for a mesh.

#include <string>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/order/order_file.hpp"
#include "tools/common/file_kind.hpp"
#include "tools/common/foreign_mesh.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/picture/starter_command.hpp"
#include "tools/common/plain_text.hpp"
#include "tools/common/text_output.hpp"
#include "tools/common/tool.hpp"
#include "tools/info/describe.hpp"
#include "tools/info/describe_parts.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;

struct Options {
  std::string input, conversion, output;
  ReadOptions reading;
  StarterOptions starter;
  bool starter_view = false;
};

Description describe(const Tool& tool, const Options& options) {
  const std::string subject = input_name(options.input);
  if (has_image_extension(options.input))
    return describe_image(read_image(options.input, options.reading), subject);
  const bool is_order = subject != "stdin" && kind_of_file(options.input) == FileKind::order;
  try {
    if (is_order) return describe_mesh(read_mesh(options.input), subject);
    Description description = describe_mesh(read_any_mesh(tool, {options.input, options.conversion},
                                                          MeshNumbers::checked, {"--no-adjacency"}),
                                            subject);
    if (is_parted_mesh(options.input)) describe_parts(options.input, description);
    return description;
  } catch (const InputError& no_mesh) {
    if (!is_order) throw;
    try {
      return describe_orders(read_order_chunks(options.input), subject);
    } catch (const InputError&) {
      throw no_mesh;
    }
  }
}

void write_starter_view(Tool& tool, const Options& options) {
  const ZooFile file = tool.timed("read", [&] {
    return read_any_mesh(tool, {options.input, options.conversion}, MeshNumbers::checked,
                         {"--no-adjacency"});
  });
  const std::string subject = input_name(options.input);
  write_text(options.output,
             file_text(make_view(tool, file.mesh, subject, options.starter), subject));
}

void inform(Tool& tool, const Options& options) {
  const FileKind kind = options.starter_view ? FileKind::specification : FileKind::facts;
  tool.claim({image_parts(options.input), {{"-o", options.output, kind}}});
  const bool json_on_stdout = tool.common().json == "-";
  if (options.starter_view) {
    if (json_on_stdout && is_stdout(options.output))
      throw UsageError("--json -: stdout carries the specification here; name a file");
    write_starter_view(tool, options);
    return;
  }
  if (are_given(options.starter))
    throw UsageError("--field, --preset, --isovalues, --dark: only for --starter-view");
  const Description description = tool.timed("read", [&] { return describe(tool, options); });
  tool.facts()["file"] = input_name(options.input);
  tool.facts().update(description.facts);
  if (!json_on_stdout || !is_stdout(options.output))
    write_text(options.output, plain_text(description.text));
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("hiac-info", "Tells what a zoo mesh, an order file or an image holds.",
            "  hiac-info part.zoo\n"
            "  hiac-info part.zoo --starter-view -o view.toml\n"
            "  hiac-info part.exr --json -");
  Options options;
  auto& app = tool.app();
  app.add_option("FILE", options.input,
                 "Zoo mesh, any file that hiac-convert reads, order file, or image (" +
                     image_extensions() + "); - or none: a zoo mesh from stdin");
  add_conversion(app, options.conversion);
  app.add_option("-o,--output", options.output, "Where the text goes; - or none: stdout")
      ->type_name("FILE");
  app.add_flag(
      "--starter-view", options.starter_view,
      "Write an image specification for the mesh: whole model in sight, the field that says "
      "most over its range, mean optical depth about 1");
  add_starter_options(app, options.starter);
  app.add_option("--width", options.reading.width, "Width in pixels of a .f32 image");
  app.add_flag("--linear", options.reading.linear,
               "The integers of a .tiff or .sgi image are linear, not sRGB-encoded");
  return tool.run(argc, argv, [&] { inform(tool, options); });
}

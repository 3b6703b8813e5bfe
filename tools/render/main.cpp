// hiac-render: a picture of a mesh.

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/order/order_file.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/render/renderable.hpp"
#include "hiac/render/supersampling.hpp"
#include "hiac/scene/scene_parser.hpp"
#include "hiac/scene/scene_writer.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/ordering.hpp"
#include "tools/common/tool.hpp"
#include "tools/common/version.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;

struct Options {
  std::string input, view, order, output, size, channels, crop, filter = "box";
  std::vector<std::string> overrides;
  std::optional<std::uint32_t> samples;
  bool no_background = false, linear = false;
};

// WxH as overrides of the specification.
void add_size(const std::string& size, std::vector<std::string>& overrides) {
  if (size.empty()) return;
  const std::size_t cross = size.find('x');
  if (cross == std::string::npos || cross == 0 || cross + 1 == size.size())
    throw UsageError("--size: expected WIDTHxHEIGHT, as 1024x768 (found " + size + ")");
  overrides.push_back("image.width=" + size.substr(0, cross));
  overrides.push_back("image.height=" + size.substr(cross + 1));
}

// The order from a file, or behind the mesh in the stream, or made here.
OrderRecord find_order(Tool& tool, const Options& options, const ZooFile& file,
                       const Scene& scene) {
  std::optional<OrderRecord> record;
  std::string subject = options.order;
  if (!options.order.empty()) {
    record = read_order_file(options.order);
  } else {
    subject = input_name(options.input);
    for (const ExtraChunk& chunk : file.extras)
      if (chunk.type == kOrderChunk) record = decode_order(chunk, subject);
  }
  if (!record) return order_mesh(tool, file.mesh, scene);
  tool.timed("hash", [&] { require_fitting_order(*record, file.mesh, scene, subject); });
  return std::move(*record);
}

double diagonal(const ZooMesh& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity},
      high{-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = 0; i < mesh.xyz.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], mesh.xyz[i]);
    high[i % 3] = std::max(high[i % 3], mesh.xyz[i]);
  }
  return mesh.node_count() == 0 ? 0
                                : std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

void note_field(Tool& tool, const ZooMesh& mesh, const std::string& role, const std::string& name) {
  const Field field = scalar_field(mesh, name);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : field.values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  tool.facts()["fields"][role] = {{"name", name}, {"minimum", low}, {"maximum", high}};
  tool.note(fmt::format("{} by {} from {:g} to {:g}", role, name, low, high));
}

// What a user needs to choose extinctions.
void note_optics(Tool& tool, const ZooMesh& mesh, const Scene& scene, const RenderStatistics& s) {
  const double size = diagonal(mesh);
  if (scene.volume.color) note_field(tool, mesh, "colour", scene.volume.color->field);
  if (scene.volume.extinction) note_field(tool, mesh, "extinction", scene.volume.extinction->field);
  tool.facts()["diagonal"] = size;
  tool.facts()["optical_depth"] = {{"mean", s.mean_optical_depth},
                                   {"largest", s.largest_optical_depth}};
  tool.note(fmt::format("diagonal {:g}; optical depth {:.3g} in the mean, {:.3g} at most", size,
                        s.mean_optical_depth, s.largest_optical_depth));
}

void note_work(Tool& tool, const ZooMesh& mesh, const RenderStatistics& s) {
  tool.facts()["cells"] = mesh.cell_count();
  tool.facts()["segments"] = s.segments;
  tool.facts()["covered_pixels"] = s.covered_pixels;
  tool.facts()["splatted_cells"] = s.splatted_cells;
  tool.facts()["witness_violations"] = s.violations;
  tool.facts()["seconds"]["prepare"] = s.prepare_seconds;
  tool.facts()["seconds"]["tiles"] = s.tile_seconds;
  tool.detail(fmt::format("{} segments in {:.3f} s", s.segments, s.tile_seconds));
  if (s.splatted_cells > 0)
    tool.note(fmt::format("{} of {} cells splatted", s.splatted_cells, mesh.cell_count()));
  if (s.violations > 0)
    tool.warn(
        fmt::format("{} ray segments were met out of order: the picture is wrong there (cells "
                    "overlap, or the order does not fit)",
                    s.violations));
}

// The part of the picture that is wanted, from X,Y,W,H.
PixelRect part_of_picture(const std::string& crop, const Scene& scene) {
  if (crop.empty()) return whole_picture(scene.image);
  PixelRect part;
  const char *at = crop.data(), *end = crop.data() + crop.size();
  for (std::uint32_t* number : {&part.x, &part.y, &part.width, &part.height}) {
    const auto [next, error] = std::from_chars(at, end, *number);
    const bool last = number == &part.height;
    if (error != std::errc() || (last ? next != end : next == end || *next != ','))
      throw UsageError("--crop: expected X,Y,WIDTH,HEIGHT in pixels, as 300,200,64,64 (found " +
                       crop + ")");
    at = last ? next : next + 1;
  }
  require_inside(part, scene.image);
  return part;
}

std::optional<Supersampling> sampling_of(const Options& options, const Scene& scene) {
  if (!options.samples) return std::nullopt;
  const Supersampling sampling{*options.samples,
                               options.filter == "box" ? SampleFilter::box : SampleFilter::bspline};
  require_possible(sampling, scene.image);
  return sampling;
}

RenderResult render_part(const ZooMesh& mesh, const VisibilityOrder& order, const Scene& scene,
                         const PixelRect& part, const std::optional<Supersampling>& sampling,
                         std::span<const Channel> channels, bool with_background) {
  if (sampling) return render_supersampled(mesh, order, scene, part, *sampling, with_background);
  const PartRenderer renderer(mesh, order, scene, channels);
  RenderResult result = renderer.render(part, with_background);
  result.statistics.prepare_seconds += renderer.prepare_seconds();
  return result;
}

void render(Tool& tool, Options options) {
  require_known_image_extension(options.output);
  add_size(options.size, options.overrides);
  const std::vector<Channel> channels = parse_channels(options.channels);
  if (!channels.empty() && options.output.ends_with(".png"))
    throw UsageError("--channels: PNG holds colours alone (.exr, .npy or .f32 expected)");
  const ParsedScene parsed = read_scene(options.view, options.overrides);
  for (const std::string& line : parsed.notes) tool.note(line);
  const Scene& scene = parsed.scene;
  const PixelRect part = part_of_picture(options.crop, scene);
  const auto sampling = sampling_of(options, scene);
  const ZooFile file = tool.timed("read", [&] { return read_mesh(options.input); });
  check_renderable(file.mesh, scene);
  const OrderRecord record = find_order(tool, options, file, scene);
  const RenderResult result = tool.timed("render", [&] {
    return render_part(file.mesh, record.order, scene, part, sampling, channels,
                       !options.no_background);
  });
  note_work(tool, file.mesh, result.statistics);
  note_optics(tool, file.mesh, scene, result.statistics);
  tool.timed("write", [&] {
    write_image(options.output, result.image,
                {.linear = options.linear,
                 .background_included = !options.no_background,
                 .attributes = {{"Software", "hiac-render " + version_text()},
                                {"hiac:mesh", record.mesh_hash},
                                {"hiac:specification", to_toml(scene)}}});
  });
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool(
      "hiac-render", "Makes a volume-rendered picture of a mesh.",
      "  hiac-render part.zoo --view view.toml -o part.png\n"
      "  hiac-render part.zoo --view view.toml --order part.order --size 2048x1536 -o part.exr\n"
      "  hiac-render part.zoo --view view.toml --set camera.fov=20 -o part.npy\n"
      "  hiac-render part.zoo --view view.toml --channels depth,error -o part.exr\n"
      "  hiac-render part.zoo --view view.toml --crop 300,200,64,64 -o detail.npy\n"
      "  hiac-render part.zoo --view view.toml --samples 8 --filter bspline -o truth.exr\n"
      "  hiac-render part.zoo --view view.toml --set render.splat_below=2 -o splatted.exr");
  Options options;
  auto& app = tool.app();
  app.add_option("MESH", options.input, "Zoo mesh; - or none: stdin");
  app.add_option("--view", options.view, "Image specification (TOML)")
      ->required()
      ->type_name("SPEC");
  app.add_option("--order", options.order,
                 "Order file of hiac-sort; without one the mesh is sorted first")
      ->type_name("FILE");
  app.add_option("-o,--output", options.output, "Image: .exr .npy .f32 .png")
      ->required()
      ->type_name("IMAGE");
  app.add_option("--size", options.size, "Size in pixels instead of the specification's")
      ->type_name("WxH");
  app.add_option("--set", options.overrides, "Override KEY=VALUE of the specification; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  CLI::Option* channels =
      app.add_option("--channels", options.channels,
                     "Further channels of the picture, with commas between: " + channel_names())
          ->type_name("LIST");
  app.add_option("--crop", options.crop,
                 "Only these W x H pixels, from column X and row Y on; as in the whole picture")
      ->type_name("X,Y,W,H");
  CLI::Option* samples =
      app.add_option("--samples", options.samples, "N x N rays a pixel, filtered, instead of one")
          ->excludes(channels)
          ->type_name("N");
  app.add_option("--filter", options.filter,
                 "Of the samples: box (their mean; the default) or bspline (three pixels wide)")
      ->needs(samples)
      ->check(CLI::IsMember({"box", "bspline"}))
      ->type_name("FILTER");
  app.add_flag("--no-background", options.no_background,
               "Leave the background out, so that images can be accumulated");
  app.add_flag("--linear", options.linear, "8-bit images: linear values instead of sRGB");
  return tool.run(argc, argv, [&] { render(tool, options); });
}

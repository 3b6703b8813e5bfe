// hiac-compare: how far an image is from another.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/alignment.hpp"
#include "hiac/image/difference.hpp"
#include "hiac/image/heat_map.hpp"
#include "hiac/image/image_io.hpp"
#include "tools/common/text_output.hpp"
#include "tools/common/tool.hpp"
#include "tools/compare/comparison.hpp"
#include "tools/compare/projection.hpp"
#include "tools/compare/truth.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;

struct Options {
  PictureCommand truth;
  std::string image, reference, heat_map, heat_map_of = "difference";
  double max_error = std::numeric_limits<double>::infinity();
  double max_rmse = std::numeric_limits<double>::infinity();
  ReadOptions reading;

  [[nodiscard]] bool has_truth() const { return !truth.input.empty(); }
};

void require_comparable(const Image& image, const Image& reference, const Options& options) {
  if (image.width() != reference.width() || image.height() != reference.height())
    throw JudgementError(
        fmt::format("{}: an image of another size ({} x {} pixels expected, as {} "
                    "has; {} x {} found)",
                    options.image, reference.width(), reference.height(), options.reference,
                    image.width(), image.height()));
}

/// Channels that one image has alone are told; without any common one there is nothing to compare.
void note_lonely_channels(Tool& tool, const Image& image, const Image& reference,
                          const Options& options) {
  const auto note_missing = [&](const Image& from, const std::string& name, const Image& in) {
    for (const std::string& channel : from.channels())
      if (!in.channel_index(channel))
        tool.warn(fmt::format("channel {} is only in {} and is not compared", channel, name));
  };
  note_missing(image, options.image, reference);
  note_missing(reference, options.reference, image);
}

/// The scale that colours mean: FLIP's own from 0 to 1; for differences up to the largest finite.
void write_heat_map(Tool& tool, const Options& options, const Comparison& comparison,
                    const Image& image, const Image& reference) {
  const bool of_flip = options.heat_map_of == "flip";
  if (of_flip && !comparison.flip)
    throw InputError(options.heat_map,
                     "no FLIP to draw (images without colour, or with colours "
                     "that are not finite)");
  const Image map = of_flip ? *comparison.flip : difference_map(image, reference);
  double largest = of_flip ? 1 : 0;
  for (const double value : map.values())
    if (std::isfinite(value)) largest = std::max(largest, value);
  write_image(options.heat_map, heat_map(map, largest));
  tool.facts()["heat_map"] = {{"of", options.heat_map_of}, {"largest", largest}};
  tool.note(fmt::format("{}: {} from 0 (dark blue) to {:g} (yellow); red: not finite",
                        options.heat_map, of_flip ? "FLIP" : "largest difference of all channels",
                        largest));
}

void judge(const Options& options, const Comparison& comparison) {
  const auto worst = [&](double Difference::*measure) {
    return *std::max_element(
        comparison.channels.begin(), comparison.channels.end(),
        [&](const Difference& a, const Difference& b) { return a.*measure < b.*measure; });
  };
  const Difference by_error = worst(&Difference::largest), by_rmse = worst(&Difference::rmse);
  if (by_error.largest > options.max_error)
    throw JudgementError(fmt::format(
        "{}: too far from {} (at most {:g} allowed; {:g} found in channel {} at pixel {},{})",
        options.image, options.reference, options.max_error, by_error.largest, by_error.channel,
        by_error.x, by_error.y));
  if (by_rmse.rmse > options.max_rmse)
    throw JudgementError(fmt::format(
        "{}: too far from {} (RMSE of at most {:g} allowed; {:g} found in channel {})",
        options.image, options.reference, options.max_rmse, by_rmse.rmse, by_rmse.channel));
}

void claim_files(Tool& tool, const Options& options) {
  RunFiles files{image_parts(options.image), {}};
  if (options.has_truth())
    files.inputs.insert(files.inputs.end(), {options.truth.input, options.truth.view});
  else
    for (std::string& part : image_parts(options.reference))
      files.inputs.push_back(std::move(part));
  add_image(files.outputs, "--heatmap", options.heat_map);
  tool.claim(std::move(files));
}

/// What a comparison with the truth has beyond one of two images.
std::string told_of_truth(Tool& tool, const Image& image, const Image& truth,
                          TruthRenderer& renderer, const std::optional<double>& error) {
  Misfit misfit = tool.timed("align", [&] { return find_misfit(image, truth); });
  const auto projection = tool.timed("projection", [&] {
    return find_projection(renderer.camera(), image, misfit,
                           [&](const Camera& camera, ImageSize size, std::uint32_t samples) {
                             return renderer.picture_of(camera, size, samples);
                           });
  });
  std::string text = error ? fmt::format("  the truth is exact to {:.1e}\n", *error) : "";
  if (projection) text += "  " + line_of(renderer.camera(), *projection, misfit.rmse) + '\n';
  // what is wrong beside the projection
  const double rmse = misfit.rmse;
  if (projection) misfit = projection->misfit;
  for (const std::string& line : lines_of(misfit)) text += "  " + line + '\n';
  put_into(tool.facts(), misfit);
  if (projection) put_into(tool.facts(), *projection, rmse);
  tool.facts()["truth_error"] = error ? nlohmann::ordered_json(*error) : nullptr;
  return text;
}

void compare(Tool& tool, Options options) {
  if (options.has_truth() != options.reference.empty())
    throw UsageError(options.has_truth() ? "B: not beside --truth (found " + options.reference + ")"
                                         : "B or --truth MESH is required: what to compare A with");
  if (options.has_truth()) options.reference = "the truth of " + options.truth.input;
  claim_files(tool, options);
  if (!options.heat_map.empty()) require_known_image_extension(options.heat_map);
  Image image =
      tool.timed("read", [&] { return read_image(options.image, options.reading).image; });
  std::optional<double> error;
  std::optional<TruthRenderer> renderer;
  const Image reference = [&] {
    if (!options.has_truth()) return read_image(options.reference, options.reading).image;
    Truth truth = renderer.emplace(tool, options.truth, image, options.image).truth();
    error = truth.error;
    return std::move(truth.image);
  }();
  tool.facts()["image"] = options.image;
  tool.facts()["reference"] = options.reference;
  require_comparable(image, reference, options);
  tool.facts()["width"] = image.width();
  tool.facts()["height"] = image.height();
  note_lonely_channels(tool, image, reference, options);
  const Comparison comparison = tool.timed("compare", [&] {
    return compare_images(image, options.image, reference, options.reference);
  });
  put_into(tool.facts(), comparison);
  std::string text = fmt::format("{} against {}: {} x {} pixels{}\n{}", options.image,
                                 options.reference, image.width(), image.height(),
                                 comparison.equal ? ", equal" : "", table(comparison));
  if (options.has_truth()) text += told_of_truth(tool, image, reference, *renderer, error);
  if (tool.common().json != "-") write_text("-", text);
  if (!options.heat_map.empty()) write_heat_map(tool, options, comparison, image, reference);
  judge(options, comparison);
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("A", options.image, "Image (" + image_extensions() + ")")->required();
  app.add_option("B", options.reference, "Image to compare it with: the reference");
  add_truth_options(app, options.truth);
  app.add_option("--max-error", options.max_error,
                 "Fail (exit 1) when a value differs by more than this")
      ->check(CLI::NonNegativeNumber)
      ->type_name("X");
  app.add_option("--max-rmse", options.max_rmse,
                 "Fail (exit 1) when a channel's root mean square error is more than this")
      ->check(CLI::NonNegativeNumber)
      ->type_name("X");
  app.add_option("--heatmap", options.heat_map, "Draw the differences pixel by pixel")
      ->type_name("IMAGE");
  app.add_option(
         "--heatmap-of", options.heat_map_of,
         "Draw the largest absolute difference of all channels (difference), or FLIP (flip)")
      ->check(CLI::IsMember({"difference", "flip"}))
      ->capture_default_str();
  app.add_option("--width", options.reading.width, "Width in pixels of .f32 images");
  app.add_flag("--linear", options.reading.linear,
               "The integers of .tiff and .sgi images are linear, not sRGB-encoded");
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool(
      "hiac-compare",
      "Measures how far image A is from image B.\n\n"
      "Errors are absolute differences of linear, premultiplied values, channel by channel\n"
      "(matched by name); the relative mean square error is the mean of\n"
      "(a - b)^2 / (|b| + 0.01)^2. A NaN or an infinity equals itself and differs infinitely\n"
      "from everything else. PSNR assumes a signal from 0 to 1; SSIM and FLIP (67 pixels per\n"
      "degree) compare the colours as displayed, from 0 to 1. Images of different sizes, or\n"
      "without a common channel, fail the judgement.\n\n"
      "With --truth the reference is the exact picture of a mesh, and what is wrong with A as a\n"
      "whole is told: turned or mirrored, in another encoding, in another projection or with\n"
      "another view angle, shifted, or of another scale.",
      "  hiac-compare new.exr reference.exr\n"
      "  hiac-compare new.npy reference.npy --max-error 1e-12 --json facts.json\n"
      "  hiac-compare new.png old.png --heatmap where.png --heatmap-of flip\n"
      "  hiac-compare theirs.png --truth run.vtu --view view.toml   # how wrong is this picture?");
  Options options;
  add_options(tool.app(), options);
  return tool.run(argc, argv, [&] { compare(tool, options); });
}

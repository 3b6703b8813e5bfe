#include "tools/compare/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hiac/base/error.hpp"
#include "hiac/image/flip.hpp"
#include "hiac/image/ssim.hpp"

namespace hiac::tools {

using Json = nlohmann::ordered_json;

Comparison compare_images(const Image& image, const std::string& name, const Image& reference,
                          const std::string& reference_name) {
  Comparison comparison;
  comparison.channels = channel_differences(image, reference);
  if (comparison.channels.empty())
    throw JudgementError(fmt::format("{}: no channel in common with {} ({} expected, {} found)",
                                     name, reference_name, fmt::join(reference.channels(), " "),
                                     fmt::join(image.channels(), " ")));
  comparison.psnr = peak_signal_to_noise(image, reference);
  comparison.ssim = structural_similarity(image, reference);
  comparison.flip = flip_map(image, reference);
  if (comparison.flip) {
    const auto values = comparison.flip->values();
    comparison.mean_flip =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    comparison.largest_flip = *std::max_element(values.begin(), values.end());
  }
  comparison.equal =
      comparison.channels.size() == image.channel_count() &&
      comparison.channels.size() == reference.channel_count() &&
      std::ranges::all_of(comparison.channels, [](const Difference& d) { return d.largest == 0; });
  return comparison;
}

// For programs ------------------------------------------------------------------------------------

namespace {

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json();
}

}  // namespace

void put_into(Json& facts, const Comparison& comparison) {
  facts["equal"] = comparison.equal;
  facts["channels"] = Json::array();
  for (const Difference& d : comparison.channels)
    facts["channels"].push_back({{"name", d.channel},
                                 {"rmse", number(d.rmse)},
                                 {"relative_mse", number(d.relative_mse)},
                                 {"mean_error", number(d.mean_absolute)},
                                 {"largest_error", number(d.largest)},
                                 {"largest_at", {d.x, d.y}},
                                 {"infinite", d.infinite}});
  facts["psnr"] = number(comparison.psnr);
  facts["ssim"] = number(comparison.ssim);
  facts["flip"] = {{"mean", number(comparison.mean_flip)},
                   {"largest", number(comparison.largest_flip)}};
}

void put_into(Json& facts, const Misfit& misfit) {
  Json& found = facts["misfit"] = {{"rmse", misfit.rmse}};
  if (misfit.orientation)
    found["orientation"] = {{"name", name_of(misfit.orientation->orientation)},
                            {"rmse_without", misfit.orientation->rmse}};
  if (misfit.encoding)
    found["encoding"] = {{"name", name_of(misfit.encoding->encoding)},
                         {"rmse_without", misfit.encoding->rmse}};
  if (misfit.place)
    found["place"] = {{"shift", misfit.place->shift},
                      {"scale", misfit.place->scale},
                      {"rmse_without", misfit.place->rmse}};
}

// For people --------------------------------------------------------------------------------------

namespace {

std::string summary_line(const char* label, const std::optional<double>& value,
                         const std::string& unit) {
  return fmt::format("  {:<10}{}\n", label,
                     value ? fmt::format("{:.6g}{}", *value, unit) : "not defined");
}

}  // namespace

std::string table(const Comparison& comparison) {
  std::string text = fmt::format("  {:<10}{:>14}{:>14}{:>14}{:>14}  {}\n", "channel", "RMSE",
                                 "relative MSE", "mean error", "largest", "at pixel");
  for (const Difference& d : comparison.channels) {
    text += fmt::format("  {:<10}{:>14.6g}{:>14.6g}{:>14.6g}{:>14.6g}  {},{}", d.channel, d.rmse,
                        d.relative_mse, d.mean_absolute, d.largest, d.x, d.y);
    text += d.infinite > 0 ? fmt::format("  ({} infinite)\n", d.infinite) : "\n";
  }
  text += summary_line("PSNR", comparison.psnr, " dB");
  text += summary_line("SSIM", comparison.ssim, "");
  text += summary_line("FLIP", comparison.mean_flip,
                       comparison.largest_flip
                           ? fmt::format(" in the mean, {:.6g} at most", *comparison.largest_flip)
                           : "");
  return text;
}

std::vector<std::string> lines_of(const Misfit& misfit) {
  std::vector<std::string> lines;
  if (misfit.orientation)
    lines.push_back(fmt::format("the picture is {}: RMSE {:.3g} as it is, {:.3g} turned back",
                                name_of(misfit.orientation->orientation), misfit.rmse,
                                misfit.orientation->rmse));
  if (misfit.encoding)
    lines.push_back(fmt::format("the picture has {}: RMSE {:.3g} as it is, {:.3g} without",
                                name_of(misfit.encoding->encoding), misfit.rmse,
                                misfit.encoding->rmse));
  if (misfit.place)
    lines.push_back(fmt::format(
        "the picture is shifted by {:.2f} pixels to the right and {:.2f} down, and {:.4f} times as "
        "large: RMSE of the luminance {:.3g} in its place",
        misfit.place->shift[0], misfit.place->shift[1], misfit.place->scale, misfit.place->rmse));
  return lines;
}

}  // namespace hiac::tools

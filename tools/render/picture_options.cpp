#include "tools/render/picture_options.hpp"

#include <charconv>
#include <span>
#include <system_error>

#include "hiac/base/error.hpp"
#include "hiac/frame/channels.hpp"
#include "tools/common/as_option.hpp"

namespace hiac::tools {
namespace {

// Numbers of pixels with commas between; false where the text is something else.
bool parse_pixels(const std::string& text, std::span<std::uint32_t> numbers) {
  const char *at = text.data(), *end = text.data() + text.size();
  for (std::uint32_t& number : numbers) {
    const auto [next, error] = std::from_chars(at, end, number);
    const bool last = &number == &numbers.back();
    if (error != std::errc() || (last ? next != end : next == end || *next != ',')) return false;
    at = last ? next : next + 1;
  }
  return true;
}

PixelRect parse_crop(const std::string& text) {
  std::array<std::uint32_t, 4> numbers{};
  if (!parse_pixels(text, numbers))
    throw UsageError("--crop: expected X,Y,WIDTH,HEIGHT in pixels, as 300,200,64,64 (found " +
                     text + ")");
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

}  // namespace

std::array<std::uint32_t, 2> parse_pixel(const std::string& text) {
  std::array<std::uint32_t, 2> numbers{};
  if (!parse_pixels(text, numbers))
    throw UsageError("--pixel: expected a column and a row, as 300,200 (found " + text + ")");
  return numbers;
}

void add_picture_options(CLI::App& app, PictureOptions& options) {
  app.add_option("--channels", options.channels,
                 "Further channels of the picture, separated by commas: " + channel_names())
      ->type_name("LIST");
  app.add_option("--crop", options.crop, "Render only the W x H pixels from column X and row Y on")
      ->type_name("X,Y,W,H");
  CLI::Option* samples = app.add_option("--samples", options.samples,
                                        "Take N x N rays a pixel and filter them; default: one ray")
                             ->type_name("N");
  app.add_option(
         "--filter", options.filter,
         "Filter for --samples: box (their mean; the default) or bspline (three pixels wide)")
      ->needs(samples)
      ->check(CLI::IsMember({"box", "bspline"}))
      ->type_name("FILTER");
}

std::vector<std::string> further_channels(const PictureOptions& options) {
  std::vector<std::string> names;
  as_option("--channels: ", [&] {
    for (const Channel channel : parse_channels(options.channels))
      names.emplace_back(channel_name(channel));
  });
  return names;
}

PictureRequest picture_request(const PictureOptions& options, ImageSize size) {
  PictureRequest request;
  request.channels = further_channels(options);
  if (!options.crop.empty()) request.part = parse_crop(options.crop);
  if (options.samples)
    request.sampling = {*options.samples,
                        options.filter == "box" ? SampleFilter::box : SampleFilter::bspline};
  require_possible(request, size);
  return request;
}

}  // namespace hiac::tools

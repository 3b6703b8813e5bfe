#include "tools/common/render/picture_options.hpp"

#include "hiac/base/error.hpp"
#include "hiac/frame/channels.hpp"
#include "tools/common/as_option.hpp"
#include "tools/common/picture/picture_command.hpp"

namespace hiac::tools {
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

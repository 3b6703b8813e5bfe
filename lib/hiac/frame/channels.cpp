#include "hiac/frame/channels.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image.hpp"

namespace hiac {
namespace {

constexpr std::array<std::string_view, 6> kNames{"depth", "mean_depth", "transparency",
                                                 "cells", "witness",    "error"};

}  // namespace

std::string_view channel_name(Channel channel) { return kNames[static_cast<std::size_t>(channel)]; }

std::vector<std::string> image_channels(std::span<const Channel> channels) {
  std::vector<std::string> names = rgba_channels();
  for (const Channel channel : channels) names.emplace_back(channel_name(channel));
  return names;
}

std::string channel_names() { return fmt::format("{}", fmt::join(kNames, ", ")); }

std::vector<Channel> parse_channels(std::string_view list) {
  std::vector<Channel> channels;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    const std::string_view name = list.substr(0, comma);
    const auto at = std::ranges::find(kNames, name);
    if (at == kNames.end())
      throw UsageError(
          fmt::format("no channel is called '{}' (one of {} expected)", name, channel_names()));
    const auto channel = static_cast<Channel>(at - kNames.begin());
    if (std::ranges::find(channels, channel) != channels.end())
      throw UsageError(fmt::format("'{}' is there twice", name));
    channels.push_back(channel);
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return channels;
}

}  // namespace hiac

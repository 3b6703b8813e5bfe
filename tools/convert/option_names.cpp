#include "tools/convert/option_names.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace hiac::tools {

std::string with_option_names(std::string message) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kNames{
      {{"NamedFiles::outside_too", "--allow-external"},
       {"ReadOptions::nearest_time", "--time nearest:TIME"},
       {"ReadOptions::time", "--time"},
       {"ReadOptions::step", "--step"},
       {"ReadOptions::block", "--block"},
       {"ReadOptions::skip_unsupported", "--skip-unsupported"},
       {"ReadOptions::corners_of_unsupported", "--corners-only"},
       {"ReadOptions::approximate", "--approximate"}}};
  for (const auto& [member, option] : kNames)
    for (std::size_t at = message.find(member); at != std::string::npos;
         at = message.find(member, at + option.size()))
      message.replace(at, member.size(), option);
  return message;
}

}  // namespace hiac::tools

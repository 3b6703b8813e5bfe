#include "tools/common/picture/frames.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/session/frames.hpp"
#include "tools/common/as_option.hpp"

namespace hiac::tools {
namespace {

struct Place {
  std::size_t begin, end;  // of the whole of %04d
  std::size_t digits;
};

// The places for a number in a name.
std::vector<Place> places_in(const std::string& path) {
  std::vector<Place> places;
  for (std::size_t at = path.find('%'); at != std::string::npos; at = path.find('%', at + 1)) {
    std::size_t end = path.find_first_not_of("0123456789", at + 1);
    if (end == std::string::npos || path[end] != 'd' || end - at > 3) continue;
    const std::string width = path.substr(at + 1, end - at - 1);
    places.push_back({at, end + 1, width.empty() ? 1 : std::stoul(width)});
  }
  return places;
}

}  // namespace

std::vector<std::uint32_t> chosen_frames(const Scene& scene,
                                         const std::optional<std::uint32_t>& one) {
  return as_option("--", [&] { return frames_of(scene, one); });
}

bool has_frame_number(const std::string& path) { return !places_in(path).empty(); }

std::string frame_path(const std::string& path, std::uint32_t frame) {
  constexpr std::size_t kDigits = 4;
  const std::vector<Place> places = places_in(path);
  if (places.size() > 1)
    throw UsageError(fmt::format("-o {}: one place for the frame number expected, {} found", path,
                                 places.size()));
  if (places.size() == 1)
    return fmt::format("{}{:0{}}{}", path.substr(0, places[0].begin), frame, places[0].digits,
                       path.substr(places[0].end));
  const std::filesystem::path name(path);
  return (name.parent_path() / fmt::format("{}-{:0{}}{}", name.stem().string(), frame, kDigits,
                                           name.extension().string()))
      .string();
}

}  // namespace hiac::tools

#include "tools/common/picture/frames.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/session/frames.hpp"
#include "tools/common/as_option.hpp"
#include "tools/common/steps/number_pattern.hpp"

namespace hiac::tools {

std::vector<std::uint32_t> chosen_frames(const Scene& scene,
                                         const std::optional<std::uint32_t>& one) {
  return as_option("--", [&] { return frames_of(scene, one); });
}

bool has_frame_number(const std::string& path) { return !number_places(path).empty(); }

std::string frame_path(const std::string& path, std::size_t frame) {
  constexpr std::size_t kDigits = 4;
  const std::vector<NumberPlace> places = number_places(path);
  if (places.size() > 1)
    throw UsageError(
        fmt::format("-o {}: one place for the number expected, {} found", path, places.size()));
  if (places.size() == 1) return with_number(path, places[0], frame);
  const std::filesystem::path name(path);
  return (name.parent_path() / fmt::format("{}-{:0{}}{}", name.stem().string(), frame, kDigits,
                                           name.extension().string()))
      .string();
}

}  // namespace hiac::tools

#include "tools/common/steps/number_pattern.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::tools {

namespace fs = std::filesystem;

std::vector<NumberPlace> number_places(const std::string& path) {
  std::vector<NumberPlace> places;
  for (std::size_t at = path.find('%'); at != std::string::npos; at = path.find('%', at + 1)) {
    const std::size_t end = path.find_first_not_of("0123456789", at + 1);
    if (end == std::string::npos || path[end] != 'd' || end - at > 3) continue;
    const std::string width = path.substr(at + 1, end - at - 1);
    places.push_back({at, end + 1, width.empty() ? 1 : std::stoul(width)});
  }
  return places;
}

std::string with_number(const std::string& path, const NumberPlace& place, std::size_t number) {
  return fmt::format("{}{:0{}}{}", path.substr(0, place.begin), number, place.digits,
                     path.substr(place.end));
}

NumberPattern::NumberPattern(const std::string& option, std::string text)
    : option_(option), text_(std::move(text)) {
  const std::vector<NumberPlace> places = number_places(text_);
  if (places.size() != 1 || std::ranges::count(text_, '%') != 1)
    throw UsageError(
        fmt::format("{} {}: a name with one place for the step's number, as run-%04d.zoo, and no "
                    "other % expected",
                    option_, text_));
  place_ = places.front();
}

// The number, if this is the name that the pattern gives to it.
std::optional<std::size_t> NumberPattern::number_in(const std::string& path) const {
  const std::string_view before = std::string_view(text_).substr(0, place_.begin);
  const std::string_view behind = std::string_view(text_).substr(place_.end);
  if (path.size() <= before.size() + behind.size() || !path.starts_with(before) ||
      !path.ends_with(behind))
    return std::nullopt;
  const char* const end = path.data() + (path.size() - behind.size());
  std::size_t number = 0;
  const auto [rest, error] = std::from_chars(path.data() + before.size(), end, number);
  if (error != std::errc() || rest != end || path_of(number) != path) return std::nullopt;
  return number;
}

std::vector<std::size_t> NumberPattern::existing() const {
  const std::string folder = fs::path(text_).parent_path().string();
  if (folder.find('%') != std::string::npos)
    throw UsageError(
        fmt::format("{} {}: the number is in a folder's name (one in the file's name "
                    "expected)",
                    option_, text_));
  const std::string before =
      text_.substr(0, text_.size() - fs::path(text_).filename().native().size());
  std::vector<std::size_t> numbers;
  std::error_code error;
  for (fs::directory_iterator entry(before.empty() ? "." : before, error), end;
       !error && entry != end; entry.increment(error))
    if (const auto number = number_in(before + entry->path().filename().string()))
      numbers.push_back(*number);
  if (error) throw InputError(text_, fmt::format("cannot be looked for ({})", error.message()));
  if (numbers.empty()) throw InputError(text_, "no file has a name of this pattern");
  std::ranges::sort(numbers);
  return numbers;
}

}  // namespace hiac::tools

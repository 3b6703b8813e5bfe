#include "formats/exodus/run_pieces.hpp"

#include <charconv>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats::exodus {
namespace {

/// More pieces than any run has.
constexpr std::size_t kMostPieces = 1 << 20;

/// What follows the last dot of a name, if these are digits; the name keeps what is before the dot.
std::optional<std::string_view> take_digits(std::string_view& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos || dot == 0 || dot + 1 == name.size()) return std::nullopt;
  const std::string_view digits = name.substr(dot + 1);
  if (digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  name = name.substr(0, dot);
  return digits;
}

std::size_t number_of(std::string_view digits) {
  std::size_t number = kMostPieces;  // what does not fit is too large, too
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

}  // namespace

std::vector<std::string> run_pieces(const std::string& path) {
  const std::filesystem::path whole(path);
  const std::string file = whole.filename().string();
  std::string_view name = file;
  const auto piece = take_digits(name);
  const auto count = piece ? take_digits(name) : std::nullopt;
  if (!count || piece->size() != count->size()) return {path};
  const std::size_t pieces = number_of(*count);
  if (pieces < 2 || pieces >= kMostPieces || number_of(*piece) >= pieces) return {path};
  std::vector<std::string> paths;
  for (std::size_t k = 0; k < pieces; ++k) {
    const std::string other = fmt::format("{}.{}.{:0{}}", name, *count, k, count->size());
    paths.push_back((whole.parent_path() / other).string());
    std::error_code error;
    if (!std::filesystem::exists(paths.back(), error))
      throw InputError(path,
                       fmt::format("is piece {} of {} of a run by its name, and {} is missing "
                                   "(under another name it is read alone)",
                                   number_of(*piece), pieces, paths.back()));
  }
  return paths;
}

}  // namespace hiac::formats::exodus

#include "hiac/scene/toml/spec_path.hpp"

#include <algorithm>
#include <charconv>

namespace hiac {

std::optional<SpecPath> spec_path(std::string_view key) {
  constexpr std::size_t kMaxParts = 16;
  SpecPath parts(1);
  for (const char c : key) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  const bool malformed = std::any_of(parts.begin(), parts.end(), [](const std::string& part) {
    return part.empty() || part.find_first_of(" \t\n\"'[]") != std::string::npos;
  });
  if (malformed || parts.size() > kMaxParts) return std::nullopt;
  return parts;
}

std::optional<std::size_t> as_index(std::string_view part) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (error != std::errc{} || end != part.data() + part.size()) return std::nullopt;
  return index;
}

}  // namespace hiac

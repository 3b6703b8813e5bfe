#include "formats/common/mesh/vector_names.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace hiac::formats {
namespace {

constexpr std::array<char, 3> kAxes{'X', 'Y', 'Z'};

/// The places of stem + X, Y and Z, if all three exist.
std::optional<std::vector<std::size_t>> axes_of(const std::vector<std::string>& names,
                                                const std::string& stem) {
  std::vector<std::size_t> parts;
  for (const char axis : kAxes) {
    const auto found = std::find(names.begin(), names.end(), stem + axis);
    if (found == names.end()) return std::nullopt;
    parts.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  return parts;
}

}  // namespace

std::vector<VectorName> vectors_among(const std::vector<std::string>& names) {
  std::vector<VectorName> result;
  std::vector<bool> taken(names.size(), false);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (taken[i]) continue;
    const std::string& name = names[i];
    const bool axis =
        name.size() > 1 && std::find(kAxes.begin(), kAxes.end(), name.back()) != kAxes.end();
    const std::string stem = axis ? name.substr(0, name.size() - 1) : name;
    const auto parts = axis ? axes_of(names, stem) : std::nullopt;
    if (!parts) {
      result.push_back({name, {i}});
      continue;
    }
    for (const std::size_t part : *parts) taken[part] = true;
    result.push_back({stem, *parts});
  }
  return result;
}

}  // namespace hiac::formats

#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hiac/scene/toml/spec_value.hpp"

namespace hiac {

/// One key of a table of the specification, whose values are stored in a T. The tables of keys
/// drive reading, the detection of unknown keys, writing, and the comments of a starter
/// specification.
template <typename T>
struct SpecKey {
  std::string_view name;
  std::string_view meaning;  ///< a few words, for a comment
  bool required;
  void (*read)(const SpecValue& value, T& into);
  /// Returns the value as TOML, or nothing if it is omitted; null for a key that is a table itself.
  std::optional<std::string> (*write)(const T& from);
};

/// Throws if `table` has a key that is not in `known`, and suggests the nearest.
void refuse_unknown_keys(const SpecValue& table, std::span<const std::string_view> known);

/// Reads the keys of a table; throws for missing ones.
template <typename T>
void read_known_keys(const SpecValue& table, std::span<const SpecKey<T>> keys, T& into) {
  for (const SpecKey<T>& key : keys) {
    if (table.has(key.name))
      key.read(table.child(key.name), into);
    else if (key.required)
      table.fail_at(key.name, "is missing");
  }
}

/// Reads the keys of a table and throws for missing and for unknown ones.
template <typename T>
void read_keys(const SpecValue& table, std::span<const SpecKey<T>> keys, T& into) {
  std::vector<std::string_view> names;
  for (const SpecKey<T>& key : keys) names.push_back(key.name);
  refuse_unknown_keys(table, names);
  read_known_keys(table, keys, into);
}

/// Returns values as TOML; numbers are exact to the last bit.
std::string toml_text(double value);
std::string toml_text(std::string_view value);
std::string toml_text(std::span<const double> values);

/// Returns the name of a value as TOML.
template <typename E>
std::string name_text(std::span<const std::pair<std::string_view, E>> names, E value) {
  for (const auto& [name, entry] : names)
    if (entry == value) return toml_text(name);
  return toml_text("");
}

}  // namespace hiac

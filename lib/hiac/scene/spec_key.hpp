#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hiac/scene/spec_value.hpp"

namespace hiac {

/// One key of a table of the specification whose values end up in a T. The tables of keys drive
/// reading, the detection of unknown keys, writing, and the comments of a starter specification.
template <typename T>
struct SpecKey {
  std::string_view name;
  std::string_view meaning;  ///< a few words, for a comment
  bool required;
  void (*read)(const SpecValue& value, T& into);
  /// The value as TOML, nothing where it is left out; null for a key that is a table itself.
  std::optional<std::string> (*write)(const T& from);
};

/// Throws for a key of `table` that is not among `known`, suggesting the nearest.
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

/// The same for a table that has no other keys; throws for unknown ones.
template <typename T>
void read_keys(const SpecValue& table, std::span<const SpecKey<T>> keys, T& into) {
  std::vector<std::string_view> names;
  for (const SpecKey<T>& key : keys) names.push_back(key.name);
  refuse_unknown_keys(table, names);
  read_known_keys(table, keys, into);
}

/// Values as TOML; numbers to the last bit.
std::string toml_text(double value);
std::string toml_text(std::string_view value);
std::string toml_text(std::span<const double> values);

/// The name of a value as TOML.
template <typename E>
std::string name_text(std::span<const std::pair<std::string_view, E>> names, E value) {
  for (const auto& [name, entry] : names)
    if (entry == value) return toml_text(name);
  return toml_text("");
}

}  // namespace hiac

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <toml++/toml.h>

#include "hiac/scene/specification.hpp"

namespace hiac {

/// One override that was applied: the key's path and the option as the user wrote it.
struct AppliedOverride {
  std::string path;
  std::string option;
};

/// The source of a specification, as errors name it, and the notes made while reading it.
struct SpecContext {
  std::string subject;
  std::string folder;
  std::vector<AppliedOverride> overrides;
  std::vector<std::string> notes;
  /// Points of [volume.color], [volume.extinction] and [skin.color] that wait for their fields'
  /// values.
  std::optional<UnscaledPoints<3>> color = {};
  std::optional<UnscaledPoints<1>> extinction = {};
  Annotation annotation = {};
  /// The scale of [annotation.colorbar], without it that of [volume.color], is "log".
  bool bar_is_logarithmic = false;
  std::optional<UnscaledPoints<3>> skin_color = {};

  /// Returns the override that set the key `path`, a part of it or a table around it, or null.
  [[nodiscard]] const AppliedOverride* override_of(std::string_view path) const;

  /// Throws UsageError with the option if an override is the cause, else InputError with the file,
  /// the line (unless `line` is 0) and the key.
  [[noreturn]] void fail(const std::string& path, std::uint32_t line,
                         const std::string& what) const;
};

/// One value of a specification with its key's path; its readers throw through SpecContext::fail.
class SpecValue {
 public:
  SpecValue(const toml::node& node, std::string path, SpecContext& context)
      : node_(&node), path_(std::move(path)), context_(&context) {}

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] SpecContext& context() const { return *context_; }
  [[nodiscard]] const toml::node& node() const { return *node_; }
  [[noreturn]] void fail(const std::string& what) const;

  /// A number, integer or float; `inf` only where allowed, never NaN.
  [[nodiscard]] double number() const;  ///< of magnitude at most kLargestNumber
  [[nodiscard]] double at_least_finite(double smallest) const;  ///< of any size
  [[noreturn]] void fail_bright(double component) const;        ///< more than kLargestColor
  [[nodiscard]] double number_or_infinity() const;
  [[nodiscard]] double positive() const;
  [[nodiscard]] double at_least(double smallest) const;
  [[nodiscard]] double inside(double low, double high) const;  ///< low <= value <= high
  /// A whole number from `low` to `high`.
  [[nodiscard]] std::uint32_t whole(std::uint32_t low, std::uint32_t high) const;
  /// `true` or `false`.
  [[nodiscard]] bool truth() const;
  /// A string that is not empty.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::array<double, 3> triple() const;
  /// Red, green, blue, none negative.
  [[nodiscard]] std::array<double, 3> color() const;
  /// A list of exactly `count` values (any number where it is 0). The elements carry this value's
  /// path: messages name the key as a whole.
  [[nodiscard]] std::vector<SpecValue> list(std::size_t count = 0) const;

  /// Whether it is a list, of tables or of other values.
  [[nodiscard]] bool is_list() const { return node_->is_array(); }
  [[nodiscard]] bool is_table() const { return node_->is_table(); }
  /// A table, whose keys have paths below this one's.
  [[nodiscard]] const toml::table& table() const;
  /// The value below a key of this table, if there.
  [[nodiscard]] const toml::node* find(std::string_view key) const;
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  [[nodiscard]] std::string path_of(std::string_view key) const;
  /// The value of a key of this table, which must exist.
  [[nodiscard]] SpecValue child(std::string_view key) const;
  /// Throws for a key of this table, whether it exists or not.
  [[noreturn]] void fail_at(std::string_view key, const std::string& what) const;
  /// The tables of a list of tables; element i has the path `path.i`.
  [[nodiscard]] std::vector<SpecValue> tables() const;

  /// The entry of `names` with this string; throws listing them.
  template <typename E>
  [[nodiscard]] E name_of(std::span<const std::pair<std::string_view, E>> names) const {
    const std::string found = text();
    std::string known;
    for (const auto& [name, value] : names) {
      if (name == found) return value;
      known += (known.empty() ? "" : ", ") + std::string(name);
    }
    fail_name(found, known);
  }

 private:
  [[noreturn]] void fail_kind(const char* expected) const;
  [[noreturn]] void fail_name(const std::string& found, const std::string& known) const;

  const toml::node* node_;
  std::string path_;
  SpecContext* context_;
};

}  // namespace hiac

#include <algorithm>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/annotation_keys.hpp"
#include "hiac/scene/camera_keys.hpp"
#include "hiac/scene/scene_keys.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/scene/toml/spec_override.hpp"
#include "hiac/scene/toml/spec_text.hpp"
#include "hiac/scene/toml/spec_value.hpp"

namespace hiac {

namespace {

ParsedScene parse(std::string_view text, const std::string& subject, const std::string& folder,
                  std::span<const Override> overrides) {
  toml::table document = parse_toml(text, subject);
  SpecContext context{.subject = subject, .folder = folder, .overrides = {}, .notes = {}};
  for (const Override& option : overrides)
    context.overrides.push_back(apply_override(document, option));
  inherit_keyframes(document);
  ParsedScene parsed;
  const SpecValue root(document, "", context);
  read_keys(root, scene_keys(), parsed.scene);
  check_camera_path(root, parsed.scene);
  check_annotation(root, parsed.scene, context.annotation);
  parsed.notes = std::move(context.notes);
  parsed.color = std::move(context.color);
  parsed.extinction = std::move(context.extinction);
  parsed.annotation = std::move(context.annotation);
  parsed.annotation.bar_is_logarithmic = context.bar_is_logarithmic;
  parsed.skin_color = std::move(context.skin_color);
  return parsed;
}

/// Whether a specification is right without the overrides.
bool is_right(std::string_view text, const std::string& subject, const std::string& folder) {
  try {
    parse(text, subject, folder, {});
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

ParsedScene parse_scene(std::string_view text, const std::string& subject,
                        const std::string& folder, std::span<const Override> overrides) {
  try {
    return parse(text, subject, folder, overrides);
  } catch (const InputError& error) {
    // an override can make another line of the file wrong
    if (overrides.empty() || !is_right(text, subject, folder)) throw;
    throw UsageError(fmt::format("{}: {}", fmt::join(overrides, " "), error.what()));
  }
}

ParsedScene read_scene(const std::string& path, std::span<const Override> overrides) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return parse_scene(read_text_file(path), path, folder, overrides);
}

}  // namespace hiac

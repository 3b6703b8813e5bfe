#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hiac/scene/scene.hpp"

namespace hiac {

/// A specification as read, with notes for the user.
struct ParsedScene {
  Scene scene;
  /// One line each: the error bound of a preset's conversion to piecewise-linear RGB.
  std::vector<std::string> notes;
};

/// Replaces one value of a specification: KEY=VALUE, such as `camera.fov=20` or
/// `isosurface.0.value=3`. VALUE is TOML; a bare word is a string
/// (`camera.projection=orthographic`); an empty one removes the key. Elements of lists are counted
/// from 0.
using Override = std::string;

/// Reads a specification from a file. Paths inside it (presets) are relative to the file's folder.
/// Overrides apply in order before anything is interpreted. Throws InputError "FILE:LINE: key
/// `camera.fov`: what is wrong" for the first fault found, and UsageError "camera.fov=200: what is
/// wrong" if an override is the cause.
ParsedScene read_scene(const std::string& path, std::span<const Override> overrides = {});

/// Reads a specification from text. `subject` replaces the file in messages; relative paths start
/// at `folder` ("" for the working folder).
ParsedScene parse_scene(std::string_view text, const std::string& subject,
                        const std::string& folder = "", std::span<const Override> overrides = {});

}  // namespace hiac

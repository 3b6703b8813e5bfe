#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hiac/scene/annotation.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// The points of a transfer function whose range is left to its field's values: a specification
/// alone does not know them, only the mesh does (with_field_ranges in session.hpp).
template <std::size_t N>
struct UnscaledPoints {
  std::vector<typename PiecewiseLinear<N>::Point> points;  ///< scalars from 0 to 1
  /// Percentiles of the field's values, low < high; {0, 100} spans all values.
  std::array<double, 2> percents{0, 100};
  bool logarithmic = false;  ///< 0 to 1 is even in the scalar's logarithm
  double tolerance = 1e-4;   ///< of piecewise-linear functions in place of logarithmic ones
};

/// A specification as read, with notes for the user.
struct ParsedScene {
  Scene scene;
  /// The points of scene.volume.color, scene.volume.extinction and scene.skin->color_by, which have
  /// none as long as they are here.
  std::optional<UnscaledPoints<3>> color = {};
  std::optional<UnscaledPoints<1>> extinction = {};
  std::optional<UnscaledPoints<3>> skin_color = {};
  /// One line each: the error bound of a preset's conversion to piecewise-linear RGB.
  std::vector<std::string> notes = {};
  Annotation annotation = {};  ///< what is drawn on the picture
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

enum class Comments : bool { none, explain };

/// Returns the specification as TOML text: complete and self-contained (colour maps as points),
/// with numbers exact to the last bit, so that parsing it gives an equal scene. With
/// `Comments::explain`, a short comment explains every key.
std::string to_toml(const Scene& scene, Comments comments = Comments::none);

/// The same with an annotation, whose table is left out if it has the defaults alone.
std::string to_toml(const Scene& scene, const Annotation& annotation,
                    Comments comments = Comments::none);

}  // namespace hiac

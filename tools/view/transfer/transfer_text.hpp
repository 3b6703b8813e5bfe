#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hiac/scene/scene.hpp"

namespace hiac::view {

/// Edits of [volume.color], [volume.extinction] and [[isosurface]] in the text of a specification.
/// Each returns the new text (edited_text.hpp: comments and everything else stay), and throws what
/// the edits there throw. `scene`: what the text says, with its transfer functions on their fields'
/// scalars.

/// Whether the points of a transfer function stand in the text as the scene has them: without
/// preset, range, scale or encoding.
template <std::size_t N>
bool has_plain_points(const std::string& text);

/// The text with the scene's own points, which change nothing of the picture.
template <std::size_t N>
std::string with_plain_points(std::string text, const Scene& scene);

/// Points become plain first. A new point comes behind those of the same scalar.
template <std::size_t N>
std::string with_point(const std::string& text, const Scene& scene, std::size_t index,
                       const typename PiecewiseLinear<N>::Point& point);
template <std::size_t N>
std::string with_new_point(const std::string& text, const Scene& scene,
                           const typename PiecewiseLinear<N>::Point& point);
/// There are at least two.
template <std::size_t N>
std::string without_point(const std::string& text, const Scene& scene, std::size_t index);

/// The function of another field: what spans the old field's values spans the new one's, which are
/// `extent`. A range that is left to the values (`auto`) stays so.
template <std::size_t N>
std::string with_field(const std::string& text, const Scene& scene, const std::string& field,
                       const std::array<double, 2>& extent);

/// Every extinction times a factor that is not negative; exactly the number 0 stays 0.
std::string with_density(const std::string& text, double factor);

/// A peak of the extinction at a value: three points, `width` to either side where the function
/// stays as it is. It is `peak` high, or as high as the function is there.
std::string with_bump(const std::string& text, const Scene& scene, double value, double width,
                      double peak);
/// How high a bump is that is well seen among these points: five times their median, but as high as
/// the highest at least; `otherwise` if all are 0.
double bump_peak(std::vector<ExtinctionTransfer::Point> points, double otherwise);

/// A built-in colour map instead of what the colour was, over the same scalars; `extent` if there
/// is no colour yet, whose field is then `field`.
std::string with_preset(const std::string& text, const Scene& scene, const std::string& preset,
                        const std::string& field, const std::array<double, 2>& extent);
/// The name of the colour map in the text; empty if it has points.
std::string preset_of(const std::string& text);
/// The scalars that a colour map spans.
std::string with_color_range(const std::string& text, const std::array<double, 2>& range);

std::string with_surface(const std::string& text, const Scene& scene, const Isosurface& surface);
std::string without_surface(const std::string& text, std::size_t index);
std::string with_surface_value(const std::string& text, std::size_t index, double value);
std::string with_surface_color(const std::string& text, std::size_t index, const Color& color);
std::string with_surface_opacity(const std::string& text, std::size_t index, double opacity);

}  // namespace hiac::view

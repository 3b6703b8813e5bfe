#pragma once

#include <functional>

#include "hiac/render/engine.hpp"

namespace hiac {

/// Throws UsageError when there are no samples, or so many that the picture of them all, with its
/// margin (below), would be wider or higher than kMaxImageSide.
void require_possible(const Supersampling& sampling, ImageSize size);

/// The image convolved with the filter, as the sum over the samples has it: the truth that
/// splatting approximates, and that edges and cells smaller than pixels are judged by.
///
/// Samples are pixels of a picture so many times as large of the same view. With the B-spline that
/// picture has a pixel's margin on all sides, so that a pixel at the border is made of what the
/// camera sees beyond it, and the weights of every pixel sum to one. All channels are filtered as
/// they are, premultiplied and without background; the background's colour at the pixel is
/// composited behind afterwards. The samples are rendered in bands of about as many as the part has
/// pixels: memory is proportional to the picture. A part of a picture has the pixels of the whole
/// one, and no number of threads changes them, bit for bit.
///
/// Further channels: "depth" and "mean_depth" are means over the samples that see something, the
/// second weighted by their opacity as well, and infinite where none does; all others are means.
/// So "error" bounds how far the picture is from the same sum over exact samples.
///
/// Throws UsageError as require_possible, require_inside and PartRenderer do. Statistics are those
/// of the samples.
RenderResult render_supersampled(const ZooMesh& mesh, const VisibilityOrder& order,
                                 const Scene& scene, const PixelRect& part,
                                 const Supersampling& sampling, bool with_background,
                                 Progress* progress = nullptr,
                                 std::span<const Channel> channels = {},
                                 const TileCrew* crew = nullptr);

/// Renders a part of the picture of all samples, without background.
using RenderSamples = std::function<RenderResult(const PixelRect& part)>;

/// The same with another engine: `engine_for` makes it for the scene of the samples, which outlives
/// it.
RenderResult supersampled(const Scene& scene, const PixelRect& part, const Supersampling& sampling,
                          bool with_background, Progress* progress,
                          std::span<const Channel> channels,
                          const std::function<RenderSamples(const Scene& samples)>& engine_for);

}  // namespace hiac

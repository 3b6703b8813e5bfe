#pragma once

#include <memory>

#include "tools/common/render/movie.hpp"
#include "tools/common/render/render_options.hpp"

namespace hiac::tools {

/// Throws UsageError for what does not fit a run of several pictures, or a film; Error where a film
/// is wanted and ffmpeg is missing.
void check_several(const RenderOptions& options);

/// Whether the pictures store whole numbers: those of a film, or of a format that does.
bool has_integer_pictures(const RenderOptions& options);

/// The film that the pictures go into; null where each goes into a file of its own, or another
/// process writes.
std::unique_ptr<Movie> movie_of(const RenderOptions& options);

}  // namespace hiac::tools

#include "tools/common/render/several_pictures.hpp"

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "tools/common/picture/frames.hpp"
#include "tools/common/picture/picture_output.hpp"

namespace hiac::tools {

void check_several(const RenderOptions& options) {
  const bool movie = is_movie(options.output);
  if (options.has_steps && options.output == "-")
    throw UsageError("--steps: a picture a step does not fit stdout (-o FILE expected)");
  if (options.has_steps && !movie) frame_path(options.output, 0);
  if (options.rate && !movie) throw UsageError("--fps: only for a film (-o FILE.mp4 expected)");
  if (!movie) return;
  if (!options.makes_several())
    throw UsageError(
        fmt::format("-o {}: a film is of several pictures (--steps or --frames "
                    "expected)",
                    options.output));
  if (!options.format.empty()) throw UsageError("--format: not for a film (-o FILE.mp4)");
  if (options.depth != 0 && options.depth != 8)
    throw UsageError(fmt::format("--depth {}: a film has 8 bits per sample", options.depth));
  require_ffmpeg(options.output);
}

bool has_integer_pictures(const RenderOptions& options) {
  return is_movie(options.output) || has_integer_samples(picture_format(options), options.depth);
}

std::unique_ptr<Movie> movie_of(const RenderOptions& options) {
  constexpr double kUsualRate = 25;
  if (!is_movie(options.output) || !options.role->writes) return nullptr;
  return std::make_unique<Movie>(options.output, options.rate.value_or(kUsualRate), options.linear);
}

}  // namespace hiac::tools

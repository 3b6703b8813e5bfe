#include "hiac/render/supersampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/frame/background.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/render/quadratic_bspline.hpp"
#include "hiac/scene/camera_motion.hpp"

namespace hiac {
namespace {

std::uint32_t margin_of(SampleFilter filter) { return filter == SampleFilter::bspline ? 1 : 0; }

// The scene whose pixels are the samples.
Scene scene_of_samples(const Scene& scene, const Supersampling& sampling) {
  const std::uint32_t margin = margin_of(sampling.filter);
  Scene result = scene;
  result.image = {(scene.image.width + 2 * margin) * sampling.samples,
                  (scene.image.height + 2 * margin) * sampling.samples};
  for (double& s : result.camera.shift) s *= sampling.samples;
  if (result.edges) result.edges->width *= sampling.samples;
  if (margin == 0) return result;
  result.camera = widened(result.camera, (scene.image.height + 2.0 * margin) / scene.image.height);
  return result;
}

// The filter in one direction. A pixel is made of 1 + 2 margin times `samples` samples in a row,
// the first of which is number pixel * samples, counted from the margin's first.
std::vector<double> filter_weights(const Supersampling& sampling) {
  const std::uint32_t margin = margin_of(sampling.filter);
  std::vector<double> weights((1 + std::size_t{2} * margin) * sampling.samples, 1.0);
  if (sampling.filter == SampleFilter::bspline)
    for (std::size_t k = 0; k < weights.size(); ++k)
      weights[k] = quadratic_bspline((static_cast<double>(k) + 0.5) / sampling.samples - 1.5);
  return weights;
}

// The weight of a sample in a channel that is infinite in some samples.
double share_of(Channel channel, std::span<const double> sample) {
  return channel == Channel::mean_depth ? sample[3] : 1;
}

bool is_depth(Channel channel) {
  return channel == Channel::depth || channel == Channel::mean_depth;
}

std::vector<std::string> sum_channels(std::span<const Channel> channels) {
  std::vector<std::string> names = image_channels(channels);
  for (const Channel channel : channels)
    if (is_depth(channel)) names.push_back(std::string(channel_name(channel)) + " weight");
  return names;
}

// Samples as they are summed up: depths times what they count, and that behind all channels.
Image weighted(const Image& samples, std::span<const Channel> channels) {
  if (std::ranges::none_of(channels, is_depth)) return samples;
  Image result(samples.width(), samples.height(), sum_channels(channels));
  for (std::size_t y = 0; y < samples.height(); ++y)
    for (std::size_t x = 0; x < samples.width(); ++x) {
      const auto from = samples.pixel(x, y);
      const auto to = result.pixel(x, y);
      std::ranges::copy(from, to.begin());
      std::size_t weight = from.size();
      for (std::size_t c = 0; c < channels.size(); ++c) {
        if (!is_depth(channels[c])) continue;
        const bool seen = std::isfinite(from[4 + c]);
        const double share = seen ? share_of(channels[c], from) : 0;
        to[4 + c] = seen ? share * from[4 + c] : 0;
        to[weight++] = share;
      }
    }
  return result;
}

// Makes pixels of samples that come row by row, from the top.
class SampleSum {
 public:
  SampleSum(const PixelRect& part, const Supersampling& sampling, std::span<const Channel> channels)
      : samples_(sampling.samples),
        channels_(channels),
        weights_(filter_weights(sampling)),
        sum_(part.width, part.height, sum_channels(channels)) {}

  // `band`: rows of samples from number `first` on, counted as filter_weights does from the part's
  // first; all of their columns.
  void add(const Image& band, std::size_t first) {
    const std::size_t channels = sum_.channel_count(), width = sum_.width() * channels;
    // first along the rows, then across them
    std::vector<double> rows(band.height() * width, 0.0);
    parallel_for(band.height(), 1, [&](IndexRange range) {
      for (std::size_t y = range.begin; y < range.end; ++y)
        filter_row(band, y, std::span(rows).subspan(y * width, width));
    });
    const std::size_t end = first + band.height();
    const std::size_t pixel_end = std::min(sum_.height(), (end - 1) / samples_ + 1);
    const std::size_t before = weights_.size() / samples_ - 1;
    const std::size_t pixel_begin = first / samples_ - std::min(first / samples_, before);
    if (pixel_begin >= pixel_end) return;
    parallel_for(pixel_end - pixel_begin, 1, [&](IndexRange range) {
      const std::size_t y = pixel_begin + range.begin;
      const std::size_t row_begin = std::max(first, y * samples_);
      const std::size_t row_end = std::min(end, y * samples_ + weights_.size());
      for (std::size_t row = row_begin; row < row_end; ++row)
        add_row(weights_[row - y * samples_], std::span(rows).subspan((row - first) * width, width),
                sum_.values().subspan(y * width, width));
    });
  }

  // The mean, once all samples are there.
  [[nodiscard]] Image take() {
    const double count = static_cast<double>(samples_) * static_cast<double>(samples_);
    for (double& value : sum_.values()) value /= count;
    return channels_.empty() ? std::move(sum_) : with_channels();
  }

 private:
  [[nodiscard]] Image with_channels() const {
    Image result(sum_.width(), sum_.height(), image_channels(channels_));
    for (std::size_t y = 0; y < sum_.height(); ++y)
      for (std::size_t x = 0; x < sum_.width(); ++x) {
        const auto from = sum_.pixel(x, y);
        const auto to = result.pixel(x, y);
        std::copy_n(from.begin(), to.size(), to.begin());
        std::size_t weight = to.size();
        for (std::size_t c = 0; c < channels_.size(); ++c) {
          if (!is_depth(channels_[c])) continue;
          const double share = from[weight++];
          to[4 + c] = share > 0 ? to[4 + c] / share : std::numeric_limits<double>::infinity();
        }
      }
    return result;
  }

  void filter_row(const Image& band, std::size_t y, std::span<double> row) const {
    const std::size_t channels = sum_.channel_count();
    for (std::size_t x = 0; x < sum_.width(); ++x)
      for (std::size_t k = 0; k < weights_.size(); ++k)
        add_row(weights_[k], band.pixel(x * samples_ + k, y), row.subspan(x * channels, channels));
  }

  static void add_row(double weight, std::span<const double> values, std::span<double> sum) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * values[i];
  }

  std::size_t samples_;
  std::span<const Channel> channels_;
  std::vector<double> weights_;
  Image sum_;
};

// Adds the rounding error of the sums to the channel `error`.
void add_rounding(const Supersampling& sampling, Image& image) {
  const auto error = image.channel_index(channel_name(Channel::error));
  if (!error) return;
  const double operations = 6.0 * sampling.samples + 8;
  for (std::size_t y = 0; y < image.height(); ++y)
    for (std::size_t x = 0; x < image.width(); ++x) {
      const auto pixel = image.pixel(x, y);
      const double largest = *std::max_element(pixel.begin(), pixel.begin() + 4);
      pixel[*error] += operations * std::numeric_limits<double>::epsilon() * (1 + largest);
    }
}

// How many rows of samples are made at a time: rows of whole tiles, so that none is made twice.
std::size_t rows_of_band(const PixelRect& part, std::size_t columns) {
  const std::size_t pixels = std::size_t{part.width} * part.height;
  return std::max<std::size_t>(1, pixels / (columns * kTileHeight)) * kTileHeight;
}

// Composites the background; an error of A changes the visible share of it.
void put_background_behind(const Scene& scene, const PixelRect& part, Image& image) {
  const auto error = image.channel_index(channel_name(Channel::error));
  for (std::uint32_t y = 0; y < part.height; ++y)
    for (std::uint32_t x = 0; x < part.width; ++x) {
      const Color behind = background_at(scene.background, scene.image, part.x + x, part.y + y);
      const auto pixel = image.pixel(x, y);
      for (std::size_t c = 0; c < 3; ++c) pixel[c] += (1 - pixel[3]) * behind[c];
      if (error) pixel[*error] *= 1 + std::ranges::max(behind);
    }
}

}  // namespace

void require_possible(const Supersampling& sampling, ImageSize size) {
  const std::uint64_t most =
      std::uint64_t{std::max(size.width, size.height)} + 2 * margin_of(sampling.filter);
  if (sampling.samples > 0 && most * sampling.samples <= kMaxImageSide) return;
  throw UsageError(
      fmt::format("samples: expected N x N a pixel, N from 1 to {} for a picture of {} "
                  "x {} (found {})",
                  kMaxImageSide / most, size.width, size.height, sampling.samples));
}

RenderResult supersampled(const Scene& scene, const PixelRect& part, const Supersampling& sampling,
                          bool with_background, Progress* progress,
                          std::span<const Channel> channels,
                          const std::function<RenderSamples(const Scene& samples)>& engine_for) {
  require_inside(part, scene.image);
  require_possible(sampling, scene.image);
  const Scene samples = scene_of_samples(scene, sampling);
  const std::uint32_t beside = 2 * margin_of(sampling.filter), n = sampling.samples;
  // of the part, in the picture of samples
  const std::uint32_t left = part.x * n, top = part.y * n;
  const std::uint32_t columns = (part.width + beside) * n, rows = (part.height + beside) * n;
  const RenderSamples render_samples = engine_for(samples);
  SampleSum sum(part, sampling, channels);
  RenderResult result;
  const std::size_t band = rows_of_band(part, columns);
  if (progress != nullptr) progress->begin("rows of samples", rows);
  for (std::uint32_t y = top; y < top + rows;) {
    const auto next = static_cast<std::uint32_t>((y / band + 1) * band);
    const std::uint32_t end = std::min(next, top + rows);
    const RenderResult some = render_samples({left, y, columns, end - y});
    sum.add(weighted(some.image, channels), y - top);
    result.statistics += some.statistics;
    if (progress != nullptr) progress->advance(end - y);
    y = end;
  }
  result.image = sum.take();
  add_rounding(sampling, result.image);
  if (with_background) put_background_behind(scene, part, result.image);
  return result;
}

RenderResult render_supersampled(const ZooMesh& mesh, const VisibilityOrder& order,
                                 const Scene& scene, const PixelRect& part,
                                 const Supersampling& sampling, bool with_background,
                                 Progress* progress, std::span<const Channel> channels,
                                 const TileCrew* crew) {
  double prepare_seconds = 0;
  RenderResult result = supersampled(
      scene, part, sampling, with_background, progress, channels,
      [&](const Scene& samples) -> RenderSamples {
        const auto renderer =
            std::make_shared<const PartRenderer>(mesh, order, samples, channels, crew);
        prepare_seconds = renderer->prepare_seconds();
        return [renderer](const PixelRect& some) { return renderer->render(some, false); };
      });
  result.statistics.prepare_seconds += prepare_seconds;
  return result;
}

}  // namespace hiac

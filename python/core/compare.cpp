#include "python/core/compare.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include "hiac/base/error.hpp"
#include "hiac/image/difference.hpp"
#include "hiac/image/flip.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/image/ssim.hpp"
#include "python/core/arrays.hpp"

namespace hiac::python {
namespace {

using Channels = std::vector<std::string>;
using Values = Contiguous<double>;

Image image_of(const Values& values, const Channels& channels) {
  const auto length = [&](py::ssize_t k) { return static_cast<std::size_t>(values.shape(k)); };
  const double* begin = values.data();
  return {length(1), length(0), channels, std::vector<double>(begin, begin + values.size())};
}

py::array values_of(Image image) {
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(image.height()),
                                       static_cast<py::ssize_t>(image.width()),
                                       static_cast<py::ssize_t>(image.channel_count())};
  auto* kept = new Image(std::move(image));
  const py::capsule owner(kept, [](void* image_kept) { delete static_cast<Image*>(image_kept); });
  return read_only(std::as_const(*kept).values().data(), shape, owner);
}

void require_comparable(const Image& image, const Image& reference) {
  if (image.width() != reference.width() || image.height() != reference.height())
    throw JudgementError(
        fmt::format("images of different sizes ({} x {} pixels expected, {} x {} found)",
                    reference.width(), reference.height(), image.width(), image.height()));
}

struct Metrics {
  std::vector<Difference> channels;
  std::optional<double> psnr, ssim;
  std::optional<Image> flip;
  Image differences;
};

Metrics metrics_of(const Image& image, const Image& reference) {
  Metrics metrics;
  metrics.channels = channel_differences(image, reference);
  if (metrics.channels.empty())
    throw JudgementError(fmt::format("no channel in common ({} expected, {} found)",
                                     fmt::join(reference.channels(), " "),
                                     fmt::join(image.channels(), " ")));
  metrics.psnr = peak_signal_to_noise(image, reference);
  metrics.ssim = structural_similarity(image, reference);
  metrics.flip = flip_map(image, reference);
  metrics.differences = difference_map(image, reference);
  return metrics;
}

py::dict compare(const Values& values, const Channels& channels, const Values& reference_values,
                 const Channels& reference_channels) {
  using py::literals::operator""_a;
  const Image image = image_of(values, channels);
  const Image reference = image_of(reference_values, reference_channels);
  Metrics metrics;
  {
    const py::gil_scoped_release released;
    require_comparable(image, reference);
    metrics = metrics_of(image, reference);
  }
  py::list differences;
  for (const Difference& d : metrics.channels)
    differences.append(
        py::dict("channel"_a = d.channel, "rmse"_a = d.rmse, "relative_mse"_a = d.relative_mse,
                 "mean_error"_a = d.mean_absolute, "largest_error"_a = d.largest,
                 "largest_at"_a = py::make_tuple(d.x, d.y), "infinite"_a = d.infinite));
  py::object flip = py::none();
  if (metrics.flip) flip = values_of(std::move(*metrics.flip));
  return py::dict("channels"_a = differences, "psnr"_a = metrics.psnr, "ssim"_a = metrics.ssim,
                  "flip"_a = flip, "differences"_a = values_of(std::move(metrics.differences)));
}

py::tuple read_picture(const std::string& path, std::size_t width) {
  ImageFile file;
  {
    const py::gil_scoped_release released;
    file = read_image(path, {.width = width});
  }
  const auto names = file.image.channels();
  Channels channels(names.begin(), names.end());
  return py::make_tuple(values_of(std::move(file.image)), channels, file.attributes);
}

}  // namespace

void bind_compare(py::module_& module) {
  module.def("compare", &compare, py::arg("values"), py::arg("channels"),
             py::arg("reference_values"), py::arg("reference_channels"));
  module.def("read_picture", &read_picture, py::arg("path"), py::arg("width"));
}

}  // namespace hiac::python

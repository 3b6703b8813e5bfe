#include "python/core/picture.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "hiac/annotate/annotate.hpp"
#include "hiac/image/display_bytes.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/session/ordering.hpp"
#include "python/core/arrays.hpp"
#include "python/core/saving.hpp"

namespace hiac::python {
namespace {

void draw_annotation(const DrawnPicture& drawn, Image& image) {
  Annotator(drawn.annotation, drawn.scene, drawn.facts).draw(image, drawn.part, drawn.background);
}

// Throws where a file that the picture is written to is one of another kind.
void require_replaceable(const Image& image, const std::string& path, int depth) {
  require_known_image_extension(path, depth);
  const std::vector<std::string> colors = rgba_channels();
  std::vector<std::string> further;
  std::ranges::copy_if(image.channels(), std::back_inserter(further), [&](const std::string& name) {
    return std::ranges::find(colors, name) == colors.end();
  });
  for (const std::string& file : files_of_image(path, further))
    require_same_kind(file, tools::FileKind::image);
}

void save(const DrawnPicture& drawn, const std::string& path, bool linear, int depth) {
  require_replaceable(drawn.picture.image, path, depth);
  const WriteOptions options{
      .linear = linear,
      .background_included = drawn.background,
      .attributes = {{"Software", "hiac " HIAC_VERSION " (Python)"},
                     {"hiac:mesh", drawn.picture.mesh_hash},
                     {"hiac:specification", to_toml(drawn.scene, drawn.annotation)}},
      .depth = depth};
  const bool annotates = drawn.annotation.draws() && !drawn.annotation.in_float_formats &&
                         has_integer_samples(path, depth);
  if (!annotates) return write_image(path, drawn.picture.image, options);
  Image annotated = drawn.picture.image;
  draw_annotation(drawn, annotated);
  write_image(path, annotated, options);
}

py::array values_of(const py::object& self) {
  const Image& image = self.cast<const DrawnPicture&>().picture.image;
  const auto length = [](std::size_t n) { return static_cast<py::ssize_t>(n); };
  return read_only(image.values().data(),
                   {length(image.height()), length(image.width()), length(image.channel_count())},
                   self);
}

py::array_t<std::uint8_t> bytes_of(const DrawnPicture& drawn) {
  const Image& image = drawn.picture.image;
  const std::vector<std::uint8_t> bytes = display_bytes(image);
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(image.height()),
                                       static_cast<py::ssize_t>(image.width()), 3};
  return py::array_t<std::uint8_t>(shape, bytes.data());
}

}  // namespace

void annotate_numbers(DrawnPicture& drawn) {
  if (drawn.annotation.draws() && drawn.annotation.in_float_formats)
    draw_annotation(drawn, drawn.picture.image);
}

void bind_picture(py::module_& module) {
  py::class_<DrawnPicture, std::shared_ptr<DrawnPicture>>(module, "Picture")
      .def_property_readonly("values", &values_of)
      .def_property_readonly("channels",
                             [](const DrawnPicture& drawn) {
                               const auto names = drawn.picture.image.channels();
                               return std::vector<std::string>(names.begin(), names.end());
                             })
      .def("display_bytes", &bytes_of)
      .def_readonly("warnings", &DrawnPicture::warnings)
      .def_property_readonly("segments", [](const DrawnPicture& d) { return d.picture.segments; })
      .def_property_readonly("violations",
                             [](const DrawnPicture& d) { return d.picture.violations; })
      .def_property_readonly("covered_pixels",
                             [](const DrawnPicture& d) { return d.picture.covered_pixels; })
      .def_property_readonly("mean_optical_depth",
                             [](const DrawnPicture& d) { return d.picture.mean_optical_depth; })
      .def_property_readonly("largest_optical_depth",
                             [](const DrawnPicture& d) { return d.picture.largest_optical_depth; })
      .def_property_readonly("mesh_hash", [](const DrawnPicture& d) { return d.picture.mesh_hash; })
      .def_property_readonly("specification",
                             [](const DrawnPicture& d) { return to_toml(d.scene, d.annotation); })
      .def("save", &save, py::arg("path"), py::arg("linear"), py::arg("depth"),
           py::call_guard<py::gil_scoped_release>());
}

}  // namespace hiac::python

#include "python/core/scene.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "hiac/scene/camera_path.hpp"
#include "hiac/scene/paraview/paraview_view.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/session/starter_view.hpp"
#include "python/core/mesh.hpp"

namespace hiac::python {
namespace {

using Size = std::optional<std::array<std::uint32_t, 2>>;

std::pair<std::string, std::vector<std::string>> starter(
    std::shared_ptr<MeshHandle> mesh, const std::string& field, const std::string& preset,
    std::uint32_t isovalues, bool dark, const Size& size, const py::object& progress,
    std::shared_ptr<const Cancellation> cancel) {
  StarterOptions options;
  options.field = field;
  options.preset = preset;
  options.isovalues = isovalues;
  options.dark = dark;
  if (size) options.size = ImageSize{(*size)[0], (*size)[1]};
  StarterView view = result_of({progress, std::move(cancel)}, [mesh, options](Watch&) {
    return make_starter_view(mesh->mesh(), "mesh", options);
  });
  return {std::move(view.text), std::move(view.notes)};
}

py::dict paraview_state(const std::string& name) {
  using py::literals::operator""_a;
  const ParaviewView view = view_from_state(name);
  return py::dict("text"_a = view.text, "notes"_a = view.notes, "omitted"_a = view.omitted,
                  "data_file"_a = view.data_file);
}

}  // namespace

void bind_scene(py::module_& module) {
  py::class_<ParsedScene>(module, "ParsedScene")
      .def_readonly("notes", &ParsedScene::notes)
      .def_property_readonly("size",
                             [](const ParsedScene& parsed) {
                               const ImageSize& size = parsed.scene.image;
                               return std::pair(size.width, size.height);
                             })
      .def_property_readonly("frames", [](const ParsedScene& p) { return frame_count(p.scene); });
  module.def(
      "parse_scene",
      [](const std::string& text, const std::string& subject, const std::string& folder,
         const std::vector<Override>& overrides) {
        return parse_scene(text, subject, folder, overrides);
      },
      py::arg("text"), py::arg("subject"), py::arg("folder"), py::arg("overrides"));
  module.def("view_from_state", &paraview_state, py::arg("name"));
  module.def("starter_view", &starter, py::arg("mesh"), py::arg("field"), py::arg("preset"),
             py::arg("isovalues"), py::arg("dark"), py::arg("size"), py::arg("progress"),
             py::arg("cancel"));
}

}  // namespace hiac::python

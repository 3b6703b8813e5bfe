#include "python/core/order.hpp"

#include <algorithm>
#include <utility>

#include <pybind11/stl.h>

#include "hiac/order/order_file.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/session/frames.hpp"
#include "hiac/session/ordering.hpp"
#include "python/core/arrays.hpp"
#include "python/core/mesh.hpp"
#include "python/core/saving.hpp"

namespace hiac::python {
namespace {

using Handle = std::shared_ptr<OrderHandle>;

Handle sort(std::shared_ptr<MeshHandle> mesh, const ParsedScene& parsed,
            const std::string& algorithm, bool overlap, const py::object& progress,
            std::shared_ptr<const Cancellation> cancel) {
  const OrderMethod method{parse_algorithm(algorithm, "algorithm"), {}};
  const Scene& given = parsed.scene;
  return result_of({progress, std::move(cancel)}, [mesh, scene = given, method, overlap](Watch& w) {
    Ordering ordering(mesh->mesh(), {&w.progress, &w.cancellation});
    if (overlap) ordering.look_for_overlaps(scene.render.planarity);
    auto made = std::make_shared<OrderHandle>();
    made->subject = "order";
    for (std::uint32_t frame = 0; frame < frame_count(scene); ++frame) {
      const MeshOrder order = ordering.made_by(method, scene_of_frame(scene, frame));
      made->chunks.push_back(encode_order(order.record));
    }
    return made;
  });
}

void save(const OrderHandle& order, const std::string& path) {
  require_same_kind(path, tools::FileKind::order);
  write_extra_chunks(path, order.chunks);
}

Handle load(const std::string& path) {
  return std::make_shared<OrderHandle>(OrderHandle{path, read_order_chunks(path)});
}

VisibilityOrder order_at(const OrderHandle& order, std::size_t frame) {
  return decode_order(order.chunks.at(frame), order.subject).order;
}

}  // namespace

void bind_order(py::module_& module) {
  py::class_<OrderHandle, Handle>(module, "Order")
      .def(
          "cells",
          [](const OrderHandle& order, std::size_t frame) {
            const SharedArray<CellId> cells = order_at(order, frame).cells;
            return view<std::uint32_t>(cells, {static_cast<py::ssize_t>(cells.size())});
          },
          py::arg("frame"))
      .def(
          "groups",
          [](const OrderHandle& order, std::size_t frame) {
            std::vector<std::pair<std::uint32_t, std::uint32_t>> groups;
            for (const CellGroup& group : order_at(order, frame).groups)
              groups.emplace_back(group.first, group.count);
            return groups;
          },
          py::arg("frame"))
      .def_property_readonly("frames", [](const OrderHandle& order) { return order.chunks.size(); })
      .def_property_readonly(
          "algorithm",
          [](const OrderHandle& order) {
            return decode_order_head(order.chunks.front(), order.subject).algorithm;
          })
      .def("save", &save, py::arg("path"), py::call_guard<py::gil_scoped_release>());
  module.def("sort", &sort, py::arg("mesh"), py::arg("scene"), py::arg("algorithm"),
             py::arg("overlap"), py::arg("progress"), py::arg("cancel"));
  module.def("load_order", &load, py::arg("path"), py::call_guard<py::gil_scoped_release>());
}

}  // namespace hiac::python

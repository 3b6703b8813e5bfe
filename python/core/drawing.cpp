#include "python/core/drawing.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/session/frames.hpp"
#include "hiac/session/ordering.hpp"
#include "hiac/session/session.hpp"
#include "hiac/session/visibility.hpp"
#include "python/core/mesh.hpp"
#include "python/core/order.hpp"
#include "python/core/picture.hpp"
#include "python/core/pixel.hpp"

namespace hiac::python {
namespace {

/// What is asked of a drawing, besides the scene.
struct DrawingOptions {
  std::vector<std::string> channels;
  std::uint32_t samples = 1;
  bool bspline = false;
  std::optional<std::array<std::uint32_t, 4>> crop;
  bool background = true;
  std::uint32_t frame = 0;
  std::shared_ptr<const OrderHandle> order;  // null: made
  bool skip_invalid = false, overlap = false;

  /// Whether the session is in a state in which no other drawing may use it.
  [[nodiscard]] bool changes_session() const { return order || skip_invalid || overlap; }

  [[nodiscard]] PictureRequest request() const {
    PictureRequest request;
    request.channels = channels;
    request.background = background;
    if (crop) request.part = PixelRect{(*crop)[0], (*crop)[1], (*crop)[2], (*crop)[3]};
    if (samples != 1)
      request.sampling =
          Supersampling{samples, bspline ? SampleFilter::bspline : SampleFilter::box};
    return request;
  }
};

/// The scene of one frame, with the ranges of its fields.
ParsedScene resolved(const ParsedScene& parsed, const MeshHandle& mesh, std::uint32_t frame) {
  frames_of(parsed.scene, frame > 0 ? std::optional(frame) : std::nullopt);
  ParsedScene scaled = with_field_ranges(parsed, mesh.mesh());
  scaled.scene = scene_of_frame(scaled.scene, frame);
  return scaled;
}

/// Calls `work` with a session that is ready for the scene.
template <typename Work>
void with_session(Drawer& drawer, const Scene& scene, const DrawingOptions& options,
                  const Work& work) {
  if (options.overlap) drawer.session.look_for_overlaps(scene.render.planarity);
  if (options.order) drawer.session.use_orders(options.order->subject, options.order->chunks);
  if (options.skip_invalid)
    drawer.session.skip_invalid_cells(scene);
  else
    drawer.require_drawable(scene);
  drawer.session.require_order(scene);
  work(drawer.session);
}

/// Runs `work` with a drawer of the mesh, watched (run_watched). The drawer is kept for the next
/// picture, however the work ends.
template <typename Work>
void draw_watched(const std::shared_ptr<MeshHandle>& mesh, const DrawingOptions& options,
                  const Listener& listener, Work work) {
  const bool keeps = !options.changes_session();
  const std::shared_ptr<Drawer> drawer =
      keeps ? mesh->take_drawer() : std::make_shared<Drawer>(mesh->mesh());
  run_watched(drawer->watch, listener, [mesh, drawer, keeps, work = std::move(work)] {
    try {
      work(*drawer);
    } catch (...) {
      if (keeps) mesh->keep(drawer);
      throw;
    }
    if (keeps) mesh->keep(drawer);
  });
}

/// Draws one picture.
void draw(Drawer& drawer, const MeshHandle& mesh, const ParsedScene& parsed,
          const DrawingOptions& options, DrawnPicture& drawn) {
  const PictureRequest request = options.request();
  drawn.part = require_possible(request, parsed.scene.image);
  const ParsedScene view = resolved(parsed, mesh, options.frame);
  drawn.scene = view.scene;
  drawn.annotation = view.annotation;
  drawn.background = options.background;
  with_session(drawer, view.scene, options, [&](Session& session) {
    drawn.warnings = invisible_parts(mesh.mesh(), view.scene);
    drawn.picture = session.picture(view.scene, request);
  });
  require_numbers(drawn.picture.image);
  const Picture& picture = drawn.picture;
  if (const auto reason = reason_of_empty(
          mesh.mesh(), view.scene,
          {picture.covered_pixels, picture.largest_optical_depth, options.crop.has_value()}))
    drawn.warnings.push_back(*reason);
  if (view.annotation.draws()) drawn.facts = annotation_facts(mesh.mesh(), view.scene.volume);
  annotate_numbers(drawn);
}

std::shared_ptr<DrawnPicture> render(const std::shared_ptr<MeshHandle>& mesh,
                                     const ParsedScene& parsed, const DrawingOptions& options,
                                     const py::object& progress,
                                     std::shared_ptr<const Cancellation> cancel) {
  const auto drawn = std::make_shared<DrawnPicture>();
  draw_watched(mesh, options, {progress, std::move(cancel)},
               [mesh, parsed, options, drawn](Drawer& drawer) {
                 draw(drawer, *mesh, parsed, options, *drawn);
               });
  return drawn;
}

py::dict explain(const std::shared_ptr<MeshHandle>& mesh, const ParsedScene& parsed,
                 std::uint32_t x, std::uint32_t y, const DrawingOptions& options,
                 const py::object& progress, std::shared_ptr<const Cancellation> cancel) {
  struct Found {
    Explanation explanation;
    Scene scene;
  };
  const auto found = std::make_shared<Found>();
  draw_watched(mesh, options, {progress, std::move(cancel)},
               [mesh, parsed, options, x, y, found](Drawer& drawer) {
                 found->scene = resolved(parsed, *mesh, options.frame).scene;
                 with_session(drawer, found->scene, options, [&](Session& session) {
                   found->explanation = session.explain(found->scene, x, y, options.background);
                 });
               });
  return pixel_facts(*found->explanation.pixel, found->scene);
}

}  // namespace

void bind_drawing(py::module_& module) {
  py::class_<DrawingOptions>(module, "DrawingOptions")
      .def(py::init<>())
      .def_readwrite("channels", &DrawingOptions::channels)
      .def_readwrite("samples", &DrawingOptions::samples)
      .def_readwrite("bspline", &DrawingOptions::bspline)
      .def_readwrite("crop", &DrawingOptions::crop)
      .def_readwrite("background", &DrawingOptions::background)
      .def_readwrite("frame", &DrawingOptions::frame)
      .def_property(
          "order",
          [](const DrawingOptions& o) { return std::const_pointer_cast<OrderHandle>(o.order); },
          [](DrawingOptions& o, std::shared_ptr<OrderHandle> order) { o.order = std::move(order); })
      .def_readwrite("skip_invalid", &DrawingOptions::skip_invalid)
      .def_readwrite("overlap", &DrawingOptions::overlap);
  module.def("render", &render, py::arg("mesh"), py::arg("scene"), py::arg("options"),
             py::arg("progress"), py::arg("cancel"));
  module.def("explain_pixel", &explain, py::arg("mesh"), py::arg("scene"), py::arg("x"),
             py::arg("y"), py::arg("options"), py::arg("progress"), py::arg("cancel"));
}

}  // namespace hiac::python

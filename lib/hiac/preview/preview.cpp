#include "hiac/preview/preview.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "hiac/base/seconds.hpp"
#include "hiac/frame/background.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/projection.hpp"
#include "hiac/preview/drawing_order.hpp"
#include "hiac/preview/drawn_fields.hpp"
#include "hiac/preview/exact_painter.hpp"
#include "hiac/preview/float_target.hpp"
#include "hiac/preview/methods/method_painter.hpp"

namespace hiac::preview {
namespace {

// A target of this size is 256 MiB.
constexpr std::uint32_t kPartSide = 4096;

const ZooMesh& require_tetrahedra(const ZooMesh& mesh) {
  if (std::ranges::any_of(mesh.kinds, [](CellKind kind) { return kind != CellKind::tetrahedron4; }))
    throw std::invalid_argument("a preview draws linear tetrahedra alone: drawn_mesh makes them");
  return mesh;
}

void add_background(const Scene& scene, const PixelRect& rect, Image& image) {
  for (std::uint32_t y = 0; y < rect.height; ++y)
    for (std::uint32_t x = 0; x < rect.width; ++x) {
      const auto pixel = image.pixel(x, y);
      const Color behind = background_at(scene.background, scene.image, rect.x + x, rect.y + y);
      for (std::size_t c = 0; c < 3; ++c) pixel[c] += (1 - pixel[3]) * behind[c];
    }
}

}  // namespace

struct Preview::State {
  State(const Context& of_context, const ZooMesh& of_mesh, const Scene& of_scene,
        const PreviewOptions& of_options)
      : context(of_context),
        mesh(of_mesh),
        scene(of_scene),
        options(of_options),
        started(seconds_now()),
        drawn(drawn_scene(mesh, scene)) {
    if (!options.method) exact = std::make_unique<ExactPainter>(context, mesh, drawn, options.fine);
    upload_seconds = seconds_now() - started;
  }

  [[nodiscard]] std::uint32_t part_side() const {
    const std::uint32_t wanted = options.part_side > 0 ? options.part_side : kPartSide;
    if (context.limits().picture_side == 0)
      throw DriverError(context.device().name + ": draws no pictures of any size");
    return std::min(wanted, context.limits().picture_side);
  }

  const Context& context;
  const ZooMesh& mesh;
  const Scene& scene;
  PreviewOptions options;
  double started;
  DrawnScene drawn;
  std::unique_ptr<ExactPainter> exact;  // null with one of the paper's methods
  double upload_seconds = 0;
};

namespace {

// The paper's methods, for one view.
class MethodView {
 public:
  MethodView(const Context& context, const ZooMesh& mesh, const Scene& scene,
             const Projector& projector, Method method)
      : frame_(mesh, scene, projector), painter_(context, frame_, method) {}

  void draw(const PixelRect& rect, std::span<const CellId> cells, PreviewStatistics& statistics) {
    statistics.regions.add(painter_.draw(rect, cells));
    statistics.regions_seconds = painter_.region_seconds();
    statistics.triangles = painter_.triangles();
  }

 private:
  Frame frame_;
  MethodPainter painter_;
};

}  // namespace

Preview::Preview(const Context& context, const ZooMesh& mesh, const Scene& scene,
                 const PreviewOptions& options)
    : state_(std::make_unique<State>(context, require_tetrahedra(mesh), scene, options)) {}

Preview::~Preview() = default;

PreviewResult Preview::draw(const Camera& camera, const VisibilityOrder& order,
                            const std::optional<PixelRect>& part, bool with_background) {
  State& s = *state_;
  const ImageSize size = s.scene.image;
  const PixelRect whole = part.value_or(whole_picture(size));
  require_inside(whole, size);
  PreviewResult result{Image(whole.width, whole.height, rgba_channels()), {}};
  PreviewStatistics& statistics = result.statistics;
  statistics.upload_seconds = std::exchange(s.upload_seconds, 0);
  const double start = seconds_now();
  const Projector projector(camera, size);
  const std::vector<CellId> cells = back_to_front(s.mesh, order, projector);
  statistics.groups = order.groups.size();
  for (const CellGroup& group : order.groups) statistics.cells_in_groups += group.count;
  std::optional<MethodView> method;
  if (s.options.method)
    method.emplace(s.context, s.mesh, s.scene, projector, *s.options.method);
  else
    s.exact->set_view(projector);
  const std::vector<PixelRect> parts = parts_of(whole, s.part_side());
  statistics.parts = parts.size();
  FloatTarget target(s.context, std::min(whole.width, s.part_side()),
                     std::min(whole.height, s.part_side()));
  double reading = 0;
  for (const PixelRect& rect : parts) {
    target.begin(rect);
    if (method)
      method->draw(rect, cells, statistics);
    else
      s.exact->draw(rect, cells);
    glFinish();
    s.context.check("drawing");
    const double drawn = seconds_now();
    target.read(rect, whole, result.image);
    reading += seconds_now() - drawn;
  }
  statistics.draw_seconds = seconds_now() - start - reading - statistics.regions_seconds;
  statistics.read_seconds = reading;
  if (with_background) add_background(s.scene, whole, result.image);
  return result;
}

}  // namespace hiac::preview

#include "tools/view/viewport/hardware_preview.hpp"

#include <optional>
#include <utility>

#include "hiac/frame/renderable.hpp"
#include "hiac/preview/context.hpp"
#include "hiac/preview/drawn_mesh.hpp"
#include "hiac/preview/preview.hpp"
#include "hiac/session/scene_orders.hpp"

namespace hiac::view {
namespace {

constexpr unsigned kHalvings = 1;  // of curved cells' edges: enough while something moves

Scene without_camera(Scene scene) {
  scene.camera = {};
  return scene;
}

}  // namespace

struct HardwarePreview::State {
  preview::Context context;
  std::shared_ptr<const ZooMesh> mesh;  // of the last picture
  std::optional<preview::DrawnMesh> drawn;
  std::optional<SceneOrders> orders;        // of tetrahedra that are not the mesh's own
  std::optional<Scene> scene;               // of the last picture, but for its camera
  std::optional<preview::Preview> preview;  // of `drawn` and `scene`
};

HardwarePreview::HardwarePreview() : state_(std::make_unique<State>()) {}
HardwarePreview::~HardwarePreview() = default;

bool HardwarePreview::draws(const Scene& scene) {
  return !scene.skin && scene.render.splat_below <= 0;
}

const std::string& HardwarePreview::device() const { return state_->context.device().name; }

Image HardwarePreview::draw(const std::shared_ptr<const ZooMesh>& mesh, const Scene& scene,
                            Session& session) {
  State& state = *state_;
  if (state.mesh != mesh) {
    state.preview.reset();
    state.orders.reset();
    state.mesh = mesh;
    state.drawn = preview::drawn_mesh(*mesh, kHalvings);
    if (state.drawn->approximated > 0) {
      state.orders.emplace(state.drawn->mesh, Monitor{});
      state.orders->leave_out(invalid_cells(state.drawn->mesh, scene.render.planarity));
    }
  }
  Scene fixed = without_camera(scene);
  if (!state.preview || *state.scene != fixed) {
    state.preview.reset();
    state.scene = std::move(fixed);
    state.preview.emplace(state.context, state.drawn->mesh, *state.scene);
  }
  const auto draw = [&](const MeshOrder& order) {
    return state.preview->draw(scene.camera, order.record.order, std::nullopt, true).image;
  };
  return state.orders ? draw(state.orders->of(scene)) : draw(*session.order(scene));
}

}  // namespace hiac::view

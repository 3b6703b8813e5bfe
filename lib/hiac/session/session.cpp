#include "hiac/session/session.hpp"

#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/channels.hpp"
#include "hiac/frame/crop.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/frame/tiles/tile_crew.hpp"
#include "hiac/image/composite.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/mesh_hash.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/render/explain_pixel.hpp"
#include "hiac/render/supersampling.hpp"
#include "hiac/render/walk/ray_scene.hpp"
#include "hiac/render/walk/walked_picture.hpp"
#include "hiac/session/scene_orders.hpp"
#include "hiac/session/stages.hpp"

namespace hiac {
namespace {

std::vector<Channel> channels_of(const PictureRequest& request) {
  return parse_channels(fmt::format("{}", fmt::join(request.channels, ",")));
}

RenderResult draw(const ZooMesh& mesh, const VisibilityOrder& order, const Scene& scene,
                  const PictureRequest& request, const PixelRect& part, Progress* progress) {
  const std::vector<Channel> channels = channels_of(request);
  const bool background = request.background && request.under == nullptr;
  if (request.sampling)
    return render_supersampled(mesh, order, scene, part, *request.sampling, background, progress,
                               channels, request.crew);
  const PartRenderer renderer(mesh, order, scene, channels, request.crew);
  RenderResult result = renderer.render(part, background, progress);
  result.statistics.prepare_seconds += renderer.prepare_seconds();
  return result;
}

Picture picture_of(RenderResult result, std::shared_ptr<const MeshOrder> order,
                   const std::string& mesh_hash) {
  const RenderStatistics& met = result.statistics;
  return {std::move(result.image),
          met.segments,
          met.violations,
          met.covered_pixels,
          met.mean_optical_depth,
          met.largest_optical_depth,
          mesh_hash,
          std::move(order),
          std::make_shared<const RenderStatistics>(met)};
}

}  // namespace

struct Session::State {
  ZooMesh mesh;
  Monitor monitor;
  SceneOrders orders;
  std::string content, geometry;                // its hashes, once they are known
  std::shared_ptr<const MeshOrder> last_order;  // for last_view, if there is one
  std::string last_view;                        // its hash
  std::vector<CellId> left_out;                 // of all orders
  bool has_boundary = false;                    // the mesh has the adjacency that pictures need
  bool sorts_overlaps = false;                  // pairs of cells are sorted pixel by pixel
  std::optional<WalkableMesh> walkable;         // while no picture is made in an order
  std::optional<bool> is_walkable;              // once it is known
  std::optional<Edges> chosen;                  // what edges_of_mesh are, apart from their look
  MeshEdges edges_of_mesh;

  State(ZooMesh drawn, Monitor watching)
      : mesh(std::move(drawn)), monitor(std::move(watching)), orders(mesh, monitor) {}

  const std::string& content_hash_of_mesh() {
    if (content.empty()) content = content_hash(mesh);
    return content;
  }

  std::shared_ptr<const MeshOrder> order(const Scene& scene, const LoopCrew* crew) {
    std::string view = view_hash(scene);
    if (last_order && view == last_view) return last_order;
    last_order.reset();  // its memory is free while the next one is made
    last_order = std::make_shared<const MeshOrder>(orders.of(scene, crew));
    last_view = std::move(view);
    return last_order;
  }

  // Skin and edges lie on the boundary. Gives the mesh its adjacency, so that not every picture
  // computes it, and not each of the two.
  void prepare_boundary(const Scene& scene) {
    if (has_boundary || !(scene.skin || scene.edges)) return;
    const FaceAdjacency* const known = orders.adjacency();
    if (known != nullptr)
      mesh.adjacency = *known;
    else if (!mesh.adjacency)
      mesh.adjacency = build_face_adjacency(mesh);
    has_boundary = true;
  }

  const WalkableMesh* walkable_mesh() {
    if (sorts_overlaps || is_walkable == false) return nullptr;
    if (!walkable) {
      const FaceAdjacency& adjacency = orders.required_adjacency();
      if (is_walkable.has_value())
        walkable = WalkableMesh::again(mesh, adjacency);
      else
        walkable = WalkableMesh::of(mesh, adjacency);
      is_walkable = walkable.has_value();
    }
    return walkable ? &*walkable : nullptr;
  }

  // Null if the scene draws no edges.
  const MeshEdges* edges_for(const Scene& scene) {
    if (!scene.edges) return nullptr;
    prepare_boundary(scene);
    const Edges wanted{.show = scene.edges->show, .angle = scene.edges->angle};
    if (chosen != wanted) edges_of_mesh = mesh_edges(mesh, wanted);
    chosen = wanted;
    return &edges_of_mesh;
  }

  const std::string& hash_of_geometry() {
    if (geometry.empty()) geometry = geometry_hash(mesh);
    return geometry;
  }
};

Session::Session(ZooMesh mesh, Monitor monitor)
    : state_(std::make_unique<State>(std::move(mesh), std::move(monitor))) {}

Session::~Session() = default;

const ZooMesh& Session::mesh() const { return state_->mesh; }

bool Session::take_step(ZooMesh& mesh) {
  if (geometry_hash(mesh) != state_->hash_of_geometry()) return false;
  if (state_->has_boundary) mesh.adjacency = state_->mesh.adjacency;
  state_->mesh = std::move(mesh);
  state_->content.clear();
  return true;
}

void Session::require_drawable(const Scene& scene) {
  const CancellationScope scope(state_->monitor.cancellation);
  check_renderable(state_->mesh, scene);
}

std::vector<CellId> Session::skip_invalid_cells(const Scene& scene) {
  const CancellationScope scope(state_->monitor.cancellation);
  check_renderable(state_->mesh, scene, InvalidCells::skipped);
  std::vector<CellId> cells = invalid_cells(state_->mesh, scene.render.planarity);
  if (cells != state_->left_out) {
    state_->left_out = cells;
    state_->orders.leave_out(cells);
    state_->last_order.reset();
  }
  return cells;
}

void Session::look_for_overlaps(double planarity) {
  state_->orders.look_for_overlaps(planarity);
  state_->sorts_overlaps = true;
  state_->last_order.reset();
}

void Session::use_orders(std::string subject, std::vector<ExtraChunk> chunks) {
  state_->orders.use({std::move(subject), std::move(chunks)});
  state_->last_order.reset();
}

void Session::require_order(const Scene& scene) { state_->orders.require(scene); }

std::shared_ptr<const MeshOrder> Session::order(const Scene& scene) {
  return state_->order(scene, nullptr);
}

Picture Session::picture(const Scene& scene, const PictureRequest& request) {
  State& s = *state_;
  const PixelRect part = require_possible(request, scene.image);
  s.walkable.reset();  // its memory is free while the picture is made
  const std::shared_ptr<const MeshOrder> made = s.order(scene, request.crew);
  s.prepare_boundary(scene);
  RenderResult result = run_stage(s.monitor, "render", [&] {
    return draw(s.mesh, made->record.order, scene, request, part, s.monitor.progress);
  });
  if (request.under != nullptr) composite_over(result.image, *request.under);
  return picture_of(std::move(result), made, s.content_hash_of_mesh());
}

std::optional<Picture> Session::picture_by_rays(const Scene& scene, bool background) {
  State& s = *state_;
  const CancellationScope scope(s.monitor.cancellation);
  const std::uint64_t pixels = std::uint64_t{scene.image.width} * scene.image.height;
  if (!has_medium_and_edges_alone(scene) || !is_faster_walked(s.mesh.cell_count(), pixels))
    return std::nullopt;
  const WalkableMesh* const walkable = s.walkable_mesh();
  if (walkable == nullptr) return std::nullopt;
  std::optional<RenderResult> result = run_stage(s.monitor, "render", [&] {
    return walked_picture(*walkable, scene, s.edges_for(scene), background);
  });
  if (!result) return std::nullopt;
  if (result->statistics.violations > 0) {  // cells overlap, which an order treats in its own way
    s.walkable.reset();
    s.is_walkable = false;
    return std::nullopt;
  }
  return picture_of(*std::move(result), nullptr, s.content_hash_of_mesh());
}

Explanation Session::explain(const Scene& scene, std::uint32_t x, std::uint32_t y,
                             bool background) {
  const std::shared_ptr<const MeshOrder> made = order(scene);
  state_->prepare_boundary(scene);
  return {run_stage(state_->monitor, "explain",
                    [&] {
                      return std::make_shared<const PixelExplanation>(
                          explain_pixel(state_->mesh, made->record.order, scene, x, y, background));
                    }),
          made};
}

PixelRect require_possible(const PictureRequest& request, ImageSize size) {
  const PixelRect part = request.part.value_or(whole_picture(size));
  require_inside(part, size);
  if (request.sampling) require_possible(*request.sampling, size);
  channels_of(request);
  if (request.under == nullptr) return part;
  const Image& under = *request.under;
  if (under.width() != part.width || under.height() != part.height)
    throw UsageError(
        fmt::format("the picture behind is of another size ({} x {} pixels expected, "
                    "{} x {} found)",
                    part.width, part.height, under.width(), under.height()));
  if (!color_channels(under)) throw UsageError("the picture behind has no colour");
  if (const auto bad = not_finite_in(under))
    throw UsageError(fmt::format("the picture behind: {}", *bad));
  return part;
}

}  // namespace hiac

#include "tools/render-mpi/parted_pictures.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/cluster/parted_renderer.hpp"
#include "hiac/cluster/whole_ranges.hpp"
#include "hiac/frame/channels.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/geometry/box.hpp"
#include "hiac/image/composite.hpp"
#include "hiac/mesh/parted/part_file.hpp"
#include "hiac/mesh/parted/parted_index.hpp"
#include "hiac/render/runs/part_engine.hpp"
#include "hiac/render/supersampling.hpp"
#include "hiac/session/scene_orders.hpp"
#include "tools/common/picture/frames.hpp"
#include "tools/common/picture/picture_annotation.hpp"
#include "tools/common/picture/picture_output.hpp"
#include "tools/common/render/color_bar_file.hpp"
#include "tools/common/render/movie.hpp"
#include "tools/common/render/picture_behind.hpp"
#include "tools/common/render/picture_report.hpp"
#include "tools/common/render/render_files.hpp"
#include "tools/common/render/several_pictures.hpp"
#include "tools/common/render/shots.hpp"

namespace hiac::tools {
namespace {

using Json = nlohmann::ordered_json;

// A part of this process, and its orders.
struct OwnPart {
  OwnPart(std::uint32_t its_number, MeshPart its, const Monitor& monitor)
      : number(its_number), part(std::move(its)), orders(part.mesh, monitor) {}

  std::uint32_t number;
  MeshPart part;
  SceneOrders orders;
};

class PartedPictures {
 public:
  PartedPictures(Communicator& all, Tool& tool, RenderOptions& options)
      : all_(all), tool_(tool), options_(options), index_(read_parted_index(options.input)) {}

  void draw() {
    ParsedScene parsed = *specification_of(tool_, options_);
    fit_to(parsed.scene);
    read_parts();
    const ParsedScene view = with_ranges(std::move(parsed));
    const Scene& scene = view.scene;
    if (writes_color_bar(options_))
      write_color_bar(tool_, options_, parts_.front().part.mesh, diagonal(), view);
    if (options_.output.empty()) return;
    with_names(options_, [&] {
      for (const OwnPart& own : parts_) check_renderable(own.part.mesh, scene);
    });
    if (writes()) annotate(view);
    if (scene.path) {
      draw_frames(scene);
      return;
    }
    Json facts = draw_one(scene, options_.output, nullptr);
    facts.erase("seconds");
    tool_.facts().update(facts);
  }

 private:
  [[nodiscard]] bool writes() const { return all_.rank() == 0; }

  // Throws where the options do not fit the scene.
  void fit_to(const Scene& scene) {
    check_frame_options(options_, scene);
    channels_ = parse_channels(options_.picture.channels);
    require_parted_scene(scene, channels_);
    request_ = picture_request(options_.picture, scene.image);
    rect_ = require_possible(request_, scene.image);
    if (writes()) behind_ = read_picture_behind(options_.under, {rect_.width, rect_.height});
    if (options_.all_frames) claim_render_files(tool_, options_, shots_of_frames(options_, scene));
  }

  // The diagonal of the box around the whole mesh.
  [[nodiscard]] double diagonal() const {
    Box box = Box::empty();
    for (const PartInfo& part : index_.parts) box.include(Box{part.low, part.high});
    return box.diagonal();
  }

  void draw_frames(const Scene& scene) {
    const std::unique_ptr<Movie> movie = movie_of(options_);
    const std::vector<Shot> shots = shots_of_frames(options_, scene);
    tool_.frames().begin(options_.kind_of_shots(), shots.size());
    for (const Shot& shot : shots) {
      Json facts{{"frame", *shot.frame}, {"file", movie ? options_.output : shot.path}};
      facts.update(draw_one(scene_of_shot(scene, shot), shot.path, movie.get()));
      tool_.facts()["frames"].push_back(std::move(facts));
      tool_.note_frame(shot.path);
    }
    if (movie) tool_.timed("write", [&] { movie->finish(); });
  }

  void read_parts() {
    tool_.timed("read", [&] {
      for (std::size_t k = all_.rank(); k < index_.parts.size(); k += all_.size())
        parts_.emplace_back(static_cast<std::uint32_t>(k), read_mesh_part(index_, k),
                            tool_.monitor());
    });
    tool_.detail(fmt::format("{}: {} parts, {} cells and {} nodes in all", options_.input,
                             index_.parts.size(), index_.cells, index_.nodes));
  }

  // Transfer functions over the ranges of the whole mesh's fields.
  ParsedScene with_ranges(ParsedScene parsed) {
    parsed.notes.clear();  // they have been told
    std::vector<NumberedPart> own;
    for (const OwnPart& part : parts_)
      own.push_back({part.number, part.part.mesh, part.part.global_nodes.view()});
    parsed = with_names(options_, [&] { return with_whole_ranges(all_, own, std::move(parsed)); });
    for (const std::string& line : parsed.notes) tool_.note(line);
    return parsed;
  }

  void annotate(const ParsedScene& view) {
    annotation_.emplace(tool_, options_, view, parts_.front().part.mesh,
                        chosen_frames(view.scene, options_.frame), has_integer_pictures(options_));
  }

  // Makes one picture of a scene of one frame, into its file or into the film, and returns its
  // facts.
  Json draw_one(const Scene& scene, const std::string& path, Movie* movie) {
    std::deque<MeshOrder> orders;
    std::vector<DrawnPart> drawn;
    for (OwnPart& own : parts_) {
      orders.push_back(own.orders.of(scene));
      drawn.push_back(
          {own.number, own.part.mesh, own.part.global_nodes.view(), orders.back().record.order});
    }
    const bool background = !options_.no_background && options_.under.empty();
    RenderResult result = tool_.timed("render", [&] {
      if (!request_.sampling)
        return PartedRenderer(all_, drawn, scene, channels_)
            .render(rect_, background, tool_.monitor().progress);
      return supersampled(
          scene, rect_, *request_.sampling, background, tool_.monitor().progress, channels_,
          [&](const Scene& samples) -> RenderSamples {
            const auto renderer = std::make_shared<PartedRenderer>(all_, drawn, samples, channels_);
            return [renderer](const PixelRect& some) { return renderer->render(some, false); };
          });
    });
    Json facts = note_work(tool_, options_.all_frames, scene, result.statistics);
    if (options_.strict) require_truth(path, result.statistics);
    if (!writes()) return facts;
    if (behind_) composite_over(result.image, *behind_);
    require_numbers(result.image);
    annotation_->draw(result.image, scene, request_.part);
    if (movie != nullptr)
      tool_.timed("write", [&] { movie->add(result.image); });
    else
      write_picture(tool_, options_, "hiac-render", path, result.image, index_.hash, scene,
                    annotation_->wanted());
    return facts;
  }

  Communicator& all_;
  Tool& tool_;
  RenderOptions& options_;
  PartedIndex index_;
  std::vector<Channel> channels_;
  PictureRequest request_;
  PixelRect rect_;
  std::optional<Image> behind_;  // in the process that writes
  std::deque<OwnPart> parts_;
  std::optional<PictureAnnotation> annotation_;
};

}  // namespace

void draw_parted_pictures(Communicator& all, Tool& tool, RenderOptions& options) {
  PartedPictures(all, tool, options).draw();
}

}  // namespace hiac::tools

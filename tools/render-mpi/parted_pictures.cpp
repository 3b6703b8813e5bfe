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
#include "hiac/image/image_io.hpp"
#include "hiac/mesh/parted/part_file.hpp"
#include "hiac/mesh/parted/parted_index.hpp"
#include "hiac/render/runs/part_engine.hpp"
#include "hiac/render/supersampling.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/session/scene_orders.hpp"
#include "tools/common/picture/frames.hpp"
#include "tools/common/picture/picture_annotation.hpp"
#include "tools/common/picture/picture_output.hpp"
#include "tools/common/render/picture_report.hpp"

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
  PartedPictures(Communicator& all, Tool& tool, PictureCommand& command,
                 const PictureOptions& picture)
      : all_(all),
        tool_(tool),
        command_(command),
        picture_(picture),
        index_(read_parted_index(command.input)) {}

  void draw() {
    ParsedScene parsed = *specification_of(tool_, command_);
    check_frame_options(command_, parsed.scene);
    channels_ = parse_channels(picture_.channels);
    require_parted_scene(parsed.scene, channels_);
    request_ = picture_request(picture_, parsed.scene.image);
    rect_ = require_possible(request_, parsed.scene.image);
    read_parts();
    const ParsedScene view = with_ranges(std::move(parsed));
    const Scene& scene = view.scene;
    with_names(command_, [&] {
      for (const OwnPart& own : parts_) check_renderable(own.part.mesh, scene);
    });
    if (writes()) annotate(view);
    if (!scene.path) {
      Json facts = draw_one(scene, command_.output);
      facts.erase("seconds");
      tool_.facts().update(facts);
      return;
    }
    for (const std::uint32_t frame : chosen_frames(scene, command_.frame)) {
      const std::string path = path_of_frame(command_, frame);
      Json facts{{"frame", frame}, {"file", path}};
      facts.update(draw_one(scene_of_frame(scene, frame), path));
      tool_.facts()["frames"].push_back(std::move(facts));
    }
  }

 private:
  [[nodiscard]] bool writes() const { return all_.rank() == 0; }

  void read_parts() {
    tool_.timed("read", [&] {
      for (std::size_t k = all_.rank(); k < index_.parts.size(); k += all_.size())
        parts_.emplace_back(static_cast<std::uint32_t>(k), read_mesh_part(index_, k),
                            tool_.monitor());
    });
    tool_.detail(fmt::format("{}: {} parts, {} cells and {} nodes in all", command_.input,
                             index_.parts.size(), index_.cells, index_.nodes));
  }

  // Transfer functions over the ranges of the whole mesh's fields.
  ParsedScene with_ranges(ParsedScene parsed) {
    parsed.notes.clear();  // they have been told
    std::vector<NumberedPart> own;
    for (const OwnPart& part : parts_)
      own.push_back({part.number, part.part.mesh, part.part.global_nodes.view()});
    parsed = with_names(command_, [&] { return with_whole_ranges(all_, own, std::move(parsed)); });
    for (const std::string& line : parsed.notes) tool_.note(line);
    return parsed;
  }

  void annotate(const ParsedScene& view) {
    annotation_.emplace(tool_, command_, view, parts_.front().part.mesh,
                        chosen_frames(view.scene, command_.frame),
                        has_integer_samples(picture_format(command_), command_.depth));
  }

  // One picture of a scene of one frame; its facts.
  Json draw_one(const Scene& scene, const std::string& path) {
    std::deque<MeshOrder> orders;
    std::vector<DrawnPart> drawn;
    for (OwnPart& own : parts_) {
      orders.push_back(own.orders.of(scene));
      drawn.push_back(
          {own.number, own.part.mesh, own.part.global_nodes.view(), orders.back().record.order});
    }
    const bool background = !command_.no_background;
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
    Json facts = note_work(tool_, command_.all_frames, scene, result.statistics);
    if (command_.strict && result.statistics.violations > 0)
      throw JudgementError(
          fmt::format("{}: not written: {} ray segments were met out of order "
                      "(--strict)",
                      path, result.statistics.violations));
    if (!writes()) return facts;
    require_numbers(result.image);
    annotation_->draw(result.image, scene, request_.part);
    write_picture(tool_, command_, "hiac-render", path, result.image, index_.hash, scene,
                  annotation_->wanted());
    return facts;
  }

  Communicator& all_;
  Tool& tool_;
  PictureCommand& command_;
  const PictureOptions& picture_;
  PartedIndex index_;
  std::vector<Channel> channels_;
  PictureRequest request_;
  PixelRect rect_;
  std::deque<OwnPart> parts_;
  std::optional<PictureAnnotation> annotation_;
};

}  // namespace

void draw_parted_pictures(Communicator& all, Tool& tool, PictureCommand& command,
                          const PictureOptions& picture) {
  PartedPictures(all, tool, command, picture).draw();
}

}  // namespace hiac::tools

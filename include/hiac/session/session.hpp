#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hiac/base/progress.hpp"
#include "hiac/frame/crop.hpp"
#include "hiac/image/image.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

/// From a mesh and a specification to a picture: what every front end calls (a command, a window, a
/// script). How to read and write meshes, specifications and images is in zoo_container.hpp,
/// scene_parser.hpp and image_io.hpp.
namespace hiac {

struct PixelExplanation;
struct RenderStatistics;
struct MeshOrder;

/// How a front end watches work and stops it. All of it is optional.
struct Monitor {
  Progress* progress = nullptr;                ///< told of every stage, and how far the drawing is
  const Cancellation* cancellation = nullptr;  ///< requested: the work throws Cancelled
  /// Called when a stage ends, also by an exception: its name and what it took. Must not throw.
  std::function<void(const std::string& stage, double seconds)> stage_ended = {};
  /// A line for people about what was found.
  std::function<void(const std::string& line)> note = {};
};

/// What is wanted of a picture besides the specification. The default: all of it, with the
/// background, one ray a pixel, no further channels.
struct PictureRequest {
  std::optional<PixelRect> part;          ///< none: the whole picture
  std::optional<Supersampling> sampling;  ///< none: one ray through each pixel's centre
  /// Further channels, by name: "depth", "mean_depth", "transparency", "cells", "witness", "error".
  std::vector<std::string> channels;
  bool background = true;  ///< composite the specification's background behind
  /// A picture of the same size to composite behind instead; has to outlive the call.
  const Image* under = nullptr;
};

/// A picture and what was met while it was made.
struct Picture {
  Image image;  ///< "R" "G" "B" "A", premultiplied, linear; then the further channels
  std::uint64_t segments = 0;    ///< of rays, one for each cell that a ray meets
  std::uint64_t violations = 0;  ///< segments that the order had in the wrong place
  std::uint64_t covered_pixels = 0;
  double mean_optical_depth = 0, largest_optical_depth = 0;  ///< over the covered pixels
  std::string mesh_hash;                                     ///< content_hash of the mesh
  // in full, for those who know the types
  std::shared_ptr<const MeshOrder> order;
  std::shared_ptr<const RenderStatistics> statistics;
};

/// What the ray of one pixel meets (explain_pixel.hpp), and the order that it rests on.
struct Explanation {
  std::shared_ptr<const PixelExplanation> pixel;
  std::shared_ptr<const MeshOrder> order;
};

/// Draws one mesh as often as one likes. What does not depend on the view is made once. The same
/// input gives the same bits, whatever the number of threads, and whether or not work was cancelled
/// before. For one thread at a time.
class Session {
 public:
  explicit Session(ZooMesh mesh, Monitor monitor = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] const ZooMesh& mesh() const;

  /// Throws InputError when the mesh, or something in the scene, cannot be drawn, and UsageError
  /// when a field does not exist. To be called once a mesh and specification, before `picture`,
  /// which does not check them.
  void require_drawable(const Scene& scene);

  /// The same, but cells that are turned inside out in part are left out of all pictures from now
  /// on. Returns these, ascending.
  std::vector<CellId> skip_invalid_cells(const Scene& scene);

  /// Looks for cells that overlap before the first order is made, so that each two of them are put
  /// in order pixel by pixel. `planarity`: how deep they may overlap, relative to their size.
  /// Throws UsageError when the orders are given.
  void look_for_overlaps(double planarity);

  /// Takes orders that were made before, chunks of an order file or behind a mesh, in place of
  /// making them. `subject` names their source in errors.
  void use_orders(std::string subject, std::vector<ExtraChunk> chunks);

  /// Throws InputError when orders are given and none of them fits the scene.
  void require_order(const Scene& scene);

  /// The visibility order for a scene of one frame (camera_path.hpp), made or among those given.
  std::shared_ptr<const MeshOrder> order(const Scene& scene);

  /// The picture of a scene of one frame. Throws UsageError where the request does not fit the
  /// scene, and what `order` throws.
  Picture picture(const Scene& scene, const PictureRequest& request = {});

  /// How one pixel of a scene of one frame comes about.
  Explanation explain(const Scene& scene, std::uint32_t x, std::uint32_t y, bool background = true);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Throws UsageError when the request does not fit a picture of that size: to be asked before a
/// long computation. Returns the part that is wanted.
PixelRect require_possible(const PictureRequest& request, ImageSize size);

/// A first image specification for a mesh: every node of its cells in sight from a raised corner,
/// the first field that has values, coloured over its range, and an extinction that grows with it
/// such that the optical depth is about 1 in the mean over the pixels that the mesh covers.
/// Throws InputError(subject, ...) for a mesh without cells or without such a field.
Scene starter_view(const ZooMesh& mesh, const std::string& subject = "mesh");

}  // namespace hiac

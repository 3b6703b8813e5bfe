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
#include "hiac/scene/specification.hpp"

/// Makes a picture of a mesh and a specification: the interface for all front ends (commands,
/// windows, scripts). Meshes, specifications and images are read and written by zoo_container.hpp,
/// specification.hpp and image_io.hpp.
namespace hiac {

struct PixelExplanation;
struct RenderStatistics;
struct MeshOrder;
class TileCrew;

/// How a front end watches work and stops it. Every member is optional.
struct Monitor {
  Progress* progress = nullptr;                ///< receives every stage and the progress of drawing
  const Cancellation* cancellation = nullptr;  ///< if requested, the work throws Cancelled
  /// Called when a stage ends, also by an exception, with its name and duration. Must not throw.
  std::function<void(const std::string& stage, double seconds)> stage_ended = {};
  /// Called with a human-readable line about a finding.
  std::function<void(const std::string& line)> note = {};
};

/// The options of a picture besides the specification. Default: the whole picture with its
/// background, one ray per pixel, no further channels.
struct PictureRequest {
  std::optional<PixelRect> part;          ///< none: the whole picture
  std::optional<Supersampling> sampling;  ///< none: one ray through each pixel's centre
  /// Further channels, by name: "depth", "mean_depth", "transparency", "cells", "witness", "error".
  std::vector<std::string> channels;
  bool background = true;  ///< composite the specification's background behind the volume
  /// A picture of the same size to composite behind instead; must outlive the call.
  const Image* under = nullptr;
  /// The processes that share the work, each with a session of its own that is asked the same
  /// (tile_crew.hpp): of the images, that of one process alone is complete.
  const TileCrew* crew = nullptr;
};

/// A picture and the facts recorded while it was made.
struct Picture {
  Image image;  ///< "R" "G" "B" "A", premultiplied, linear; then the further channels
  std::uint64_t segments = 0;    ///< ray segments, one for each cell that a ray meets
  std::uint64_t violations = 0;  ///< segments out of order
  std::uint64_t covered_pixels = 0;
  /// Of the medium and the isosurfaces, over the covered pixels that tell it: those whose skin and
  /// edges let through a thousandth of what is behind them or more.
  double mean_optical_depth = 0, largest_optical_depth = 0;
  std::string mesh_hash;  ///< content_hash of the mesh
  // complete results, for callers who know the types
  std::shared_ptr<const MeshOrder> order;
  std::shared_ptr<const RenderStatistics> statistics;
};

/// What the ray of one pixel meets (explain_pixel.hpp), and the order used for it.
struct Explanation {
  std::shared_ptr<const PixelExplanation> pixel;
  std::shared_ptr<const MeshOrder> order;
};

/// Draws one mesh any number of times. Data that do not depend on the view are computed once, and
/// the last view's order is kept. The same input gives the same bits, whatever the number of
/// threads, and whether or not work was cancelled before. May be used by one thread at a time.
class Session {
 public:
  explicit Session(ZooMesh mesh, Monitor monitor = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] const ZooMesh& mesh() const;

  /// Goes on with another time step: takes `mesh` over, keeps what is known of its geometry, orders
  /// above all, and returns true. If the geometry (cells, nodes, coordinates to the bit) is
  /// another, changes nothing and returns false.
  bool take_step(ZooMesh& mesh);

  /// Throws InputError if the mesh, or something in the scene, cannot be drawn, and UsageError if a
  /// field does not exist. Must be called once for each mesh and specification, before `picture`,
  /// which does not check them.
  void require_drawable(const Scene& scene);

  /// Does the same, but leaves cells that are partly turned inside out out of all further pictures.
  /// Returns these cells, ascending.
  std::vector<CellId> skip_invalid_cells(const Scene& scene);

  /// Requests a search for overlapping cells before the first order is made, so that every two
  /// overlapping cells are sorted pixel by pixel. `planarity`: the permitted depth of an overlap,
  /// relative to the cells' size. Throws UsageError if orders are given.
  void look_for_overlaps(double planarity);

  /// Uses existing orders, from chunks of an order file or of a mesh file, instead of making them.
  /// `subject` names their source in errors.
  void use_orders(std::string subject, std::vector<ExtraChunk> chunks);

  /// Throws InputError if orders are given and none of them fits the scene.
  void require_order(const Scene& scene);

  /// The visibility order for a scene of one frame (camera_path.hpp), made or taken from the given
  /// ones.
  std::shared_ptr<const MeshOrder> order(const Scene& scene);

  /// The picture of a scene of one frame. Throws UsageError if the request does not fit the scene,
  /// and whatever `order` throws.
  Picture picture(const Scene& scene, const PictureRequest& request = {});

  /// The picture of a scene of one frame without an order, by following each ray from cell to cell:
  /// the same numbers to within rounding, in less time where many cells lie behind one pixel, as
  /// while a large mesh is turned in a window. Without further channels; its `order` is null.
  ///
  /// None where `picture` is to be asked: where it is as fast, or rays are not followed so, because
  /// of other cells than linear tetrahedra, cells that overlap or are searched for overlaps,
  /// anything but edges and a medium of one field of nodes with the exact rule of integration, a
  /// clipping slab, or a node beside or behind the eye.
  std::optional<Picture> picture_by_rays(const Scene& scene, bool background = true);

  /// Explains how one pixel of a scene of one frame is computed.
  Explanation explain(const Scene& scene, std::uint32_t x, std::uint32_t y, bool background = true);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Puts the points of a specification's transfer functions on the scalars of their fields, where
/// their `range` is "auto" or percentiles: those of the finite values at nodes, corners or cells
/// that belong to cells of the mesh, every value once, percentiles linear between two values. On a
/// logarithmic scale only positive values count. A field with one value, or percentiles that are
/// equal, takes what the points have in the middle, at 0.5. Notes say which range was found.
///
/// Throws UsageError if a field does not exist, and InputError if it has no such values, or too
/// large ones.
ParsedScene with_field_ranges(ParsedScene parsed, const ZooMesh& mesh);

/// Returns the requested part. Throws UsageError if the request does not fit a picture of that
/// size: to be called before a long computation.
PixelRect require_possible(const PictureRequest& request, ImageSize size);

/// The scene of make_starter_view (starter_view.hpp) as it is without any options.
Scene starter_view(const ZooMesh& mesh, const std::string& subject = "mesh");

}  // namespace hiac

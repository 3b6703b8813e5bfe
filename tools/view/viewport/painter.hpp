#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hiac/annotate/annotation_facts.hpp"
#include "hiac/base/progress.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/annotation.hpp"
#include "hiac/session/session.hpp"

namespace hiac::view {

class HardwarePreview;

/// What the window is to show: a mesh and a scene of one frame.
struct Wanted {
  std::shared_ptr<const ZooMesh> mesh;
  Scene scene;
  Annotation annotation;
  std::uint32_t samples = 1;  ///< rays along a side of each pixel, once the picture is at rest
  /// While something moves, by graphics hardware (HardwarePreview), where that can draw the scene.
  bool hardware = false;
};

/// A picture of what is wanted, or of some of its pixels.
struct Painted {
  std::vector<std::uint8_t> bytes =
      {};  ///< three a pixel (display_bytes.hpp), of the whole picture
  ImageSize size = {};
  std::uint32_t step = 1;     ///< every step-th pixel of every step-th row was computed
  std::uint64_t pixels = 0;   ///< that were computed
  std::uint32_t samples = 1;  ///< rays along a side of each pixel
  double seconds = 0;         ///< that it took
  std::uint64_t violations = 0, segments = 0;
  double mean_optical_depth = 0, largest_optical_depth = 0;
  std::size_t left_out = 0;  ///< cells that are partly turned inside out
  /// The largest error bound of a pixel; none: not computed, or not claimed.
  std::optional<double> error = {};
  std::shared_ptr<const Image> image =
      {};  ///< R G B A, without annotation, if all pixels were computed
  std::string mesh_hash = {};
  std::string device = {};  ///< that drew a preview in single precision; empty: the exact engine
  std::shared_ptr<const Wanted> wanted = {};  ///< what the picture is of
};

/// Draws what is wanted with the accurate engine, and keeps what the next picture can use: what
/// depends on the mesh as long as it stays, and the order as long as the eye stays. For one thread.
class Painter {
 public:
  /// `cancellation` stops the work, which then throws Cancelled.
  explicit Painter(const Cancellation& cancellation);
  ~Painter();

  /// Every step-th pixel of every step-th row; step 1 gives hiac-render's picture, to the bit.
  /// Throws what Session throws.
  Painted paint(const Wanted& wanted, std::uint32_t step);

  /// The picture by graphics hardware: all pixels, in single precision. Throws DriverError where
  /// there is none, and what HardwarePreview throws.
  Painted paint_by_hardware(const Wanted& wanted);
  /// Gives back what graphics hardware holds; the thread that painted by it must do so.
  void leave_hardware();

  /// The picture with wanted.samples rays along a side of each pixel.
  Painted paint_samples(const Wanted& wanted);

  /// The largest error bound of a pixel of the picture; none where no bound is claimed.
  std::optional<double> error_bound(const Wanted& wanted);

  /// What hiac-render --pixel tells.
  Explanation explain(const Wanted& wanted, std::uint32_t x, std::uint32_t y);

 private:
  Session& session_for(const Wanted& wanted);
  void annotate(Image& image, const Wanted& wanted) const;
  Painted whole(const Wanted& wanted, std::uint32_t samples);

  const Cancellation& cancellation_;
  std::shared_ptr<const ZooMesh> mesh_;  // of the session
  std::unique_ptr<Session> session_;
  std::unique_ptr<HardwarePreview> hardware_;  // made when it is first wanted
  std::optional<Scene> checked_;  // is drawable, with its camera and its size or any others
  std::size_t left_out_ = 0;
};

}  // namespace hiac::view

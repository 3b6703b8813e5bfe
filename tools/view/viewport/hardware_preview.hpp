#pragma once

#include <memory>
#include <string>

#include "hiac/image/image.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/session/session.hpp"

namespace hiac::view {

/// Pictures by graphics hardware, in single precision, for while something moves: those of
/// `hiac-render --engine preview`. For one thread, to which its OpenGL context belongs.
class HardwarePreview {
 public:
  /// Throws preview::DriverError, of one line, where there is no driver, or none was built in.
  HardwarePreview();
  ~HardwarePreview();
  HardwarePreview(const HardwarePreview&) = delete;
  HardwarePreview& operator=(const HardwarePreview&) = delete;

  /// Whether it draws a scene, but for edges, which it leaves out: the scene has neither skin nor
  /// splats.
  static bool draws(const Scene& scene);

  /// The name of the device that draws.
  [[nodiscard]] const std::string& device() const;

  /// The picture over its background. `mesh` is not null; `session` is the mesh's, and gives the
  /// order where the mesh is of linear tetrahedra; other cells are drawn as tetrahedra of their
  /// own, in an order of theirs. Throws what preview::Preview and the session throw.
  Image draw(const std::shared_ptr<const ZooMesh>& mesh, const Scene& scene, Session& session);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hiac::view

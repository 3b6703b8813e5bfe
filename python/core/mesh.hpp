#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include <pybind11/pybind11.h>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/session/session.hpp"
#include "python/core/work.hpp"

namespace hiac::python {

/// Draws a mesh for one caller at a time.
struct Drawer {
  explicit Drawer(ZooMesh mesh)
      : watch(std::make_shared<Watch>()),
        session(std::move(mesh), {&watch->progress, &watch->cancellation}) {}

  /// Throws unless the scene can be drawn; what was found last is not looked for again.
  void require_drawable(const Scene& scene);

  std::shared_ptr<Watch> watch;
  Session session;
  std::optional<Scene> checked;
};

/// A mesh, and what is known of it between two pictures: the drawer of the last one. Threads that
/// draw it at the same time have drawers of their own.
class MeshHandle {
 public:
  explicit MeshHandle(ZooMesh mesh) : mesh_(std::move(mesh)) {}

  [[nodiscard]] const ZooMesh& mesh() const { return mesh_; }

  /// The kept drawer, if nobody uses it, or a new one. Takes no GIL.
  std::shared_ptr<Drawer> take_drawer();
  /// Keeps a drawer for the next picture.
  void keep(std::shared_ptr<Drawer> drawer);

 private:
  ZooMesh mesh_;
  std::mutex mutex_;
  std::shared_ptr<Drawer> idle_;
};

void bind_mesh(py::module_& module);

}  // namespace hiac::python

#include "python/core/tetrahedralize.hpp"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/tetrahedralize/subdivide_cells.hpp"
#include "python/core/mesh.hpp"

namespace hiac::python {
namespace {

std::shared_ptr<MeshHandle> tetrahedralize(std::shared_ptr<MeshHandle> mesh, bool linearize,
                                           unsigned levels, const py::object& progress,
                                           std::shared_ptr<const Cancellation> cancel) {
  if (levels > kMostSubdivisionLevels)
    throw UsageError(
        fmt::format("levels: 0 to {} expected ({} found)", kMostSubdivisionLevels, levels));
  if (levels > 0 && !linearize) throw UsageError("levels: only with linearize");
  return result_of({progress, std::move(cancel)}, [mesh, linearize, levels](Watch&) {
    return std::make_shared<MeshHandle>(subdivide_cells(mesh->mesh(), {linearize, levels}).mesh);
  });
}

}  // namespace

void bind_tetrahedralize(py::module_& module) {
  module.def("tetrahedralize", &tetrahedralize, py::arg("mesh"), py::arg("linearize"),
             py::arg("levels"), py::arg("progress"), py::arg("cancel"));
}

}  // namespace hiac::python

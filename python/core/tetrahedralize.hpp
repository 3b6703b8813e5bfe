#pragma once

#include <pybind11/pybind11.h>

namespace hiac::python {

/// Tetrahedra from the cells of a mesh.
void bind_tetrahedralize(pybind11::module_& module);

}  // namespace hiac::python

#pragma once

#include <pybind11/pybind11.h>

namespace hiac::python {

/// Pictures of meshes, and explanations of their pixels.
void bind_drawing(pybind11::module_& module);

}  // namespace hiac::python

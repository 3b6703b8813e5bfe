#pragma once

#include <pybind11/pybind11.h>

namespace hiac::python {

void bind_scene(pybind11::module_& module);

}  // namespace hiac::python

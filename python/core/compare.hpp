#pragma once

#include <pybind11/pybind11.h>

namespace hiac::python {

/// Differences of images.
void bind_compare(pybind11::module_& module);

}  // namespace hiac::python

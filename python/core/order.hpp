#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "hiac/mesh/zoo_container.hpp"

namespace hiac::python {

/// Visibility orders of a mesh, made or read.
struct OrderHandle {
  std::string subject;             ///< where they are from, for errors
  std::vector<ExtraChunk> chunks;  ///< of type kOrderChunk, at least one
};

void bind_order(pybind11::module_& module);

}  // namespace hiac::python

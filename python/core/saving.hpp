#pragma once

#include <string>

#include <pybind11/pybind11.h>

#include "tools/common/file_kind.hpp"

namespace hiac::python {

/// Throws UsageError where an output would replace a file of another kind of ours, as the programs
/// do. Devices and pipes are written to and never refused.
void require_same_kind(const std::string& path, tools::FileKind kind);

void bind_saving(pybind11::module_& module);

}  // namespace hiac::python

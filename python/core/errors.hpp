#pragma once

namespace hiac::python {

/// From now on C++ exceptions become those of the module hiac.errors, with the same one line.
void register_errors();

}  // namespace hiac::python

#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// EnSight Gold: a case file that names a geometry and variables, each in a file (or one per step)
/// in ASCII or C binary, in either byte order; unstructured and structured parts.
///
/// Ansys EnSight User Manual, section "EnSight Gold Casefile Format".
Format ensight_format();

}  // namespace hiac::formats

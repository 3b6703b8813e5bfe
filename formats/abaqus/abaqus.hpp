#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Input decks of Abaqus and CalculiX (.inp): the mesh, its parts, instances and sets.
Format abaqus_format();

}  // namespace hiac::formats

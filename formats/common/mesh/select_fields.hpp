#pragma once

#include <span>
#include <string>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// The fields that are requested, in the requests' order; all without a request.
///
/// A request is NAME[=NEW]: NAME is a field with all its components, or one of the scalars that
/// scalar_field knows (NAME:x, NAME:magnitude). Where node, cell and corner fields share a name,
/// NAME selects all of them, and node/NAME, cell/NAME or corner/NAME selects one. Throws UsageError
/// naming the request.
std::vector<Field> select_fields(const ZooMesh& mesh, std::span<const std::string> requests);

}  // namespace hiac::formats

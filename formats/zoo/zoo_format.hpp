#pragma once

#include "formats/common/mesh/format.hpp"
#include "hiac/mesh/zoo_container.hpp"

namespace hiac::formats {

/// The project's own container, so that tools treat it like any other format.
Format zoo_format();

/// The mesh of a container that has been read. Chunks that accompany the mesh (an order, say) are
/// left out with a note. Throws UsageError when a time, step or block is requested.
Reading reading_of(ZooFile&& file, const ReadOptions& options, const std::string& subject);

/// The inventory of a mesh in memory.
Inventory inventory_of(const ZooMesh& mesh);

}  // namespace hiac::formats

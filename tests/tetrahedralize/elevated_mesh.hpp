#pragma once

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::test {

/// A mesh of linear cells with the nodes of a higher order put in, on straight edges, evenly: cells
/// that share an edge or a face share its nodes. Fields are left out.
ZooMesh elevated(const ZooMesh& linear, CellOrder order);

}  // namespace hiac::test

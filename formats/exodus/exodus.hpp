#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Exodus II, the results of Sandia's and MOOSE's solvers: element blocks, nodal and element
/// variables, time steps. Reads through netCDF.
///
/// G. D. Sjaardema, L. A. Schoof, V. R. Yarberry: EXODUS: A Finite Element Data Model (SAND92-2137,
/// revised 2019), with the node orders in its section 4.8.
Format exodus_format();

}  // namespace hiac::formats

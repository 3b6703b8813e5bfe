#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

Format vtk_legacy_format();  ///< .vtk, ASCII and binary, every dataset with volume cells
Format vtu_format();         ///< .vtu, read and written
Format pvtu_format();        ///< .pvtu: the .vtu pieces of a parallel run
Format pvts_format();        ///< .pvts, .pvti, .pvtr: the same of the structured formats
Format pvti_format();
Format pvtr_format();
Format vts_format();  ///< .vts: curvilinear grids, as bricks
Format vti_format();  ///< .vti: images, as bricks
Format vtr_format();  ///< .vtr: rectilinear grids, as bricks
Format pvd_format();  ///< .pvd: a file (or several) for every step
Format vtm_format();  ///< .vtm, .vtpc, .vtpd: blocks, a file each

}  // namespace hiac::formats

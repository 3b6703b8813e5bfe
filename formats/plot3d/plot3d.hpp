#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// PLOT3D: structured blocks in every dialect of the format, which the files themselves do not
/// state: ASCII or binary in either byte order, with or without Fortran's record marks, single or
/// double precision, one block or several, with or without IBLANK, whole blocks or planes. The
/// reader takes the one dialect whose size fits the file. The Q file (OVERFLOW's too) and the
/// function file are found beside the grid by their names, or named by a .p3d index, which may list
/// several steps.
///
/// P. Walatka, P. Buning et al.: PLOT3D User's Manual, NASA TM-101067 (1990); OVERFLOW's Q file:
/// R. Nichols, P. Buning: User's Manual for OVERFLOW 2.1 (2008).
Format plot3d_format();

}  // namespace hiac::formats

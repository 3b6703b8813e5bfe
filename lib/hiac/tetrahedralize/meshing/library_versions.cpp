#include "hiac/tetrahedralize/meshing/library_versions.hpp"

#include <CGAL/version.h>
#include <fmt/format.h>
#include <gmp.h>

namespace hiac {

std::string meshing_library_versions() {
  return fmt::format("CGAL {}, GMP {}, TetGen {}", CGAL_VERSION_STR, gmp_version,
                     HIAC_TETGEN_VERSION);
}

}  // namespace hiac

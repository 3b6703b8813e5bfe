#pragma once

#include <string>

namespace hiac {

/// The versions of the libraries that make tetrahedra: "CGAL 5.5.1, GMP 6.2.1, TetGen 1.5".
std::string meshing_library_versions();

}  // namespace hiac

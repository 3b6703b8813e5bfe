#pragma once

#include <string>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// Whether the name is that of a file of points: .csv .txt .xyz .node.
bool is_point_file(const std::string& path);

/// Reads points and what is known at each: a mesh of nodes and node fields without cells.
///
/// .csv, .txt, .xyz: a point a line, its words separated by commas, semicolons, blanks or tabs; the
/// first three are x, y and z, each further one is the value of a field. A first line that is not
/// of numbers names the columns (x, y, z may then stand anywhere); fields without a name are called
/// value, or value1, value2, ... Lines that begin with '#' are left out. .node: TetGen's, with its
/// attributes. Throws InputError naming the line.
ZooMesh read_points(const std::string& path);

}  // namespace hiac::formats

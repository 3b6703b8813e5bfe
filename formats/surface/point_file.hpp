#pragma once

#include <string>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// Whether the name has an extension of point files: .csv .txt .xyz .node.
bool is_point_file(const std::string& path);

/// Reads points and the data at each point: a mesh of nodes and node fields without cells.
///
/// .csv, .txt, .xyz: one point per line, its words separated by commas, semicolons, blanks or tabs;
/// the first three are x, y and z, every further one is the value of a field. A first line that
/// does not consist of numbers names the columns (x, y, z may then be in any columns); fields
/// without a name are called value, or value1, value2, ... Lines that begin with '#' are left out.
/// .node: TetGen's format, with its attributes. Throws InputError naming the line.
ZooMesh read_points(const std::string& path);

}  // namespace hiac::formats

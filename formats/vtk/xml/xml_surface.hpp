#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hiac::formats::vtk {

/// The polygons of a file, of all pieces together.
struct XmlSurface {
  std::vector<double> xyz;                           ///< x y z of every point
  std::vector<std::vector<std::uint32_t>> polygons;  ///< points, three or more each
  std::vector<std::string> notes;
};

/// Reads the surface in a VTK XML file of polygons (.vtp) or of an unstructured grid (.vtu), by our
/// own code alone, which checks every number that the file declares. Strips, pixels and quadratic
/// triangles become triangles and quadrilaterals with the same points; points and lines are left
/// out with a note; of several time steps the last is read. Throws InputError naming the file, also
/// for cells with a volume, and for surface cells of other orders and ghost cells.
XmlSurface read_xml_surface(const std::string& path);

}  // namespace hiac::formats::vtk

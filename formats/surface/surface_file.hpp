#pragma once

#include <string>
#include <vector>

#include "hiac/tetrahedralize/surface.hpp"

namespace hiac::formats {

/// A surface, and notes for the user on how it was read, one sentence each.
struct SurfaceReading {
  Surface surface;
  std::vector<std::string> notes;
  /// The format allows interior facets, which may end anywhere.
  bool inner_facets = false;
};

/// Whether the name has an extension of surface files: .stl .ply .obj .off .vtp .poly .smesh.
bool is_surface_file(const std::string& path);

/// Whether read_surface knows the name's extension: the same, and .vtu, which may hold a surface or
/// a mesh.
bool may_hold_surface(const std::string& path);

/// Reads a file of surfaces, by its extension.
///
/// STL (ASCII, binary; equal corners become one point), PLY, OBJ and OFF through CGAL's readers of
/// polygon soups: polygons of more than three corners are cut into triangles that share the
/// smallest corner. .vtp and .vtu (vtk/xml/xml_surface.hpp): the same of their polygons. .poly and
/// .smesh (TetGen 1.5): facets as they are, with holes and regions; points in the file or in the
/// .node file beside it. Throws InputError when the file cannot be read, has none of these formats,
/// contains no polygon, or has coordinates that are not finite.
SurfaceReading read_surface(const std::string& path);

}  // namespace hiac::formats

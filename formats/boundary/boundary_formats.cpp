#include "formats/boundary/boundary_formats.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/boundary/write_boundary.hpp"

namespace hiac::formats {
namespace {

using SurfaceWriter = std::vector<std::string> (*)(const std::string& path,
                                                   const BoundarySurface& surface);

Format boundary_format(std::string_view name, std::string_view extension, std::string_view fields,
                       SurfaceWriter writer) {
  Format format;
  format.name = name;
  format.extensions = {extension};
  format.kinds = "boundary triangles";
  format.fields = fields;
  format.time_steps = "one";
  format.recognizes = [](std::string_view) { return false; };
  format.write_boundary = [writer](const std::string& path, const BoundarySurface& surface) {
    std::vector<std::string> notes = writer(path, surface);
    if (!surface.averaged.empty() && !surface.fields.empty())
      notes.push_back(
          fmt::format("the values on cell corners of {} became means at the points of the boundary",
                      fmt::join(surface.averaged, ", ")));
    return notes;
  };
  format.write = [write = format.write_boundary](const std::string& path, const ZooMesh& mesh) {
    return write(path, boundary_surface(mesh, default_boundary_levels(mesh)));
  };
  return format;
}

}  // namespace

Format stl_format() { return boundary_format("stl", ".stl", "none", write_stl); }
Format ply_format() { return boundary_format("ply", ".ply", "node, cell", write_ply); }
Format vtp_format() { return boundary_format("vtp", ".vtp", "node, cell", write_vtp); }

}  // namespace hiac::formats

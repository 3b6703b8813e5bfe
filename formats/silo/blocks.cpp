#include "formats/silo/blocks.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/structured.hpp"
#include "formats/silo/zone_types.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::silo {
namespace {

/// A block has no more nodes or zones than this: Silo counts in 32-bit integers.
constexpr std::size_t kMost = std::numeric_limits<int>::max();

class BlockReader {
 public:
  BlockReader(SiloFiles& files, ForeignMesh& mesh)
      : files_(files), subject_(files.path()), mesh_(mesh) {}

  Block add(const Place& place, const std::string& name) {
    DBfile* file = files_.open(place.file);
    const int type = DBInqVarType(file, place.name.c_str());
    Block block{place, mesh_.point_count(), 0, mesh_.cell_count(), 0, false};
    if (type == DB_UCDMESH)
      add_unstructured(file, place.name, block);
    else if (type == DB_QUADMESH || type == DB_QUAD_RECT || type == DB_QUAD_CURV)
      add_structured(file, place.name, block);
    else
      throw InputError(place.file,
                       fmt::format("mesh '{}' is not there, or not one of zones", place.name));
    block.cells = mesh_.cell_count() - block.first_cell;
    mesh_.blocks.push_back({name, {{block.first_cell, mesh_.cell_count()}}});
    return block;
  }

 private:
  void note_time(double time) {
    for (const auto& [key, text] : mesh_.metadata)
      if (key == "time") return;
    mesh_.metadata.emplace_back("time", fmt::format("{}", time));
  }

  void add_points(void* const* coordinates, int type, std::size_t count, const std::string& name) {
    std::array<std::vector<double>, 3> axes;
    for (std::size_t c = 0; c < 3; ++c)
      axes[c] = numbers(coordinates[c], type, count, subject_ + ": mesh '" + name + "'");
    for (std::size_t p = 0; p < count; ++p)
      for (const std::vector<double>& axis : axes) mesh_.xyz.push_back(axis[p]);
  }

  void add_unstructured(DBfile* file, const std::string& name, Block& block) {
    const Owned<DBucdmesh> mesh(DBGetUcdmesh(file, name.c_str()));
    if (!mesh) throw InputError(subject_, fmt::format("mesh '{}' is damaged", name));
    if (mesh->ndims != 3) {
      mesh_.notes.push_back(
          fmt::format("left out '{}', a mesh of {} dimensions", name, mesh->ndims));
      return;
    }
    block.points = static_cast<std::size_t>(std::max(mesh->nnodes, 0));
    add_points(mesh->coords, mesh->datatype, block.points, name);
    note_time(mesh->dtime);
    if (mesh->phzones != nullptr) return add_polyhedra(*mesh->phzones, name, block);
    if (mesh->zones == nullptr)
      throw InputError(subject_, fmt::format("mesh '{}' has no zones", name));
    add_zones(*mesh->zones, name, block);
  }

  [[nodiscard]] std::int64_t node(int stored, int origin, const std::string& name,
                                  const Block& block) const {
    const std::int64_t number = std::int64_t{stored} - origin;
    if (number < 0 || static_cast<std::size_t>(number) >= block.points)
      throw InputError(subject_, fmt::format("mesh '{}': there is no node {} ({} nodes found)",
                                             name, stored, block.points));
    return number + static_cast<std::int64_t>(block.first_point);
  }

  void add_zones(const DBzonelist& zones, const std::string& name, const Block& block) {
    std::size_t at = 0;
    std::size_t zone = 0;
    const auto listed = static_cast<std::size_t>(std::max(zones.lnodelist, 0));
    for (int s = 0; s < zones.nshapes; ++s) {
      const int size = zones.shapesize[s];
      const auto count = static_cast<std::size_t>(std::max(zones.shapecnt[s], 0));
      const auto type = zone_type(zones.shapetype == nullptr ? 0 : zones.shapetype[s], size);
      if (size < 1 || count > (listed - at) / static_cast<std::size_t>(size) ||
          (type && static_cast<std::size_t>(size) != node_count(type->kind)))
        throw InputError(subject_,
                         fmt::format("mesh '{}': its zones do not fit their list of nodes", name));
      std::vector<std::int64_t> nodes;
      for (std::size_t i = 0; i < count * static_cast<std::size_t>(size); ++i)
        nodes.push_back(node(zones.nodelist[at + i], zones.origin, name, block));
      at += nodes.size();
      add_shape(nodes, static_cast<std::size_t>(size), type, zones, zone, name);
      zone += count;
    }
  }

  void add_shape(const std::vector<std::int64_t>& nodes, std::size_t size,
                 const std::optional<ZoneType>& type, const DBzonelist& zones, std::size_t zone,
                 const std::string& name) {
    const std::uint16_t ghost = mesh_.type_place("ghost zone", size, kNoVolume);
    std::uint16_t place = ghost;
    if (type) {
      const bool turned = are_inside_out(*type, nodes, mesh_.xyz);
      if (turned)
        mesh_.notes.push_back(
            fmt::format("mesh '{}': its zones of the type {} are inside out and "
                        "were turned",
                        name, type->name));
      place = mesh_.type_place(turned ? fmt::format("{} (turned)", type->name) : type->name, size,
                               converted_to(type->kind, turned ? type->turned : type->order));
    } else {
      place = mesh_.type_place("zone of another type", size, kUnsupported);
    }
    for (std::size_t z = 0; z < nodes.size() / size; ++z) {
      const auto number = static_cast<int>(zone + z);
      const bool real =
          number >= zones.min_index && number <= zones.max_index &&
          (zones.ghost_zone_labels == nullptr || zones.ghost_zone_labels[number] == 0);
      mesh_.cell_types.push_back(real ? place : ghost);
    }
    mesh_.cell_nodes.insert(mesh_.cell_nodes.end(), nodes.begin(), nodes.end());
  }

  void add_polyhedra(const DBphzonelist& zones, const std::string& name, const Block& block) {
    const auto fail = [&] {
      return InputError(subject_, fmt::format("mesh '{}': its zones do not fit their faces", name));
    };
    std::vector<std::vector<std::int64_t>> faces;
    int at = 0;
    for (int f = 0; f < zones.nfaces; ++f) {
      if (zones.nodecnt[f] < 0 || zones.nodecnt[f] > zones.lnodelist - at) throw fail();
      std::vector<std::int64_t> face;
      for (int n = 0; n < zones.nodecnt[f]; ++n)
        face.push_back(node(zones.nodelist[at++], zones.origin, name, block));
      faces.push_back(std::move(face));
    }
    at = 0;
    std::vector<std::uint8_t> uses(faces.size(), 0);
    for (int z = 0; z < zones.nzones; ++z) {
      if (zones.facecnt[z] < 0 || zones.facecnt[z] > zones.lfacelist - at) throw fail();
      std::vector<std::vector<std::int64_t>> own;
      for (int f = 0; f < zones.facecnt[z]; ++f) {
        // a face that is seen from its other side is given as its complement
        const int stored = zones.facelist[at++];
        const int face = (stored < 0 ? ~stored : stored) - zones.origin;
        if (face < 0 || face >= zones.nfaces) throw fail();
        // otherwise a small file could demand much memory
        if (++uses[static_cast<std::size_t>(face)] > 2) throw fail();
        own.push_back(faces[static_cast<std::size_t>(face)]);
      }
      if (z >= zones.lo_offset && z <= zones.hi_offset)
        mesh_.add_polyhedron("polyhedron", own);
      else
        mesh_.cell_types.push_back(mesh_.type_place("ghost zone", 0, kNoVolume));
    }
  }

  void add_structured(DBfile* file, const std::string& name, Block& block) {
    const Owned<DBquadmesh> mesh(DBGetQuadmesh(file, name.c_str()));
    if (!mesh) throw InputError(subject_, fmt::format("mesh '{}' is damaged", name));
    if (mesh->ndims != 3) {
      mesh_.notes.push_back(
          fmt::format("left out '{}', a mesh of {} dimensions", name, mesh->ndims));
      return;
    }
    block.structured = true;
    const std::array<std::int64_t, 3> extents{mesh->dims[0], mesh->dims[1], mesh->dims[2]};
    const StructuredBlock grid = structured_block(extents, kMost, subject_);
    block.points = grid.point_count();
    if (mesh->coordtype == DB_COLLINEAR) {
      std::array<std::vector<double>, 3> axes;
      for (std::size_t c = 0; c < 3; ++c)
        axes[c] = numbers(mesh->coords[c], mesh->datatype, grid.points[c], subject_);
      for (const double z : axes[2])
        for (const double y : axes[1])
          for (const double x : axes[0])
            for (const double v : {x, y, z}) mesh_.xyz.push_back(v);
    } else {
      add_points(mesh->coords, mesh->datatype, block.points, name);
    }
    note_time(mesh->dtime);
    add_bricks(mesh_, grid, block.first_point, {}, "");
    hide_ghosts(*mesh, grid, block);
  }

  /// Zones outside the range of real zones are ghost zones.
  void hide_ghosts(const DBquadmesh& mesh, const StructuredBlock& grid, const Block& block) {
    const std::uint16_t ghost = mesh_.type_place("ghost zone", 8, kNoVolume);
    std::size_t cell = block.first_cell;
    for (std::size_t k = 0; k + 1 < grid.points[2]; ++k)
      for (std::size_t j = 0; j + 1 < grid.points[1]; ++j)
        for (std::size_t i = 0; i + 1 < grid.points[0]; ++i, ++cell) {
          const std::array<std::size_t, 3> index{i, j, k};
          for (std::size_t c = 0; c < 3; ++c)
            if (static_cast<int>(index[c]) < mesh.min_index[c] ||
                static_cast<int>(index[c]) >= mesh.max_index[c])
              mesh_.cell_types[cell] = ghost;
        }
  }

  SiloFiles& files_;
  const std::string& subject_;
  ForeignMesh& mesh_;
};

}  // namespace

Block add_block(SiloFiles& files, const Place& place, const std::string& name, ForeignMesh& mesh) {
  return BlockReader(files, mesh).add(place, name);
}

}  // namespace hiac::formats::silo

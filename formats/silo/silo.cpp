#include "formats/silo/silo.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "formats/common/io/isolated.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/structured.hpp"
#include "formats/hdf5/hdf5_model.hpp"
#include "formats/silo/silo_file.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

using silo::Owned;
using silo::Place;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// A block has no more nodes or zones than this: Silo counts in 32-bit integers.
constexpr std::size_t kMost = std::numeric_limits<int>::max();

// Silo's prism lists its quadrilateral 0 1 2 3 first and then the opposite edge 4 5, with 4 next to
// 0 and 3. Tetrahedra, pyramids and prisms occur in either orientation: those of one kind in a
// block are reversed when most of them are inside out.
constexpr std::array<std::uint8_t, 6> kPrism{2, 5, 1, 3, 4, 0};
constexpr std::array<std::uint8_t, 6> kPrismTurned{3, 4, 0, 2, 5, 1};
constexpr std::array<std::uint8_t, 4> kTetrahedronTurned{0, 2, 1, 3};
constexpr std::array<std::uint8_t, 5> kPyramidTurned{0, 3, 2, 1, 4};
constexpr std::array<std::uint8_t, 8> kBrickTurned{0, 3, 2, 1, 4, 7, 6, 5};

struct ZoneType {
  CellKind kind;
  const char* name;
  std::span<const std::uint8_t> order;
  std::span<const std::uint8_t> turned;
};

std::optional<ZoneType> zone_type(int type, int size) {
  // older files have no types, only sizes
  if (type == DB_ZONETYPE_TET || (type == 0 && size == 4))
    return ZoneType{CellKind::tetrahedron4, "tetrahedron", {}, kTetrahedronTurned};
  if (type == DB_ZONETYPE_PYRAMID || (type == 0 && size == 5))
    return ZoneType{CellKind::pyramid5, "pyramid", {}, kPyramidTurned};
  if (type == DB_ZONETYPE_PRISM || (type == 0 && size == 6))
    return ZoneType{CellKind::prism6, "prism", kPrism, kPrismTurned};
  if (type == DB_ZONETYPE_HEX || (type == 0 && size == 8))
    return ZoneType{CellKind::brick8, "hexahedron", {}, kBrickTurned};
  return std::nullopt;
}

/// One block of the mesh, for its variables.
struct Block {
  Place mesh;
  std::size_t first_point = 0;
  std::size_t points = 0;
  std::size_t first_cell = 0;
  std::size_t cells = 0;  ///< in the file, in its order
  bool structured = false;
};

/// The variables with one name.
struct Variable {
  std::string name;
  std::vector<std::pair<std::size_t, Place>> parts;  ///< block and place
};

/// A variable of a block, on either kind of mesh.
struct Values {
  bool on_nodes = false;
  std::size_t tuples = 0;
  std::vector<std::vector<double>> components;
  std::string unit;
};

class Reader {
 public:
  explicit Reader(const std::string& path)
      : subject_(path), files_(std::make_shared<silo::SiloFiles>(path)) {}

  ForeignMesh read() {
    DBfile* file = files_->open(subject_);
    const DBtoc* toc = DBGetToc(file);
    if (toc == nullptr) throw InputError(subject_, "has no table of contents");
    const std::vector<std::string> multi(toc->multimesh_names,
                                         toc->multimesh_names + toc->nmultimesh);
    const std::vector<std::string> vars(toc->multivar_names, toc->multivar_names + toc->nmultivar);
    std::vector<std::string> meshes(toc->ucdmesh_names, toc->ucdmesh_names + toc->nucdmesh);
    meshes.insert(meshes.end(), toc->qmesh_names, toc->qmesh_names + toc->nqmesh);
    std::vector<std::string> plain(toc->ucdvar_names, toc->ucdvar_names + toc->nucdvar);
    plain.insert(plain.end(), toc->qvar_names, toc->qvar_names + toc->nqvar);
    if (!multi.empty()) {
      add_multimesh(multi.front());
      for (std::size_t m = 1; m < multi.size(); ++m)
        mesh_.notes.push_back(fmt::format("left out the further multi-block mesh '{}'", multi[m]));
      for (const std::string& name : vars) note_multivar(name);
    } else {
      for (const std::string& name : meshes) add_block({subject_, name}, name);
      for (const std::string& name : plain) note_variable(name);
    }
    if (blocks_->empty()) throw InputError(subject_, "holds no mesh at its root");
    add_fields();
    return std::move(mesh_);
  }

 private:
  void add_multimesh(const std::string& name) {
    const Owned<DBmultimesh> multi(DBGetMultimesh(files_->open(subject_), name.c_str()));
    if (!multi) throw InputError(subject_, fmt::format("multi-block mesh '{}' is damaged", name));
    if (multi->meshnames == nullptr)
      throw InputError(subject_, fmt::format("multi-block mesh '{}' names its blocks by a name "
                                             "scheme, which is not read",
                                             name));
    for (int b = 0; b < multi->nblocks; ++b) {
      const std::string block = multi->meshnames[b] == nullptr ? "" : multi->meshnames[b];
      if (block.empty() || block == "EMPTY") continue;
      add_block(files_->place_of(block), block);
    }
  }

  void add_block(const Place& place, const std::string& name) {
    DBfile* file = files_->open(place.file);
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
    blocks_->push_back(block);
  }

  void note_time(double time) {
    for (const auto& [key, text] : mesh_.metadata)
      if (key == "time") return;
    mesh_.metadata.emplace_back("time", fmt::format("{}", time));
  }

  void add_points(void* const* coordinates, int type, std::size_t count, const std::string& name) {
    std::array<std::vector<double>, 3> axes;
    for (std::size_t c = 0; c < 3; ++c)
      axes[c] = silo::numbers(coordinates[c], type, count, subject_ + ": mesh '" + name + "'");
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
      const bool turned = most_inside_out(nodes, size, *type);
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

  /// Judged by the sign of the triple product at the first corner: base 0 1 2 (of a prism:
  /// outwards) and a corner above it.
  [[nodiscard]] bool most_inside_out(const std::vector<std::int64_t>& nodes, std::size_t size,
                                     const ZoneType& type) const {
    const bool prism = type.kind == CellKind::prism6;
    const std::size_t third = prism || type.kind == CellKind::tetrahedron4 ? 2 : 3;
    const std::size_t above = type.kind == CellKind::tetrahedron4 || prism ? 3 : 4;
    std::int64_t votes = 0;
    for (std::size_t z = 0; z < nodes.size() / size; ++z) {
      const auto corner = [&](std::size_t n) {
        const std::size_t place = type.order.empty() ? n : type.order[n];
        return &mesh_.xyz[3 * static_cast<std::size_t>(nodes[z * size + place])];
      };
      std::array<std::array<double, 3>, 3> arrows{};
      const std::array<std::size_t, 3> ends{1, third, above};
      for (std::size_t e = 0; e < 3; ++e)
        for (std::size_t c = 0; c < 3; ++c) arrows[e][c] = corner(ends[e])[c] - corner(0)[c];
      const auto& [a, b, h] = arrows;
      const double volume = (a[1] * b[2] - a[2] * b[1]) * h[0] +
                            (a[2] * b[0] - a[0] * b[2]) * h[1] + (a[0] * b[1] - a[1] * b[0]) * h[2];
      votes += (prism ? -volume : volume) > 0 ? 1 : -1;
    }
    return votes < 0;
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
        axes[c] = silo::numbers(mesh->coords[c], mesh->datatype, grid.points[c], subject_);
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

  void note_multivar(const std::string& name) {
    const Owned<DBmultivar> multi(DBGetMultivar(files_->open(subject_), name.c_str()));
    if (!multi || multi->varnames == nullptr) {
      mesh_.notes.push_back(
          fmt::format("left out the variable '{}', whose blocks are not named", name));
      return;
    }
    Variable variable{name, {}};
    std::size_t block = 0;
    for (int b = 0; b < multi->nvars; ++b) {
      const std::string part = multi->varnames[b] == nullptr ? "" : multi->varnames[b];
      if (part.empty() || part == "EMPTY") continue;
      if (block < blocks_->size()) variable.parts.emplace_back(block++, files_->place_of(part));
    }
    variables_.push_back(std::move(variable));
  }

  void note_variable(const std::string& name) {
    DBfile* file = files_->open(subject_);
    const bool structured = DBInqVarType(file, name.c_str()) == DB_QUADVAR;
    std::string mesh;
    if (structured) {
      const Owned<DBquadvar> variable(DBGetQuadvar(file, name.c_str()));
      if (variable && variable->meshname != nullptr) mesh = variable->meshname;
    } else {
      const Owned<DBucdvar> variable(DBGetUcdvar(file, name.c_str()));
      if (variable && variable->meshname != nullptr) mesh = variable->meshname;
    }
    for (std::size_t b = 0; b < blocks_->size(); ++b)
      if (mesh == (*blocks_)[b].mesh.name || mesh == "/" + (*blocks_)[b].mesh.name)
        variables_.push_back({name, {{b, {subject_, name}}}});
  }

  static Values values_of(silo::SiloFiles& files, const Block& block, const Place& place) {
    DBfile* file = files.open(place.file);
    const std::string subject = fmt::format("{}: variable '{}'", place.file, place.name);
    Values values;
    const auto take = [&](void** stored, int count, int type, int tuples, const char* unit) {
      values.tuples = static_cast<std::size_t>(std::max(tuples, 0));
      if (unit != nullptr) values.unit = unit;
      for (int c = 0; c < count; ++c)
        values.components.push_back(silo::numbers(stored[c], type, values.tuples, subject));
    };
    if (block.structured) {
      const Owned<DBquadvar> variable(DBGetQuadvar(file, place.name.c_str()));
      if (!variable) throw InputError(subject, "cannot be read");
      take(variable->vals, variable->nvals, variable->datatype, variable->nels, variable->units);
      values.on_nodes = values.tuples == block.points && variable->align[0] == 0;
    } else {
      const Owned<DBucdvar> variable(DBGetUcdvar(file, place.name.c_str()));
      if (!variable) throw InputError(subject, "cannot be read");
      take(variable->vals, variable->nvals, variable->datatype, variable->nels, variable->units);
      values.on_nodes = variable->centering == DB_NODECENT;
    }
    if (values.tuples != (values.on_nodes ? block.points : block.cells))
      throw InputError(subject,
                       fmt::format("does not fit its mesh ({} values expected, {} found)",
                                   values.on_nodes ? block.points : block.cells, values.tuples));
    return values;
  }

  void add_fields() {
    for (const Variable& variable : variables_) {
      if (variable.parts.empty()) continue;
      const auto& [block, place] = variable.parts.front();
      const Values first = values_of(*files_, (*blocks_)[block], place);
      ForeignField field;
      field.name = variable.name;
      field.unit = first.unit;
      field.location = first.on_nodes ? FieldLocation::node : FieldLocation::cell;
      field.components = static_cast<std::uint32_t>(first.components.size());
      const std::size_t tuples = first.on_nodes ? mesh_.point_count() : mesh_.cell_count();
      field.values = [files = files_, blocks = blocks_, parts = variable.parts, tuples,
                      on_nodes = first.on_nodes, width = first.components.size()] {
        std::vector<double> all(tuples * width, kNaN);
        for (const auto& [b, where] : parts) {
          const Block& own = (*blocks)[b];
          const Values values = values_of(*files, own, where);
          if (values.components.size() != width || values.on_nodes != on_nodes)
            throw InputError(
                where.file,
                fmt::format("variable '{}' is of another kind than in other blocks", where.name));
          const std::size_t begin = on_nodes ? own.first_point : own.first_cell;
          for (std::size_t t = 0; t < values.tuples; ++t)
            for (std::size_t c = 0; c < width; ++c)
              all[(begin + t) * width + c] = values.components[c][t];
        }
        return all;
      };
      mesh_.fields.push_back(std::move(field));
    }
  }

  std::string subject_;
  std::shared_ptr<silo::SiloFiles> files_;
  ForeignMesh mesh_;
  std::shared_ptr<std::vector<Block>> blocks_ = std::make_shared<std::vector<Block>>();
  std::vector<Variable> variables_;
};

}  // namespace

Format silo_format() {
  Format format;
  format.name = "silo";
  format.extensions = {".silo", ".root"};
  format.kinds = "tet4 pyr5 prism6 brick8, polyhedra, structured";
  format.fields = "node, cell";
  format.time_steps = "one";
  // files of the driver PDB; files of the other driver are HDF5 files
  format.recognizes = [](std::string_view head) {
    return head.starts_with("!<<PDB:") || head.starts_with("!<><PDB>");
  };
  format.contains = [](const std::string& path) { return hdf5::model_of(path) == "silo"; };
  read_through(format, [](const std::string& path, const ReadOptions&) {
    return read_isolated(path, "Silo", [](const std::string& file) { return Reader(file).read(); });
  });
  return format;
}

}  // namespace hiac::formats

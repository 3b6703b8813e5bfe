// hiac-tetrahedralize: tetrahedra from a closed surface, from points, or from cells of any kind.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/surface/point_file.hpp"
#include "formats/surface/surface_file.hpp"
#include "hiac/base/error.hpp"
#include "hiac/geometry/predicates.hpp"
#include "hiac/tetrahedralize/meshing/delaunay.hpp"
#include "hiac/tetrahedralize/meshing/library_versions.hpp"
#include "hiac/tetrahedralize/subdivide_cells.hpp"
#include "tools/common/foreign_mesh.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/tool.hpp"
#include "tools/common/version.hpp"
#include "tools/tetrahedralize/surface_source.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;

struct Options {
  std::string input, output;
  bool cells = false, delaunay = false;
  SurfaceOptions surface;
  Subdivision subdivision;
};

// What the input is made of.
enum class Source { surface, points, cells };

Source source_of(const Options& options) {
  const bool surface = formats::is_surface_file(options.input);
  if (options.delaunay) {
    if (surface)
      throw UsageError(
          "--delaunay: points expected (a mesh, .csv, .txt, .xyz or .node; the file of "
          "a surface found)");
    return Source::points;
  }
  if (options.cells) {
    if (surface || formats::is_point_file(options.input))
      throw UsageError("--cells: a zoo mesh expected");
    return Source::cells;
  }
  if (formats::may_hold_surface(options.input)) return Source::surface;
  throw UsageError(formats::is_point_file(options.input)
                       ? "a file of points is tetrahedralized with --delaunay"
                       : "what is to be done with a mesh: --cells (cut its cells) or --delaunay "
                         "(of its nodes)?");
}

void require_fitting_options(const Options& options, Source source) {
  const SurfaceOptions& s = options.surface;
  if (source != Source::surface && (s.meshing.quality || s.meshing.max_volume ||
                                    s.meshing.preserve_surface || s.weld || !s.holes.empty()))
    throw UsageError(
        "--quality, --max-volume, --preserve-surface, --weld, --hole: only for surfaces");
  if (source != Source::cells && (options.subdivision.linearize || options.subdivision.levels > 0))
    throw UsageError("--linearize, --levels: only with --cells");
  if (options.subdivision.levels > 0 && !options.subdivision.linearize)
    throw UsageError("--levels: only with --linearize");
}

// Points ------------------------------------------------------------------------------------------

// Points that lie nearly in planes give tetrahedra of nearly no volume.
void warn_of_flat(Tool& tool, const std::vector<std::array<double, 3>>& points,
                  const std::vector<std::array<std::uint32_t, 4>>& tetrahedra) {
  constexpr double kFlat = 1e-12;  // of the cube of the longest edge; of a regular one it is 0.118
  const auto is_flat = [&](const std::array<std::uint32_t, 4>& t) {
    std::array<std::array<double, 3>, 3> edges{};
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c) edges[k][c] = points[t[k + 1]][c] - points[t[0]][c];
    for (const auto& a : t)
      for (const auto& b : t)
        longest =
            std::max(longest, std::hypot(points[a][0] - points[b][0], points[a][1] - points[b][1],
                                         points[a][2] - points[b][2]));
    const auto& [u, v, w] = edges;
    const double six = u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                       u[2] * (v[0] * w[1] - v[1] * w[0]);
    return std::abs(six) / 6 < kFlat * longest * longest * longest;
  };
  if (const auto flat = std::ranges::count_if(tetrahedra, is_flat); flat > 0)
    tool.warn(
        fmt::format("{} of {} tetrahedra are nearly flat (volume below {:g} of the cube of the "
                    "longest edge): points lie in one plane but for rounding",
                    flat, tetrahedra.size(), kFlat));
}

ZooFile mesh_of_points(Tool& tool, const Options& options) {
  ZooMesh mesh = tool.timed("read", [&] {
    return formats::is_point_file(options.input) ? formats::read_points(options.input)
                                                 : read_mesh(options.input).mesh;
  });
  std::vector<std::array<double, 3>> points(mesh.node_count());
  for (NodeId node = 0; node < points.size(); ++node)
    std::ranges::copy(mesh.position(node), points[node].begin());
  const auto tetrahedra = tool.timed("mesh", [&] { return delaunay_tetrahedra(points); });
  warn_of_flat(tool, points, tetrahedra);
  if (tetrahedra.empty())
    throw JudgementError(fmt::format("{}: its {} points lie in one plane (four in space expected)",
                                     input_name(options.input), points.size()));
  std::vector<NodeId> nodes;
  std::vector<std::uint64_t> elems{0};
  for (const auto& corners : tetrahedra) {
    nodes.insert(nodes.end(), corners.begin(), corners.end());
    elems.push_back(nodes.size());
  }
  std::vector<std::uint8_t> used(points.size(), 0);
  for (const NodeId node : nodes) used[node] = 1;
  if (const auto unused = std::ranges::count(used, 0); unused > 0)
    tool.warn(fmt::format("{} points lie at the place of another point; their values are not used",
                          unused));
  const std::size_t fields = mesh.fields.size();
  std::erase_if(mesh.fields, [](const Field& f) { return f.location != FieldLocation::node; });
  if (mesh.fields.size() < fields)
    tool.warn(fmt::format("{} fields on cells or corners are left out: points have no cells",
                          fields - mesh.fields.size()));
  mesh.kinds = std::vector<CellKind>(tetrahedra.size(), CellKind::tetrahedron4);
  mesh.nodes = std::move(nodes);
  mesh.elems = std::move(elems);
  mesh.adjacency.reset();
  return {std::move(mesh), {}};
}

// Cells -------------------------------------------------------------------------------------------

// Tetrahedra that turn otherwise than most, or not at all: cells that are not convex, or turned.
void tell_of_orientations(Tool& tool, const ZooMesh& mesh) {
  std::uint64_t positive = 0, negative = 0, flat = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell_nodes(cell);
    const auto at = [&](std::size_t k) { return mesh.position(nodes[k]); };
    const int turn = orientation(at(0), at(1), at(2), at(3));
    ++(turn > 0 ? positive : turn < 0 ? negative : flat);
  }
  if (flat > 0) tool.warn(fmt::format("{} tetrahedra are flat", flat));
  if (const std::uint64_t odd = std::min(positive, negative); odd > 0)
    tool.warn(
        fmt::format("{} tetrahedra are inverted relative to the other {}: their cells are not "
                    "convex, or are turned inside out (hiac-check names them)",
                    odd, std::max(positive, negative)));
}

ZooFile mesh_of_cells(Tool& tool, const Options& options) {
  const ZooFile file = tool.timed("read", [&] { return read_any_mesh(tool, {options.input, {}}); });
  SubdividedMesh parts =
      tool.timed("mesh", [&] { return subdivide_cells(file.mesh, options.subdivision); });
  tool.note(fmt::format("{} cells became {} tetrahedra; {} nodes are new, {} no longer needed",
                        file.mesh.cell_count(), parts.mesh.cell_count(), parts.new_nodes,
                        parts.dropped_nodes));
  if (parts.dropped_tetrahedra > 0)
    tool.note(fmt::format("{} flat tetrahedra were left out", parts.dropped_tetrahedra));
  tell_of_orientations(tool, parts.mesh);
  return {std::move(parts.mesh), {}};
}

void tetrahedralize(Tool& tool, const Options& options) {
  tool.claim({{options.input}, {{"-o", options.output, FileKind::mesh}}});
  require_binary_output(options.output);
  const Source source = source_of(options);
  require_fitting_options(options, source);
  ZooFile file = source == Source::surface  ? mesh_of_surface(tool, options.input, options.surface)
                 : source == Source::points ? mesh_of_points(tool, options)
                                            : mesh_of_cells(tool, options);
  if (source == Source::surface) file.mesh.metadata.emplace_back("source", options.input);
  tool.facts()["cells"] = file.mesh.cell_count();
  tool.facts()["nodes"] = file.mesh.node_count();
  tool.note(fmt::format("{} tetrahedra, {} nodes", file.mesh.cell_count(), file.mesh.node_count()));
  tool.timed("write", [&] { write_mesh(options.output, file); });
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool(
      "hiac-tetrahedralize",
      "Makes tetrahedra inside a closed surface, between points, or from the cells of a mesh.",
      "  hiac-tetrahedralize part.stl --quality 1.4 --max-volume 0.01 -o part.zoo\n"
      "  hiac-tetrahedralize measured.csv --delaunay -o measured.zoo   # x y z and fields\n"
      "  hiac-convert part.vtu | hiac-tetrahedralize --cells | hiac-render --view v.toml -o "
      "part.exr\n"
      "  hiac-tetrahedralize quadratic.zoo --cells --linearize --levels 2 -o linear.zoo");
  tool.app().set_version_flag("--version", fmt::format("hiac-tetrahedralize {}, {}", version_text(),
                                                       meshing_library_versions()));
  Options options;
  auto& app = tool.app();
  app.add_option("INPUT", options.input,
                 "Closed surface (.stl .ply .obj .off .vtp .vtu, TetGen's .poly .smesh), points "
                 "(.csv .txt .xyz .node) or zoo mesh; - or none: a zoo mesh from stdin");
  app.add_option("-o,--output", options.output, "Zoo mesh; - or none: stdout")->type_name("FILE");
  auto* cells = app.add_flag("--cells", options.cells,
                             "Cut a mesh's cells into conforming tetrahedra; quadratic and cubic "
                             "cells become 10- and 20-node tetrahedra");
  app.add_flag("--delaunay", options.delaunay,
               "Make the Delaunay tetrahedra of points, or of a mesh's nodes, with their fields")
      ->excludes(cells);
  app.add_flag("--linearize", options.subdivision.linearize,
               "With --cells: make linear tetrahedra from cells of every order");
  app.add_option("--levels", options.subdivision.levels,
                 "With --linearize: halve all edges N times first (8^N times the tetrahedra)")
      ->check(CLI::Range(0U, kMostSubdivisionLevels))
      ->type_name("N");
  app.add_option("--quality", options.surface.meshing.quality,
                 "Surfaces: largest ratio of circumradius to shortest edge (usually 1.1 to 2)")
      ->check(CLI::Range(1.0, 1e6))
      ->type_name("RATIO");
  app.add_option("--max-volume", options.surface.meshing.max_volume,
                 "Surfaces: largest volume of a tetrahedron")
      ->check(CLI::PositiveNumber)
      ->type_name("V");
  app.add_flag("--preserve-surface", options.surface.meshing.preserve_surface,
               "Surfaces: put no new points on the surface");
  app.add_option(
         "--weld", options.surface.weld,
         "Surfaces: join points that are at most TOL apart, in the units of the file (0: at "
         "the same place)")
      ->check(CLI::NonNegativeNumber)
      ->type_name("TOL");
  app.add_option("--hole", options.surface.holes,
                 "Surfaces: leave the enclosed part around this point empty; repeatable")
      ->type_name("X,Y,Z")
      ->allow_extra_args(false);
  app.add_option("--max-ids", options.surface.max_ids,
                 "How many surface defects of each kind to list")
      ->default_val(20)
      ->type_name("N");
  return tool.run(argc, argv, [&] { tetrahedralize(tool, options); });
}

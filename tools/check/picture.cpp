#include "tools/check/picture.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "hiac/frame/surfaces/boundary_faces.hpp"
#include "hiac/image/composite.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/render/supersampling.hpp"
#include "hiac/session/starter/starter_camera.hpp"

namespace hiac::tools {
namespace {

// Rays a pixel are the square of it: skin is as smooth as their number, edges always are.
constexpr std::uint32_t kSamples = 2;
constexpr Vector kTowardsEye{0.55, -0.75, 0.45};
// The share of an offending cell's pixel that is the cell: the model's edges show through it.
constexpr double kSolid = 0.85;

constexpr Color kGlass{0.25, 0.4, 0.6}, kLine{0.02, 0.03, 0.05};
constexpr Color kInvalid{0.85, 0.02, 0.02}, kWarning{0.95, 0.4, 0.03};
constexpr double kGlassOpacity = 0.3;
// Degrees by which the boundary bends at an edge that is drawn.
constexpr double kBend = 20;

// The cells that make the mesh invalid; where none does, those that warnings are about. (Most real
// bricks have faces that are not planar: they would hide the cells that matter.)
std::set<CellId> offending_cells(const std::vector<Finding>& findings, Severity severity) {
  std::set<CellId> cells;
  for (const Finding& finding : findings) {
    const DefectDescription& description = description_of(finding.defect);
    if (description.severity != severity || description.offence == Offence::node) continue;
    for (const Offender& offender : finding.offenders) {
      cells.insert(static_cast<CellId>(offender.id));
      if (description.offence == Offence::cell_pair)
        cells.insert(static_cast<CellId>(offender.other));
    }
  }
  return cells;
}

// Some of a mesh's cells, by their corners alone.
ZooMesh corners_of(const ZooMesh& mesh, const std::set<CellId>& cells) {
  std::vector<std::uint64_t> elems{0};
  std::vector<NodeId> nodes;
  std::vector<CellKind> kinds;
  for (const CellId cell : cells) {
    const CellKind kind = mesh.kinds[cell];
    const auto corners = mesh.cell_nodes(cell).first(corner_count(kind));
    nodes.insert(nodes.end(), corners.begin(), corners.end());
    elems.push_back(nodes.size());
    kinds.push_back(kind_of(shape_of(kind), CellOrder::linear));
  }
  ZooMesh result;
  result.xyz = mesh.xyz;  // shared
  result.elems = std::move(elems);
  result.nodes = std::move(nodes);
  result.kinds = std::move(kinds);
  return result;
}

// The cells with faces on the boundary as one group, which the engine sorts along every ray: the
// others are not seen.
VisibilityOrder group_of_boundary(const ZooMesh& mesh) {
  const std::vector<std::uint8_t> faces = boundary_faces(mesh);
  std::vector<CellId> cells;
  for (CellId cell = 0; cell < faces.size(); ++cell)
    if (faces[cell] != 0) cells.push_back(cell);
  VisibilityOrder order;
  const auto count = static_cast<std::uint32_t>(cells.size());
  order.cells = std::move(cells);
  if (count > 1) order.groups = std::vector<CellGroup>{{0, count}};
  return order;
}

Image draw(Tool& tool, const ZooMesh& mesh, const Scene& scene, bool with_background) {
  const bool fits = std::max(scene.image.width, scene.image.height) <= kMaxImageSide / kSamples;
  return render_supersampled(mesh, group_of_boundary(mesh), scene, whole_picture(scene.image),
                             {fits ? kSamples : 1, SampleFilter::box}, with_background,
                             &tool.progress())
      .image;
}

Scene scene_around(const ZooMesh& mesh, ImageSize size) {
  Scene scene;
  scene.image = size;
  scene.camera = starter::camera_around(starter::Sight(mesh), size, kTowardsEye);
  scene.background.color = {1, 1, 1};
  return scene;
}

Image draw_outline(Tool& tool, const ZooMesh& mesh, const FaceAdjacency& adjacency, Scene scene) {
  Skin& skin = scene.skin.emplace();
  skin.color = kGlass;
  skin.opacity = kGlassOpacity;
  Edges& edges = scene.edges.emplace();
  edges.angle = kBend;
  edges.color = kLine;
  ZooMesh outline = mesh;  // its arrays are shared
  outline.fields.clear();
  outline.adjacency = adjacency;
  return draw(tool, outline, scene, true);
}

// Of a colour, with its edges in a darker one.
Image draw_cells(Tool& tool, const ZooMesh& cells, const Color& color, Scene scene) {
  scene.skin.emplace().color = color;
  Edges& edges = scene.edges.emplace();
  edges.show = EdgeChoice::all;
  for (std::size_t c = 0; c < 3; ++c) edges.color[c] = 0.5 * color[c];
  Image image = draw(tool, cells, scene, false);
  for (double& value : image.values()) value *= kSolid;
  return image;
}

}  // namespace

void write_defect_picture(Tool& tool, const ZooMesh& mesh, const FaceAdjacency& adjacency,
                          const std::vector<Finding>& findings, ImageSize size,
                          const std::string& path) {
  if (!starter::has_extent(mesh)) {
    tool.warn("no picture: all nodes of cells lie at one point");
    return;
  }
  const Scene scene = scene_around(mesh, size);
  Image image =
      tool.timed("picture_outline", [&] { return draw_outline(tool, mesh, adjacency, scene); });
  const bool invalid = any_invalid(findings);
  const auto cells = offending_cells(findings, invalid ? Severity::invalid : Severity::warning);
  if (!cells.empty())
    image = tool.timed("picture_cells", [&] {
      Image front = draw_cells(tool, corners_of(mesh, cells), invalid ? kInvalid : kWarning, scene);
      composite_over(front, image);
      return front;
    });
  write_image(path, image);
}

}  // namespace hiac::tools

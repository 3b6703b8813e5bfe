#include "tools/check/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "hiac/geometry/box.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/order/published/centroid.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/scene/view_of.hpp"

namespace hiac::tools {
namespace {

// What is drawn: the values of the picture's only field.
enum class Paint : std::uint8_t { skin, edge, warning, invalid };

// Parts of the model's size.
constexpr double kSkin = 1e-3, kThread = 1.2e-3;
// A bend of the boundary by more than this is an edge: 20 degrees.
constexpr double kBend = 0.94;
// Edges of so many offending cells are drawn; of more, the cells alone.
constexpr std::size_t kMostFramed = 4000;
// So many offending cells are sorted exactly; more by their middles. Tangled cells overlap, so that
// there is no right order of them, and it would take minutes to find that out.
constexpr std::size_t kMostExact = 1000;

Vector moved(const Vector& p, double by, const Vector& along) {
  return {p[0] + by * along[0], p[1] + by * along[1], p[2] + by * along[2]};
}

// A mesh of tetrahedra, each painted.
class Drawing {
 public:
  explicit Drawing(double size) : size_(size) {}

  // Tetrahedra of common corners: each of four numbers among them. Neighbours share nodes, so that
  // only the outer faces are compared with those of other parts when the drawing is sorted.
  void add(std::span<const Vector> corners, std::span<const std::array<std::uint8_t, 4>> cells,
           Paint paint) {
    const auto first = static_cast<NodeId>(xyz_.size() / 3);
    for (const Vector& p : corners) xyz_.insert(xyz_.end(), p.begin(), p.end());
    for (const auto& cell : cells) {
      for (const std::uint8_t corner : cell) nodes_.push_back(first + corner);
      paints_.push_back(static_cast<double>(paint));
    }
  }

  // Between two triangles, corner to corner.
  void add_prism(const std::array<Vector, 3>& a, const std::array<Vector, 3>& b, Paint paint) {
    constexpr std::array<std::array<std::uint8_t, 4>, 3> kCells{
        {{0, 1, 2, 5}, {0, 1, 4, 5}, {0, 3, 4, 5}}};
    add(std::array{a[0], a[1], a[2], b[0], b[1], b[2]}, kCells, paint);
  }

  void add_skin(const Vector& a, const Vector& b, const Vector& c) {
    const Vector normal = cross(minus(b, a), minus(c, a));
    if (!(length(normal) > 0)) return;
    const Vector out = unit(normal);
    const double by = kSkin * size_;
    add_prism({a, b, c}, {moved(a, by, out), moved(b, by, out), moved(c, by, out)}, Paint::skin);
  }

  // A thread of three sides around an edge.
  void add_thread(const Vector& a, const Vector& b, Paint paint) {
    const Vector along = minus(b, a);
    if (!(length(along) > 0)) return;
    const Vector other =
        std::abs(along[2]) < 0.9 * length(along) ? Vector{0, 0, 1} : Vector{1, 0, 0};
    const Vector u = unit(cross(along, other)), v = unit(cross(along, u));
    std::array<Vector, 3> from, to;
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = 2.0943951023931953 * static_cast<double>(k);
      for (std::size_t c = 0; c < 3; ++c) {
        const double off = kThread * size_ * (std::cos(angle) * u[c] + std::sin(angle) * v[c]);
        from[k][c] = a[c] + off;
        to[k][c] = b[c] + off;
      }
    }
    add_prism(from, to, paint);
  }

  [[nodiscard]] ZooMesh mesh() && {
    ZooMesh mesh;
    std::vector<std::uint64_t> elems(paints_.size() + 1);
    for (std::size_t i = 0; i < elems.size(); ++i) elems[i] = 4 * i;
    mesh.kinds = std::vector<CellKind>(paints_.size(), CellKind::tetrahedron4);
    mesh.elems = std::move(elems);
    mesh.nodes = std::move(nodes_);
    mesh.xyz = std::move(xyz_);
    mesh.fields.push_back({"paint", "", FieldLocation::cell, 1, std::move(paints_)});
    return mesh;
  }

 private:
  double size_;
  std::vector<NodeId> nodes_;
  std::vector<double> xyz_, paints_;
};

struct Ball {
  Vector centre;
  double radius;
};

Ball ball_around(const ZooMesh& mesh) {
  const Box box = box_of_cells(mesh);
  Ball ball{};
  for (std::size_t c = 0; c < 3; ++c) ball.centre[c] = 0.5 * box.low[c] + 0.5 * box.high[c];
  ball.radius = length(minus(box.high, ball.centre));
  return ball;
}

Vector position(const ZooMesh& mesh, NodeId node) {
  const auto p = mesh.position(node);
  return {p[0], p[1], p[2]};
}

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

void add_cell(const ZooMesh& mesh, CellId cell, Paint paint, bool framed, Drawing& drawing) {
  const auto nodes = mesh.cell_nodes(cell);
  const ShapeTopology& shape = topology_of(mesh.kinds[cell]);
  const auto at = [&](std::size_t k) { return position(mesh, nodes[k]); };
  std::vector<Vector> corners;
  for (std::size_t k = 0; k < shape.corner_count; ++k) corners.push_back(at(k));
  std::vector<std::array<std::uint8_t, 4>> cells{{0, 1, 2, 3}};
  if (shape.corner_count > 4) {  // from the faces to the middle
    Vector middle{};
    for (const Vector& p : corners)
      middle = moved(middle, 1 / static_cast<double>(shape.corner_count), p);
    const auto last = static_cast<std::uint8_t>(corners.size());
    corners.push_back(middle);
    cells.clear();
    for (const ShapeFace& face : shape.faces)
      for (std::size_t k = 2; k < face.corner_count; ++k)
        cells.push_back({face.corners[0], face.corners[k - 1], face.corners[k], last});
  }
  drawing.add(corners, cells, paint);
  if (!framed) return;
  for (const auto& [from, to] : shape.edges) drawing.add_thread(at(from), at(to), paint);
}

// The mean normal of a face, pointing away from its cell's middle by the cell's numbering.
Vector normal_of(const ZooMesh& mesh, std::span<const NodeId> corners) {
  const std::size_t n = corners.size();
  return cross(minus(mesh.position(corners[2]), mesh.position(corners[0])),
               minus(mesh.position(corners[n - 1]), mesh.position(corners[1])));
}

// The free faces as a skin, and the edges between them that bend, or that not just two faces have.
void add_boundary(const ZooMesh& mesh, const FaceAdjacency& adjacency, Drawing& drawing) {
  struct Edge {
    Vector normal;
    int faces = 0;
    bool bends = false;
  };
  std::map<std::pair<NodeId, NodeId>, Edge> edges;
  std::size_t slot = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell_nodes(cell);
    for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces) {
      if (adjacency.neighbors[slot++] != kNoCell) continue;
      std::array<NodeId, 4> corners{};
      for (std::size_t k = 0; k < face.corner_count; ++k) corners[k] = nodes[face.corners[k]];
      const auto around = std::span(corners).first(face.corner_count);
      for (std::size_t k = 2; k < around.size(); ++k)
        drawing.add_skin(position(mesh, around[0]), position(mesh, around[k - 1]),
                         position(mesh, around[k]));
      const Vector normal = normal_of(mesh, around);
      for (std::size_t k = 0; k < around.size(); ++k) {
        const NodeId a = around[k], b = around[(k + 1) % around.size()];
        Edge& edge = edges[{std::min(a, b), std::max(a, b)}];
        edge.bends =
            edge.bends || (edge.faces > 0 &&
                           dot(edge.normal, normal) < kBend * length(edge.normal) * length(normal));
        edge.normal = normal;
        ++edge.faces;
      }
    }
  }
  for (const auto& [ends, edge] : edges)
    if (edge.bends || edge.faces != 2)
      drawing.add_thread(position(mesh, ends.first), position(mesh, ends.second), Paint::edge);
}

// How far the eye has to be from the centre for all nodes to be in the picture, with a margin.
double distance_for(const ZooMesh& drawn, const Vector& centre, const Vector& towards_eye,
                    const Vector& up, double tangent_of_half, double aspect) {
  const Vector right = unit(cross(up, towards_eye)), upright = cross(towards_eye, right);
  const double rise = 0.95 * tangent_of_half;
  double distance = 0;
  for (NodeId node = 0; node < drawn.node_count(); ++node) {
    const Vector p = minus(position(drawn, node), centre);
    const double aside = std::max(std::abs(dot(p, right)) / aspect, std::abs(dot(p, upright)));
    distance = std::max(distance, dot(p, towards_eye) + aside / rise);
  }
  return distance;
}

Scene scene_around(const Ball& ball, const ZooMesh& drawn, ImageSize size) {
  const Vector towards_eye = unit(Vector{0.55, -0.75, 0.45});
  constexpr double kFov = 30, kTangentOfHalf = 0.2679491924311227;
  Scene scene;
  scene.image = size;
  scene.camera.look_at = ball.centre;
  scene.camera.up = {0, 0, 1};
  scene.camera.fov = kFov;
  scene.camera.eye =
      moved(ball.centre,
            distance_for(drawn, ball.centre, towards_eye, scene.camera.up, kTangentOfHalf,
                         static_cast<double>(size.width) / size.height),
            towards_eye);
  const double skin = 0.12 / (kSkin * ball.radius), solid = 4 / (kThread * ball.radius);
  scene.volume.color = ColorTransfer{"paint",
                                     {{0, {0.05, 0.12, 0.25}},
                                      {1, {0.01, 0.02, 0.04}},
                                      {2, {0.9, 0.35, 0.02}},
                                      {3, {0.8, 0.01, 0.01}}}};
  scene.volume.extinction = ExtinctionTransfer{
      "paint", {{0, {skin}}, {1, {solid}}, {2, {0.1 * solid}}, {3, {0.1 * solid}}}};
  scene.background.color = {1, 1, 1};
  return scene;
}

VisibilityOrder order_of(const ZooMesh& drawn, const Scene& scene, bool exact) {
  const View view = view_of(scene.camera);
  if (!exact) return centroid_order(drawn, view);
  return exact_order(drawn, build_face_adjacency(drawn), view, scene.render.planarity).order;
}

}  // namespace

void write_defect_picture(Tool& tool, const ZooMesh& mesh, const FaceAdjacency& adjacency,
                          const std::vector<Finding>& findings, ImageSize size,
                          const std::string& path) {
  const Ball ball = ball_around(mesh);
  Drawing drawing(ball.radius);
  const bool invalid = any_invalid(findings);
  const auto cells = offending_cells(findings, invalid ? Severity::invalid : Severity::warning);
  for (const CellId cell : cells)
    add_cell(mesh, cell, invalid ? Paint::invalid : Paint::warning, cells.size() <= kMostFramed,
             drawing);
  add_boundary(mesh, adjacency, drawing);
  const ZooMesh drawn = std::move(drawing).mesh();
  const Scene scene = scene_around(ball, drawn, size);
  const VisibilityOrder order = tool.timed(
      "picture_order", [&] { return order_of(drawn, scene, cells.size() <= kMostExact); });
  const RenderResult result = tool.timed(
      "picture_render", [&] { return render(drawn, order, scene, true, &tool.progress()); });
  write_image(path, result.image);
}

}  // namespace hiac::tools

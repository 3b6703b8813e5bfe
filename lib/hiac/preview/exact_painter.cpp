#include "hiac/preview/exact_painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "hiac/base/parallel.hpp"
#include "hiac/element/face_interpolant.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac::preview {
namespace {

// Cells whose records are made, and drawn, at a time: more only costs memory.
constexpr std::size_t kMostCells = std::size_t{1} << 16;
constexpr std::size_t kOutlineBytes = 8 * sizeof(float);  // of a cell
constexpr GLuint kGroup = 64;                             // invocations, as the compute shader says

struct DeviceNode {
  double x, y, depth;
  double projected;  // 1; 0: the other three are its camera coordinates
};

VertexArrayName empty_layout(GLuint indices) {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  glVertexArrayElementBuffer(name, indices);
  return VertexArrayName(name);
}

double finite(double t) { return std::clamp(t, -1e300, 1e300); }

GLint place_of(const ProgramName& program, const char* uniform) {
  return glGetUniformLocation(program.get(), uniform);
}

void require_room(const Context& context, std::size_t bytes, const char* what) {
  if (bytes > context.limits().storage_block_bytes)
    throw DriverError(
        fmt::format("{}: {} need {} bytes in one buffer, and the driver has {} at "
                    "most",
                    context.device().name, what, bytes, context.limits().storage_block_bytes));
}

std::vector<DeviceNode> device_nodes(const ZooMesh& mesh, const Projector& projector) {
  std::vector<DeviceNode> nodes(mesh.node_count());
  parallel_for(nodes.size(), std::size_t{1} << 12, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto position = mesh.position(static_cast<NodeId>(i));
      ProjectedNode node;
      if (projector.project(position, node)) {
        nodes[i] = {node.x, node.y, node.depth, 1};
      } else {
        const auto [right, up, forward] = projector.camera_coordinates(position);
        nodes[i] = {right, up, forward, 0};
      }
    }
  });
  return nodes;
}

}  // namespace

ExactPainter::ExactPainter(const Context& context, const ZooMesh& mesh, const DrawnScene& scene,
                           bool fine)
    : context_(context), mesh_(mesh), scene_(scene), layout_(empty_layout(indices_.get())) {
  variant_.surface_fields = scene.surface_fields.size();
  // which cell an isosurface at a face belongs to is decided alike in both
  variant_.fine = fine || variant_.surface_fields > 0;
  variant_.fields = scene.fields.size();
  GLint components = 0;
  glGetIntegerv(GL_MAX_FRAGMENT_INPUT_COMPONENTS, &components);
  variant_.stored = 4 * variant_.record() > static_cast<std::size_t>(components);
  std::vector<double> values;
  for (const DrawnField& field : scene.fields) {
    field_layouts_.push_back(static_cast<std::uint32_t>(values.size()));
    field_layouts_.push_back(static_cast<std::uint32_t>(field.location));
    values.insert(values.end(), field.values.begin(), field.values.end());
  }
  require_room(context, values.size() * sizeof(double), "the fields");
  require_room(context, mesh.node_count() * sizeof(DeviceNode), "the nodes");
  values_.set(std::span<const double>(values));
  const std::vector<DeviceSurface> surfaces = device_surfaces(scene);
  require_room(context, surfaces.size() * sizeof(DeviceSurface), "the isosurfaces");
  surfaces_.set(std::span<const DeviceSurface>(surfaces));
  const std::size_t record = variant_.record() * 4 * sizeof(float);
  // The buffer holds one record more: the last cell's other vertices read what follows its record.
  const std::size_t most =
      std::max<std::size_t>(context.limits().storage_block_bytes / record, 2) - 1;
  chunk_ = std::clamp<std::size_t>(mesh.cell_count(), 1, std::min(kMostCells, most));
  records_.reserve((chunk_ + 1) * record);
  outlines_.reserve(chunk_ * kOutlineBytes);
  set_layout(record);
  std::vector<std::uint32_t> indices;
  for (std::uint32_t cell = 0; cell < chunk_; ++cell)
    for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) indices.push_back(4 * cell + k);
  indices_.set(std::span<const std::uint32_t>(indices));
  upload_tables();
  context.check("copying the mesh to the device");
}

// Each vertex advances by a quarter of a record, so that a cell's first vertex reads all of its
// record.
void ExactPainter::set_layout(std::size_t record_bytes) {
  glVertexArrayVertexBuffer(layout_.get(), 0, outlines_.get(), 0, kOutlineBytes / 4);
  glVertexArrayVertexBuffer(layout_.get(), 1, records_.get(), 0,
                            static_cast<GLsizei>(record_bytes / 4));
  add_attribute(layout_, 0, 0, 2, 0);
  for (std::size_t k = 0; !variant_.stored && k < variant_.attributes(); ++k)
    add_attribute(layout_, 1 + k, 1, 4, 4 * k);
}

void ExactPainter::upload_tables() {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  for (const std::vector<float>& texels : transfer_texels(scene_)) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
    table_textures_.emplace_back(name);
    tables_.emplace_back();
    if (texels.empty()) continue;
    if (texels.size() / 4 > static_cast<std::size_t>(most))
      throw DriverError(
          fmt::format("{}: a transfer function needs {} texels, and the driver has {} "
                      "at most",
                      context_.device().name, texels.size() / 4, most));
    tables_.back().set(std::span<const float>(texels));
    glTextureBuffer(name, GL_RGBA32F, tables_.back().get());
  }
}

void ExactPainter::compile() {
  if (compiled_ == variant_) return;
  setup_ = compute_program(exact_setup_source(variant_, scene_));
  program_ = draw_program(exact_vertex_source(variant_), exact_fragment_source(variant_, scene_));
  compiled_ = variant_;
}

void ExactPainter::set_view(const Projector& projector) {
  const std::vector<DeviceNode> nodes = device_nodes(mesh_, projector);
  nodes_.set(std::span<const DeviceNode>(nodes));
  variant_.perspective = projector.perspective();
  variant_.near =
      std::ranges::any_of(nodes, [](const DeviceNode& node) { return node.projected == 0; });
  const double nearest = variant_.perspective ? 0.0 : -HUGE_VAL;
  variant_.clipped = projector.near() > nearest || projector.far() < HUGE_VAL;
  compile();
  const Projector::Axes axes = projector.axes();
  const double scale = projector.pixels_per_unit();
  glProgramUniform3d(setup_.get(), place_of(setup_, "center"), axes.center_x, axes.center_y, scale);
  glProgramUniform2d(setup_.get(), place_of(setup_, "slab"), finite(projector.near()),
                     finite(projector.far()));
  glProgramUniform2uiv(setup_.get(), place_of(setup_, "layouts"),
                       static_cast<GLsizei>(variant_.fields), field_layouts_.data());
  rays_ = {axes.center_x, axes.center_y, 1 / scale};
  std::vector<double> lights;
  for (const Light& light : scene_.lights) {
    std::array<double, 3> direction{};
    if (light.direction) direction = projector.camera_vector(unit(*light.direction));
    lights.insert(lights.end(), direction.begin(), direction.end());
  }
  if (const GLint place = place_of(program_, "lights"); place >= 0)
    glProgramUniform3dv(program_.get(), place, static_cast<GLsizei>(scene_.lights.size()),
                        lights.data());
  context_.check("setting the view");
}

void ExactPainter::set_part(const PixelRect& part) {
  glProgramUniform4i(setup_.get(), place_of(setup_, "part"), static_cast<GLint>(part.x),
                     static_cast<GLint>(part.y), static_cast<GLint>(part.width),
                     static_cast<GLint>(part.height));
  glProgramUniform2f(program_.get(), place_of(program_, "scale"),
                     2 / static_cast<float>(part.width), 2 / static_cast<float>(part.height));
  glProgramUniform3f(program_.get(), place_of(program_, "rays"),
                     static_cast<float>(rays_[0] - part.x), static_cast<float>(rays_[1] - part.y),
                     static_cast<float>(rays_[2]));
}

void ExactPainter::draw(const PixelRect& part, std::span<const CellId> back_to_front) {
  set_part(part);
  for (GLuint unit = 0; unit < table_textures_.size(); ++unit)
    if (tables_[unit].bytes() > 0) glBindTextureUnit(unit, table_textures_[unit].get());
  glBindVertexArray(layout_.get());
  glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  for (std::size_t first = 0; first < back_to_front.size(); first += chunk_)
    draw_chunk(back_to_front.subspan(first, std::min(chunk_, back_to_front.size() - first)));
  context_.check("drawing cells");
}

// A bit for every face that a surface is closed at: of a field's surfaces, the face without corner
// k. Surfaces of one value are closed at the same faces, those of others lie in none of these.
void ExactPainter::set_closed_faces(std::span<const CellId> cells) {
  const std::size_t words = closed_words(scene_);
  std::vector<std::uint32_t> closed(words * cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (const IsosurfaceCut& cut : scene_.isosurfaces.in(cells[i])) {
      const std::size_t f = scene_.surface_field_of[cut.surface];
      for (std::uint32_t k = 0; cut.closed_faces != 0 && k < 4; ++k)
        if ((cut.closed_faces & (1U << tetrahedron_face_without(k))) != 0)
          closed[words * i + f / 8] |= 1U << (4 * (f % 8) + k);
    }
  closed_.set(std::span<const std::uint32_t>(closed));
}

void ExactPainter::draw_chunk(std::span<const CellId> cells) {
  chunk_corners_.resize(4 * cells.size());
  parallel_for(cells.size(), std::size_t{1} << 12, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      std::ranges::copy(mesh_.cell_nodes(cells[i]), &chunk_corners_[4 * i]);
  });
  corners_.set(std::span<const NodeId>(chunk_corners_));
  numbers_.set(cells);
  if (variant_.surface_fields > 0) set_closed_faces(cells);
  const std::array<GLuint, 8> buffers{nodes_.get(),    corners_.get(), numbers_.get(),
                                      values_.get(),   records_.get(), closed_.get(),
                                      surfaces_.get(), outlines_.get()};
  for (GLuint k = 0; k < buffers.size(); ++k)
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, k, buffers[k]);
  const auto count = static_cast<GLuint>(cells.size());
  glProgramUniform1ui(setup_.get(), place_of(setup_, "cell_count"), count);
  glUseProgram(setup_.get());
  glDispatchCompute((count + kGroup - 1) / kGroup, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
  glUseProgram(program_.get());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * count), GL_UNSIGNED_INT, nullptr);
}

}  // namespace hiac::preview

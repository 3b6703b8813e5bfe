#include "hiac/frame/frame.hpp"

#include <string>

#include "hiac/frame/frame_constants.hpp"

namespace hiac {
namespace {

// Without the intervals of a transfer function.
FrameField frame_field(const ZooMesh& mesh, const std::string& name, bool polynomial) {
  Field field = scalar_field(mesh, name);
  return {{field.values, field.location, polynomial}, {}};
}

FrameField zero_field(const ZooMesh& mesh) {
  return {{std::vector<double>(mesh.cell_count(), 0.0), FieldLocation::cell, false}, {}};
}

}  // namespace

Frame::Frame(const ZooMesh& of_mesh, const Scene& scene, const Projector& of_scene, Details details,
             Kernels kernels)
    : mesh(of_mesh),
      projector(of_scene),
      nodes(project_nodes(mesh, projector)),
      kernel_cells(kernels == Kernels::none
                       ? std::vector<CellKernel>{}
                       : hiac::kernel_cells(mesh, nodes, scene.render.planarity)),
      isosurfaces(make_isosurfaces(mesh, scene, projector)),
      skin(make_skin(mesh, scene, projector)),
      with_details(details != Details::none),
      with_error(details == Details::bounded),
      tolerance(scene.render.tolerance),
      straightness(scene.render.planarity) {
  const bool polynomial = scene.render.interpolation == Interpolation::polynomial;
  const auto& of_color = scene.volume.color;
  const auto& of_extinction = scene.volume.extinction;
  if (of_extinction)
    extinction = frame_field(mesh, of_extinction->field, polynomial);
  else if (of_color)
    extinction = frame_field(mesh, of_color->field, polynomial);
  else
    extinction = zero_field(mesh);
  optics = make_optics_tables(scene.volume, scene.render.integration);  // says which field is whose
  if (!optics.same_field) color = frame_field(mesh, of_color->field, polynomial);
  if (with_error) skin.sides = skin_sides(mesh, skin.faces);
  set_constants(*this, scene, extremes_of(*this));
}

}  // namespace hiac

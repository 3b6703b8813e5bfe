#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hiac/frame/surfaces/isosurfaces.hpp"
#include "hiac/frame/transfer_table.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::preview {

/// A scalar field as shaders see it: single precision would lose what tells values apart that lie
/// far from zero, so that a value v is (v - middle) / half there, about -1 to 1 where a transfer
/// function or an isosurface tells values apart.
struct DrawnField {
  std::string name;
  FieldLocation location = FieldLocation::node;
  double middle = 0, half = 1;
  std::vector<double> values;  ///< scaled
  [[nodiscard]] double scaled(double value) const { return (value - middle) / half; }
};

/// A field that has isosurfaces.
struct SurfaceField {
  std::size_t field;                  ///< number of the field
  std::vector<std::size_t> surfaces;  ///< of the scene, by ascending value
};

/// What of a scene the shaders draw: its fields, each once, and who reads them.
struct DrawnScene {
  std::vector<DrawnField> fields;
  std::size_t extinction = 0, color = 0;  ///< numbers of fields
  std::vector<SurfaceField> surface_fields;
  std::vector<std::size_t> surface_field_of;  ///< of the scene's isosurfaces: in surface_fields
  std::vector<double> surface_values;  ///< of the scene's isosurfaces, scaled as their fields
  OpticsTables optics;                 ///< in the mesh's scalars
  Isosurfaces isosurfaces;             ///< their lights' directions depend on the view
  std::vector<Light> lights;
  [[nodiscard]] bool same_field() const { return optics.same_field; }
};

/// Throws UsageError, as scalar_field does, when a field does not exist.
DrawnScene drawn_scene(const ZooMesh& mesh, const Scene& scene);

}  // namespace hiac::preview

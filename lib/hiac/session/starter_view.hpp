#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hiac/geometry/box.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// What is asked of a first view of a mesh.
struct StarterOptions {
  /// As scalar_field accepts it, or a field of several components; empty: the one that says most.
  std::string field = {};
  std::string preset = "viridis";      ///< a colour map by name (built_in_colormaps.hpp)
  std::uint32_t isovalues = 0;         ///< so many isosurfaces, evenly over the field's range
  bool dark = false;                   ///< a dark background instead of a white one
  std::optional<ImageSize> size = {};  ///< none: 1024 x 768, flatter for long meshes
  /// The range to show, as that of a series of which the mesh is one step; none: the mesh's own.
  std::optional<std::array<double, 2>> range = {};
  /// What the camera sees beside the mesh: the box around the cells of all steps of such a series.
  std::optional<Box> box = {};
};

/// A first view of a mesh.
struct StarterView {
  /// A specification in which every key has a comment, and every section that is off stands as a
  /// comment.
  std::string text;
  Scene scene;                     ///< what the text says
  std::vector<std::string> notes;  ///< one line each: what is shown and why
};

/// Makes a first view of a mesh: all nodes of its cells, and all of `box`, are seen from a raised
/// corner.
///
/// The field is the one whose values differ most: the largest entropy of a histogram of the values
/// in cells, of magnitudes for vectors and of von Mises' equivalent stress for tensors where
/// scalar_field knows it. Whole numbers come last; constant fields, numberings of cells or nodes,
/// and fields with values that are not finite are none. Without any, the mesh is coloured by its
/// height, `position:z`. The range leaves out the lowest and the highest percent of values where
/// these would make up most of it. Without any field, an opaque skin makes the model solid, with
/// its feature edges, unless isosurfaces are asked for. Over the medium, feature edges are lines
/// one pixel wide, light on a dark background; they are left out, with a note, where they would
/// cover more than a quarter of the model.
///
/// The extinction grows from four tenths at the lower end of the range to the whole at the upper,
/// and is uniform for the height, such that the mean optical depth, measured along rays of a coarse
/// grid through the cells' corners, is 1 (0.3 between isosurfaces). Of several raised corners the
/// first is taken from which the mesh covers a quarter of these rays.
///
/// Throws InputError(subject, ...) for a mesh without cells or without extent, UsageError for a
/// field or a colour map that does not exist.
StarterView make_starter_view(const ZooMesh& mesh, const std::string& subject,
                              const StarterOptions& options = {});

}  // namespace hiac

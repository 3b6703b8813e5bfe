#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/frame_field.hpp"
#include "hiac/frame/isosurfaces.hpp"
#include "hiac/frame/kernel_cells.hpp"
#include "hiac/frame/projection.hpp"
#include "hiac/frame/transfer_table.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// What a picture says of its pixels besides their colour.
enum class Details : std::uint8_t {
  none,
  described,  ///< PixelDetails
  bounded     ///< these, with bounds of errors
};

/// Everything that does not change while one image is made. Shared by all tiles, read only.
struct Frame {
  /// The frame of a scene. `projector`: of the scene; it and the mesh must outlive the frame.
  /// Requires what check_renderable (renderable.hpp) lets pass.
  Frame(const ZooMesh& mesh, const Scene& scene, const Projector& projector,
        Details details = Details::none);
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;
  ~Frame() = default;

  const ZooMesh& mesh;
  const Projector& projector;
  std::vector<ProjectedNode> nodes;
  std::vector<CellKernel> kernel_cells;  ///< what kernel_cells() says
  OpticsTables optics;
  FrameField color, extinction;  ///< one and the same where optics.same_field
  Isosurfaces isosurfaces;
  /// Pixels with less transparency than this are finished.
  double least_transparency = 0;
  /// Segments may overlap the one before by this much of the ray parameter: rounding.
  double witness_tolerance = 0;
  bool with_details;  ///< pixels' details are asked for
  bool with_error;    ///< among them bounds of errors
  /// Of what a ray meets, seen through nothing: any channel.
  double largest_light = 0;
  double depth = 0;         ///< extent of the mesh in the ray parameter
  double tolerance = 0;     ///< absolute error allowed per pixel and channel
  double straightness = 0;  ///< edges that deviate less (edge_deviation) are taken as straight

  [[nodiscard]] const FrameField& color_field() const {
    return optics.same_field ? extinction : color;
  }
  /// has_curved_faces, which no kernel is for.
  [[nodiscard]] bool is_curved(CellId cell) const {
    return kernel_cells[cell] == CellKernel::none_curved;
  }
};

}  // namespace hiac

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/frame_field.hpp"
#include "hiac/frame/kernel_cells.hpp"
#include "hiac/frame/projection.hpp"
#include "hiac/frame/surfaces/isosurfaces.hpp"
#include "hiac/frame/surfaces/skin.hpp"
#include "hiac/frame/transfer_table.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// What a picture records about its pixels besides their colour.
enum class Details : std::uint8_t {
  none,
  described,  ///< PixelDetails
  bounded     ///< PixelDetails with error bounds
};

/// Whether cells are drawn by kernels: not where rays are followed from cell to cell.
enum class Kernels : bool { none, chosen };

/// Everything that does not change while one image is made. Shared by all tiles, read only.
struct Frame {
  /// The frame of a scene. `projector` is that of the scene; it and the mesh must outlive the
  /// frame. Mesh and scene must pass check_renderable (renderable.hpp).
  Frame(const ZooMesh& mesh, const Scene& scene, const Projector& projector,
        Details details = Details::none, Kernels kernels = Kernels::chosen);
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;
  ~Frame() = default;

  const ZooMesh& mesh;
  const Projector& projector;
  std::vector<ProjectedNode> nodes;
  std::vector<CellKernel> kernel_cells;  ///< result of kernel_cells(); empty with Kernels::none
  OpticsTables optics;
  FrameField color, extinction;  ///< equal if optics.same_field
  Isosurfaces isosurfaces;
  FrameSkin skin;
  /// Pixels with less transparency than this are finished.
  double least_transparency = 0;
  /// Segments may overlap the previous one by this much of the ray parameter, because of rounding.
  double witness_tolerance = 0;
  bool with_details;  ///< pixels' details are requested
  bool with_error;    ///< with error bounds
  /// The largest light of anything that a ray meets, at transparency 1 in front, any channel.
  double largest_light = 0;
  double depth = 0;         ///< extent of the mesh in the ray parameter
  double tolerance = 0;     ///< absolute error allowed per pixel and channel
  double straightness = 0;  ///< edges that deviate less (edge_deviation) are taken as straight

  [[nodiscard]] const FrameField& color_field() const {
    return optics.same_field ? extinction : color;
  }
  /// Whether a cell has curved faces (has_curved_faces); no kernel draws such cells.
  [[nodiscard]] bool is_curved(CellId cell) const {
    return kernel_cells[cell] == CellKernel::none_curved;
  }
};

}  // namespace hiac

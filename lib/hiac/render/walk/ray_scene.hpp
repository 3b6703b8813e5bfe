#pragma once

#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/frame/projection.hpp"
#include "hiac/render/edges/chosen_edges.hpp"
#include "hiac/render/edges/screen_edges.hpp"
#include "hiac/render/walk/screen_side.hpp"
#include "hiac/render/walk/walkable_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// Whether a scene shows nothing but a medium, without clipping or splats, and edges. Rays are not
/// followed in any other, which is known before anything is computed.
bool has_medium_and_edges_alone(const Scene& scene);

/// What rays need to know of one picture.
struct RayScene {
  /// `projector` is that of the scene; it and the mesh must outlive the object. Mesh and scene must
  /// pass check_renderable. `edges`: those of the mesh, if the scene draws some.
  RayScene(const WalkableMesh& mesh, const Scene& scene, const Projector& projector,
           const MeshEdges* edges);

  /// Whether rays through the mesh can be followed from cell to cell. They are not with surfaces,
  /// skin, splats or a clipping slab, with colours of a field of their own, with fields of
  /// cells or corners, by other rules of integration than the exact one, nor where a node lies
  /// beside or behind the eye.
  [[nodiscard]] bool is_walkable() const { return is_walkable_; }

  const WalkableMesh& mesh;
  Frame frame;
  ScreenEdges edges;
  std::vector<RayNode> nodes;  ///< by the mesh's numbers; empty unless is_walkable

 private:
  bool is_walkable_ = false;
};

}  // namespace hiac

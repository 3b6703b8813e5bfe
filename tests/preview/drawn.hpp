#pragma once

#include <optional>
#include <vector>

#include "hiac/frame/crop.hpp"
#include "hiac/image/image.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/preview/methods/method.hpp"
#include "hiac/preview/methods/region_filler.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::test {

/// A scene drawn by one of the paper's methods on the first device, in the exact order, without
/// background.
struct Drawn {
  Image image;
  preview::RegionCounts counts;
};
Drawn drawn(const ZooMesh& mesh, const Scene& scene, preview::Method method,
            std::optional<PixelRect> part = std::nullopt);

/// The same by the accurate engine.
Image accurate(const ZooMesh& mesh, const Scene& scene);

/// All cells of a mesh, back to front.
std::vector<CellId> back_to_front(const ZooMesh& mesh, const Scene& scene);

struct Errors {
  double largest = 0, rms = 0;
};
/// Over all pixels and the first four channels.
Errors errors(const Image& a, const Image& b);

/// A smooth scene of a field "f" between 0 and 1 in the unit cube.
Scene smooth_scene(Projection projection, Glow glow);

}  // namespace hiac::test

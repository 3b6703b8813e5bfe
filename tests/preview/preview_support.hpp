#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/preview/context.hpp"
#include "hiac/preview/preview.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::test {

/// A test that needs an OpenGL 4.5 driver, and is skipped, saying so, where there is none.
class WithDriver : public testing::Test {
 protected:
  void SetUp() override;
  [[nodiscard]] const preview::Context& context() const { return *context_; }

  /// The preview of a scene in the exact order, without background.
  [[nodiscard]] Image preview_of(const ZooMesh& mesh, const Scene& scene,
                                 const preview::PreviewOptions& options = {}) const;

  /// Holds single and double precision against the accurate engine: the largest error of any
  /// channel, and its root mean square; 2e-6 at most in double precision.
  void expect_close(const ZooMesh& mesh, const Scene& scene, double largest, double rms) const;

 private:
  std::unique_ptr<preview::Context> context_;
};

/// Random tetrahedra of the unit cube with the smooth field f and the field g.
ZooMesh delaunay_with_fields(std::size_t points, std::uint64_t seed);
/// n^3 cubes of six tetrahedra each, with f and g.
ZooMesh lattice_with_fields(std::size_t n);

/// The unit cube from a corner, four colours and six extinctions by f.
Scene benchmark_scene(Projection projection, std::uint32_t width, std::uint32_t height);

VisibilityOrder exact_order_of(const ZooMesh& mesh, const Scene& scene);

}  // namespace hiac::test

#pragma once

#include <array>

#include <gtest/gtest.h>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// That the mesh is one tetrahedron with the nodes 0, e1, e2, e3 in that order.
inline void expect_unit_tetrahedron(const ZooMesh& mesh) {
  ASSERT_EQ(mesh.cell_count(), 1U);
  ASSERT_EQ(mesh.kinds[0], CellKind::tetrahedron4);
  constexpr std::array<std::array<double, 3>, 4> kExpected{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (std::size_t n = 0; n < 4; ++n)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(mesh.position(mesh.nodes[n])[c], kExpected[n][c]) << n;
}

}  // namespace hiac::formats

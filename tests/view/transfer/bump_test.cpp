// A click in the picture adds a bump of the extinction at the value that is seen there.

#include "tools/view/transfer/bump.hpp"

#include <QTest>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/view/open_window.hpp"

namespace hiac::view::test {
namespace {

// A block whose field is thick in a slab alone: what is seen has the slab's values.
TEST(Bump, IsAtTheValueThatIsSeen) {
  OpenWindow window;
  ZooMesh mesh = hiac::test::structured(4, hiac::test::Cut::tetrahedra);
  hiac::test::add_node_field(mesh, "f", [](auto&& p) { return p[1]; });
  const std::string file = window.file("block.zoo");
  write_zoo_file(file, {mesh, {}});
  const std::string view = window.write("view.toml", R"([image]
width = 80
height = 60
[camera]
eye = [0.5, -3.0, 0.5]
look_at = [0.5, 0.5, 0.5]
up = [0, 0, 1]
fov = 30.0
[volume.extinction]
field = "f"
points = [[0.0, 0.0], [0.5, 0.0], [0.5, 40.0], [0.75, 40.0], [0.75, 0.0]]
)");
  ASSERT_TRUE(window.open(file, view));
  Document& document = window->document();
  const std::string before = document.text();
  Viewport& viewport = window->viewport();
  QTest::mouseClick(&viewport, Qt::LeftButton, Qt::AltModifier, viewport.rect().center());
  ASSERT_TRUE(wait_until([&] { return document.undo_stack().count() == 1; }));
  ASSERT_TRUE(window.rest());
  const auto& points = document.scene().volume.extinction->points;

  double bump = -1;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    if (std::abs(points[i + 1].scalar - points[i].scalar - 0.025) < 1e-9 &&
        std::abs(points[i].scalar - points[i - 1].scalar - 0.025) < 1e-9)
      bump = points[i].scalar;
  EXPECT_GE(bump, 0.5);
  EXPECT_LE(bump, 0.75);
  document.undo_stack().undo();
  EXPECT_EQ(document.text(), before);
}

}  // namespace
}  // namespace hiac::view::test

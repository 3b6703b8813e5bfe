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

const std::string kBumpView = R"([image]
width = 80
height = 60
[camera]
eye = [0.5, -3.0, 0.5]
look_at = [0.5, 0.5, 0.5]
up = [0, 0, 1]
fov = 30.0
)";

std::shared_ptr<const ZooMesh> bump_mesh() {
  ZooMesh mesh = hiac::test::structured(2, hiac::test::Cut::tetrahedra);
  hiac::test::add_node_field(mesh, "f", [](auto&& p) { return 80 * p[0]; });
  hiac::test::add_node_field(mesh, "even", [](auto&&) { return 7; });
  return std::make_shared<const ZooMesh>(std::move(mesh));
}

/// What the document tells when a bump is added.
std::string told_of_bump(Document& document, double value) {
  std::string told;
  const auto connection = QObject::connect(&document, &Document::message, &document,
                                           [&](const QString& line) { told = line.toStdString(); });
  add_bump(document, value);
  QObject::disconnect(connection);
  return told;
}

TEST(Bump, NeedsAMeshAndAField) {
  Document document;
  EXPECT_EQ(told_of_bump(document, 0.5), "");  // nothing is open
  ASSERT_TRUE(document.open_text(kBumpView, "", ""));
  EXPECT_EQ(told_of_bump(document, 0.5), "a bump: there is no mesh");
  ASSERT_TRUE(document.open(bump_mesh(), "m.zoo", kBumpView, "", ""));
  EXPECT_EQ(told_of_bump(document, 0.5),
            "a bump: the view names no field (expected [volume.color] or [volume.extinction])");
  EXPECT_EQ(document.text(), kBumpView);
}

TEST(Bump, OfAViewThatDoesNotAbsorbIsAFortiethOfTheFieldWide) {
  Document document;
  const std::string color = "[volume.color]\nfield = \"f\"\npreset = \"viridis\"\nrange = [0, 1]\n";
  ASSERT_TRUE(document.open(bump_mesh(), "m.zoo", kBumpView + color, "", ""));
  EXPECT_EQ(told_of_bump(document, 20), "");
  const ExtinctionTransfer& extinction = *document.scene().volume.extinction;
  EXPECT_EQ(extinction.field, "f");
  ASSERT_EQ(extinction.points.size(), 3U);
  EXPECT_EQ(extinction.points[0].scalar, 18);
  EXPECT_EQ(extinction.points[1].scalar, 20);
  EXPECT_EQ(extinction.points[2].scalar, 22);
  EXPECT_EQ(extinction.points[0].value[0], 0);
  EXPECT_NEAR(extinction.points[1].value[0], 20 / std::sqrt(3.0), 0.1);
  EXPECT_EQ(extinction.points[2].value[0], 0);
  document.undo_stack().undo();
  EXPECT_EQ(document.text(), kBumpView + color);
}

TEST(Bump, OfAFieldOfOneValueIsAFortiethOfThatWide) {
  Document document;
  const std::string color =
      "[volume.color]\nfield = \"even\"\npreset = \"viridis\"\nrange = [0, 1]\n";
  ASSERT_TRUE(document.open(bump_mesh(), "m.zoo", kBumpView + color, "", ""));
  EXPECT_EQ(told_of_bump(document, 8), "");
  EXPECT_DOUBLE_EQ(document.scene().volume.extinction->points[2].scalar, 8.2);
  document.undo_stack().undo();
  EXPECT_EQ(told_of_bump(document, 0.2), "");  // below 1 as 1
  EXPECT_DOUBLE_EQ(document.scene().volume.extinction->points[2].scalar, 0.225);
  EXPECT_EQ(field_extent(document, "even"), (std::array<double, 2>{7, 7}));
  EXPECT_EQ(field_extent(document, "f"), (std::array<double, 2>{0, 80}));
}

}  // namespace
}  // namespace hiac::view::test

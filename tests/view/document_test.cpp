#include "tools/view/document/document.hpp"

#include <QStringList>

#include <gtest/gtest.h>

#include "hiac/scene/toml/edited_text.hpp"
#include "hiac/session/session.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::view {
namespace {

const std::string kText = R"([image]
width = 80
height = 60
[camera]
eye = [0.0, -3.0, 1.0]
look_at = [0.0, 0.0, 0.0]
up = [0, 0, 1]
fov = 30.0
[volume.color]
field = "f"
preset = "viridis"
range = "auto"
)";

std::shared_ptr<const ZooMesh> mesh_with(const std::string& field, double factor) {
  ZooMesh mesh = hiac::test::structured(2, hiac::test::Cut::tetrahedra);
  hiac::test::add_node_field(mesh, field, [factor](auto&& p) { return factor * p[0]; });
  return std::make_shared<const ZooMesh>(std::move(mesh));
}

class DocumentTest : public ::testing::Test {
 protected:
  DocumentTest() {
    QObject::connect(&document_, &Document::message, &document_,
                     [this](const QString& line) { messages_ << line; });
    QObject::connect(&document_, &Document::changed, &document_, [this] { ++changes_; });
  }
  bool set(const std::string& key, const std::string& value, bool merges = false) {
    return document_.edit(QStringLiteral("set"), with_key(document_.text(), key, value), merges);
  }

  Document document_;
  QStringList messages_;
  int changes_ = 0;
};

TEST_F(DocumentTest, PutsPointsOnTheRangeOfItsMesh) {
  ASSERT_TRUE(document_.open(mesh_with("f", 5), "f.zoo", kText, "", ""));
  EXPECT_EQ(document_.scene().volume.color->points.back().scalar, 5);
  ASSERT_TRUE(set("camera.fov", "20"));
  EXPECT_EQ(document_.scene().volume.color->points.back().scalar, 5);
  ASSERT_TRUE(document_.change_mesh(mesh_with("f", 7), "g.zoo"));
  EXPECT_EQ(document_.scene().volume.color->points.back().scalar, 7);
  ASSERT_TRUE(set("volume.color.range", "[0, 50]"));
  ASSERT_TRUE(set("volume.color.range", "\"percentile:0,50\""));
  const Scene expected =
      with_field_ranges(parse_scene(document_.text(), "t"), *document_.mesh()).scene;
  EXPECT_EQ(document_.scene(), expected);
}

TEST_F(DocumentTest, MergesTheEditsOfOneDrag) {
  ASSERT_TRUE(document_.open_text(kText, "", ""));
  ASSERT_TRUE(set("camera.fov", "20"));
  ASSERT_TRUE(set("camera.fov", "21", true));
  ASSERT_TRUE(set("camera.fov", "22", true));
  ASSERT_TRUE(set("camera.fov", "23"));
  EXPECT_EQ(document_.undo_stack().count(), 2);
  document_.undo_stack().undo();
  EXPECT_EQ(document_.scene().camera.fov, 22);
  document_.undo_stack().undo();
  EXPECT_EQ(document_.text(), kText);
  EXPECT_EQ(document_.scene(), parse_scene(kText, "t").scene);
}

TEST_F(DocumentTest, RefusesWhatDoesNotParse) {
  ASSERT_TRUE(document_.open_text(kText, "", ""));
  const int changes = changes_;
  EXPECT_FALSE(set("camera.fov", "200"));
  EXPECT_FALSE(document_.open_text("nonsense", "n.toml", ""));
  EXPECT_EQ(document_.text(), kText);
  EXPECT_EQ(document_.file(), "");
  EXPECT_EQ(changes_, changes);
  EXPECT_EQ(document_.undo_stack().count(), 0);
  ASSERT_EQ(messages_.size(), 2);
  EXPECT_TRUE(messages_[0].contains(QStringLiteral("camera.fov")));
}

TEST_F(DocumentTest, KeepsAMeshWhoseFieldsItNeeds) {
  ASSERT_TRUE(document_.open(mesh_with("f", 5), "f.zoo", kText, "", ""));
  EXPECT_FALSE(document_.change_mesh(mesh_with("g", 5), "g.zoo"));
  EXPECT_EQ(document_.mesh_file(), "f.zoo");
  EXPECT_FALSE(document_.open(mesh_with("g", 5), "g.zoo", kText, "", ""));
  EXPECT_EQ(document_.mesh()->fields[0].name, "f");
  EXPECT_EQ(messages_.size(), 2);
}

TEST_F(DocumentTest, KnowsWhetherItIsSaved) {
  ASSERT_TRUE(document_.open_text(kText, "a.toml", ""));
  EXPECT_TRUE(document_.undo_stack().isClean());
  ASSERT_TRUE(set("camera.fov", "20"));
  EXPECT_FALSE(document_.undo_stack().isClean());
  document_.saved_as("b.toml");
  EXPECT_TRUE(document_.undo_stack().isClean());
  ASSERT_TRUE(set("camera.fov", "21", true));  // does not merge into what is saved
  document_.undo_stack().undo();
  EXPECT_EQ(document_.scene().camera.fov, 20);
  EXPECT_TRUE(document_.undo_stack().isClean());
}

}  // namespace
}  // namespace hiac::view

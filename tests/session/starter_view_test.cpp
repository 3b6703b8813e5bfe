#include "hiac/session/starter_view.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/session/session.hpp"
#include "hiac/session/visibility.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

/// Bricks, scaled, with the fields that a test adds.
ZooMesh box(std::size_t n, const std::array<double, 3>& size) {
  return test::moved(test::structured(n, test::Cut::bricks), [&](const test::Position& p) {
    return test::Position{size[0] * p[0], size[1] * p[1], size[2] * p[2]};
  });
}

void add_cell_field(ZooMesh& mesh, const std::string& name, std::uint32_t components,
                    const std::function<double(std::size_t)>& value) {
  std::vector<double> values(mesh.cell_count() * components);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(i);
  mesh.fields.push_back({name, "", FieldLocation::cell, components, std::move(values)});
}

std::string field_of(const ZooMesh& mesh) {
  return make_starter_view(mesh, "m").scene.volume.color->field;
}

/// The share of the picture's pixels that the mesh covers, and the mean optical depth there.
struct Seen {
  double coverage, depth;
};

Seen seen(const ZooMesh& mesh, Scene scene) {
  scene.image = {scene.image.width / 8, scene.image.height / 8};
  const Picture picture = Session(mesh).picture(scene);
  EXPECT_THAT(invisible_parts(mesh, scene), IsEmpty());
  return {static_cast<double>(picture.covered_pixels) / (scene.image.width * scene.image.height),
          picture.mean_optical_depth};
}

TEST(StarterView, MeasuresItsOpticalDepth) {
  for (const std::array<double, 3>& size : {std::array<double, 3>{1, 1, 1},
                                            {3e-6, 1e-6, 2e-6},
                                            {40, 1, 1},
                                            {1, 1, 60},
                                            {50, 50, 0.1}}) {
    ZooMesh mesh = box(4, size);
    // almost everything is at the lowest value, which nevertheless does not fade
    test::add_node_field(mesh, "f", [&](const test::Position& p) {
      return std::pow(p[0] / size[0] * p[1] / size[1], 8);
    });
    const Seen found = seen(mesh, make_starter_view(mesh, "m").scene);
    EXPECT_NEAR(found.depth, 1, 0.15) << size[0] << ' ' << size[1] << ' ' << size[2];
    EXPECT_GT(found.coverage, 0.15) << size[0] << ' ' << size[1] << ' ' << size[2];
  }
}

TEST(StarterView, MeshesWithoutAFieldAreColouredByTheirHeight) {
  const ZooMesh mesh = box(2, {2, 1, 1});
  const StarterView view = make_starter_view(mesh, "m");
  EXPECT_EQ(view.scene.volume.color->field, "position:z");
  EXPECT_THAT(view.notes, ElementsAre(HasSubstr("the height: the mesh has no field"),
                                      HasSubstr("shows the solid model")));
  EXPECT_EQ(view.scene.volume.extinction->points.size(), 1U);
  Scene medium = view.scene;
  medium.skin.reset();
  medium.edges.reset();
  EXPECT_NEAR(seen(mesh, medium).depth, 1, 0.05);
}

TEST(StarterView, MeshesWithoutAFieldAreSolid) {
  const ZooMesh mesh = box(2, {2, 1, 1});
  const StarterView view = make_starter_view(mesh, "m");
  ASSERT_TRUE(view.scene.skin && view.scene.edges);
  EXPECT_EQ(seen(mesh, view.scene).depth, 0);  // opaque: the medium is hidden
  EXPECT_THAT(view.text, HasSubstr("\n[skin]\n"));
  EXPECT_EQ(parse_scene(view.text, "text").scene, view.scene);
  // surfaces are not hidden
  EXPECT_FALSE(make_starter_view(mesh, "m", {.isovalues = 2}).scene.skin);
}

TEST(StarterView, DrawsFeatureEdgesOverTheMedium) {
  ZooMesh mesh = box(3, {2, 1, 1});
  test::add_node_field(mesh, "f", test::smooth_field);
  const Scene scene = make_starter_view(mesh, "m").scene;
  ASSERT_TRUE(scene.edges);
  EXPECT_FALSE(scene.skin);
  EXPECT_EQ(scene.edges->show, EdgeChoice::feature);
  EXPECT_EQ(scene.edges->width, 1);
  EXPECT_THAT(scene.edges->color, Each(0));
  EXPECT_THAT(make_starter_view(mesh, "m", {.dark = true}).scene.edges->color,
              Each(testing::Gt(0.5)));
}

TEST(StarterView, OpaqueEdgesDoNotCountAsMedium) {
  ZooMesh mesh = box(3, {2, 1, 1});
  test::add_node_field(mesh, "f", test::smooth_field);
  Scene with = make_starter_view(mesh, "m").scene, without = with;
  without.edges.reset();
  with.edges->width = 3;
  const auto picture = [&](Scene scene) {
    scene.image = {128, 96};
    return Session(mesh).picture(scene);
  };
  const Picture lines = picture(with), medium = picture(without);
  EXPECT_NEAR(lines.mean_optical_depth, medium.mean_optical_depth, 0.1);
  EXPECT_LT(lines.largest_optical_depth, medium.largest_optical_depth + 1e-12);
}

TEST(StarterView, LeavesOutMoreFeatureEdgesThanThePictureHolds) {
  // loose bricks: every edge of every brick is a feature
  ZooMesh mesh = test::structured(24, test::Cut::bricks);
  std::vector<CellKind> kinds;
  std::vector<std::uint64_t> elems{0};
  std::vector<NodeId> nodes;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    if (cell % 2 != 0) continue;  // neighbours along x
    kinds.push_back(mesh.kinds[cell]);
    for (const NodeId node : mesh.cell_nodes(cell)) nodes.push_back(node);
    elems.push_back(nodes.size());
  }
  mesh.kinds = std::move(kinds);
  mesh.elems = std::move(elems);
  mesh.nodes = std::move(nodes);
  mesh.adjacency.reset();
  test::add_node_field(mesh, "f", test::smooth_field);
  const StarterView view = make_starter_view(mesh, "m", {.size = {{96, 72}}});
  EXPECT_FALSE(view.scene.edges);
  EXPECT_THAT(view.notes, testing::Contains(HasSubstr("leaves the feature edges out")));
}

TEST(StarterView, ShowsTheFieldThatSaysMost) {
  ZooMesh mesh = box(3, {1, 1, 1});
  add_cell_field(mesh, "constant", 1, [](std::size_t) { return 7; });
  add_cell_field(mesh, "id", 1, [](std::size_t i) { return 30 - static_cast<double>(i); });
  add_cell_field(mesh, "broken", 1, [](std::size_t i) { return i == 5 ? NAN : std::sqrt(i); });
  EXPECT_EQ(field_of(mesh), "position:z");
  add_cell_field(mesh, "material", 1, [](std::size_t i) { return i % 2; });
  EXPECT_EQ(field_of(mesh), "material");
  add_cell_field(mesh, "spike", 1, [](std::size_t i) { return i == 3 ? 1.5 : 0.5; });
  EXPECT_EQ(field_of(mesh), "spike");
  add_cell_field(mesh, "v", 3, [](std::size_t i) { return std::sin(i); });
  EXPECT_EQ(field_of(mesh), "v:magnitude");
}

TEST(StarterView, OutliersDoNotTakeAllOfTheRange) {
  ZooMesh mesh = box(10, {1, 1, 1});
  add_cell_field(mesh, "f", 1, [](std::size_t i) { return i == 3 ? 1e6 : std::sin(i); });
  const StarterView view = make_starter_view(mesh, "m");
  EXPECT_LT(view.scene.volume.color->points.back().scalar, 1.1);
  EXPECT_THAT(view.notes[0], HasSubstr("98 percent of its values"));
}

TEST(StarterView, DoesWhatItIsAsked) {
  ZooMesh mesh = box(3, {1, 1, 1});
  test::add_node_field(mesh, "f", test::smooth_field);
  add_cell_field(mesh, "v", 3, [](std::size_t i) { return std::sin(i); });
  StarterOptions options;
  options.field = "v";
  EXPECT_EQ(make_starter_view(mesh, "m", options).scene.volume.color->field, "v:magnitude");
  options.field = "f";
  options.preset = "cool to warm";
  options.isovalues = 3;
  options.dark = true;
  options.size = {{320, 200}};
  const StarterView view = make_starter_view(mesh, "m", options);
  EXPECT_EQ(view.scene.volume.color->field, "f");
  EXPECT_THAT(view.text, HasSubstr("preset = \"cool to warm\""));
  ASSERT_EQ(view.scene.isosurfaces.size(), 3U);
  for (const Isosurface& surface : view.scene.isosurfaces) EXPECT_EQ(surface.opacity, 0.5);
  EXPECT_THAT(invisible_parts(mesh, view.scene), IsEmpty());
  EXPECT_THAT(view.scene.background.color, Each(testing::Lt(0.05)));
  EXPECT_EQ(view.scene.image, (ImageSize{320, 200}));
  Scene medium = view.scene;
  medium.isosurfaces.clear();
  EXPECT_NEAR(seen(mesh, medium).depth, 0.3, 0.05);
  options.preset = "virids";
  EXPECT_THAT([&] { make_starter_view(mesh, "m", options); },
              ThrowsMessage<UsageError>(HasSubstr("preset virids: no colour map of this name")));
  options.preset = "viridis";
  options.field = "g";
  EXPECT_THROW(make_starter_view(mesh, "m", options), UsageError);
}

TEST(StarterView, ShowsEverySection) {
  ZooMesh mesh = box(3, {1, 1, 1});
  test::add_node_field(mesh, "f", test::smooth_field);
  const StarterView view = make_starter_view(mesh, "m");
  for (const char* section :
       {"\n[camera]", "\n[volume]", "\n[volume.color]", "\n[volume.extinction]", "\n[[light]]",
        "\n[background]", "\n[render]", "\n# [[isosurface]]", "\n# [skin]", "\n[edges]",
        "\n# [turntable]", "\n# [camera_path]", "\n# opacity = ", "\n# frames = 36"})
    EXPECT_THAT("\n" + view.text, HasSubstr(section));
  EXPECT_EQ(parse_scene(view.text, "text").scene, view.scene);
}

// As `--set edges.show=boundary` does: a key that other edges do not have must not be left behind.
TEST(StarterView, OtherEdgesCanBeShown) {
  ZooMesh mesh = box(3, {1, 1, 1});
  test::add_node_field(mesh, "f", test::smooth_field);
  std::string text = make_starter_view(mesh, "m").text;
  const std::string feature = "show = \"feature\"";
  text.replace(text.find(feature), feature.size(), "show = \"boundary\"");
  EXPECT_EQ(parse_scene(text, "text").scene.edges->show, EdgeChoice::boundary);
}

TEST(StarterView, RefusesWhatCannotBeSeen) {
  const auto told = [](const ZooMesh& mesh, const StarterOptions& options = {}) -> std::string {
    try {
      make_starter_view(mesh, "m", options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(told(ZooMesh{}), "m: no cells to look at");
  EXPECT_EQ(told(box(1, {0, 0, 0})), "m: nothing to look at (all nodes lie at one point)");
  EXPECT_EQ(told(box(1, {0, 0, 1})), "");
  EXPECT_THAT(told(box(1, {1, 1, 1}), {.preset = "none"}),
              HasSubstr("preset none: no colour map of this name (expected one of viridis, "));
  ZooMesh placeless = box(1, {1, 1, 1});
  std::vector<double> xyz(placeless.xyz.begin(), placeless.xyz.end());
  for (std::size_t i = 2; i < xyz.size(); i += 3) xyz[i] = std::nan("");
  placeless.xyz = std::move(xyz);
  EXPECT_EQ(told(placeless), "m: nothing to look at (no node has a place)");
  ZooMesh broken = box(1, {1, 1, 1});
  add_cell_field(broken, "p", 1, [](std::size_t) { return std::nan(""); });
  EXPECT_EQ(told(broken, {.field = "p"}), "m: field 'p': has no finite values");
  EXPECT_EQ(told(broken), "");  // coloured by the height
}

}  // namespace
}  // namespace hiac

#include "hiac/session/session.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/image/composite.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/render/explain_pixel.hpp"
#include "hiac/render/supersampling.hpp"
#include "hiac/scene/view_of.hpp"
#include "hiac/session/ordering.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

ZooMesh small_mesh() {
  ZooMesh mesh = test::structured(3, test::Cut::prisms);
  test::add_node_field(mesh, "f", test::smooth_field);
  return mesh;
}

Scene small_view(const ZooMesh& mesh) {
  Scene scene = starter_view(mesh);
  scene.image = {64, 48};
  return scene;
}

PictureRequest request(std::optional<PixelRect> part, std::optional<Supersampling> sampling = {},
                       std::vector<std::string> channels = {}, bool background = true,
                       const Image* under = nullptr) {
  return {part, sampling, std::move(channels), background, under};
}

// The order as the library's parts make it.
VisibilityOrder order_for(const ZooMesh& mesh, const Scene& scene) {
  return exact_order(mesh, build_face_adjacency(mesh), view_of(scene.camera),
                     scene.render.planarity)
      .order;
}

void expect_same(const Image& a, const Image& b) {
  ASSERT_TRUE(std::ranges::equal(a.channels(), b.channels()));
  ASSERT_EQ(a.values().size(), b.values().size());
  EXPECT_EQ(std::memcmp(a.values().data(), b.values().data(), a.values().size_bytes()), 0);
}

// A picture of few pixels takes the time of what is computed for all of them. A busy machine may
// pause between two readings of the clock, so that one picture of ten has to fit.
TEST(Session, ThePartsOfAPicturesTimeMakeUpTheStage) {
  ZooMesh mesh = test::structured(20, test::Cut::tetrahedra);
  test::add_node_field(mesh, "f", test::smooth_field);
  Scene scene = small_view(mesh);
  scene.image = {4, 4};
  double stage = 0;
  Monitor monitor;
  monitor.stage_ended = [&](const std::string&, double seconds) { stage = seconds; };
  Session session(std::move(mesh), monitor);
  double share = 0;
  for (int k = 0; k < 10; ++k) {
    const Picture picture = session.picture(scene);
    const double told = picture.statistics->prepare_seconds + picture.statistics->tile_seconds;
    EXPECT_LE(told, stage);
    share = std::max(share, told / stage);
  }
  EXPECT_GT(share, 0.8);
}

TEST(Session, APictureIsTheEngines) {
  const ZooMesh mesh = small_mesh();
  const Scene scene = small_view(mesh);
  const VisibilityOrder order = order_for(mesh, scene);
  Session session(mesh);
  const Picture picture = session.picture(scene);
  const RenderResult engine = render(mesh, order, scene, true);
  expect_same(picture.image, engine.image);
  EXPECT_EQ(picture.segments, engine.statistics.segments);
  EXPECT_EQ(picture.covered_pixels, engine.statistics.covered_pixels);
  EXPECT_GT(picture.covered_pixels, 0U);
  EXPECT_EQ(picture.mean_optical_depth, engine.statistics.mean_optical_depth);
  EXPECT_EQ(picture.mesh_hash, content_hash(mesh));
  EXPECT_TRUE(std::ranges::equal(picture.order->record.order.cells, order.cells));

  const std::vector<Channel> channels{Channel::error, Channel::depth};
  expect_same(session.picture(scene, request({}, {}, {"error", "depth"}, false)).image,
              render(mesh, order, scene, false, nullptr, channels).image);
}

TEST(Session, APartIsThatOfTheWholePicture) {
  const ZooMesh mesh = small_mesh();
  const Scene scene = small_view(mesh);
  Session session(mesh);
  const Image whole = session.picture(scene).image;
  const Image part = session.picture(scene, request(PixelRect{20, 10, 30, 25})).image;
  ASSERT_EQ(part.width(), 30U);
  ASSERT_EQ(part.height(), 25U);
  for (std::size_t y = 0; y < 25; ++y)
    for (std::size_t x = 0; x < 30; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        ASSERT_EQ(part.at(x, y, c), whole.at(x + 20, y + 10, c)) << x << ' ' << y;
}

TEST(Session, SamplesAndAPictureBehindAreTakenInto) {
  const ZooMesh mesh = small_mesh();
  const Scene scene = small_view(mesh);
  const VisibilityOrder order = order_for(mesh, scene);
  const Supersampling sampling{3, SampleFilter::bspline};
  const PixelRect all{0, 0, 64, 48};
  Session session(mesh);
  expect_same(session.picture(scene, request({}, sampling)).image,
              render_supersampled(mesh, order, scene, all, sampling, true).image);

  Image under(64, 48, rgba_channels());
  for (std::size_t i = 0; i < under.values().size(); ++i)
    under.values()[i] = static_cast<double>(i % 97) / 97;
  Image expected = render(mesh, order, scene, false).image;
  composite_over(expected, under);
  expect_same(session.picture(scene, request({}, {}, {}, true, &under)).image, expected);
}

TEST(Session, RequestsThatDoNotFitAreRefusedInNeutralWords) {
  const ZooMesh mesh = small_mesh();
  const Scene scene = small_view(mesh);
  Session session(mesh);
  const Image other(63, 48, rgba_channels()), grey_depths(64, 48, {"depth"});
  Image broken(64, 48, rgba_channels());
  broken.at(5, 7, 1) = std::numeric_limits<double>::quiet_NaN();
  for (const PictureRequest& wrong :
       {request(PixelRect{60, 0, 5, 5}), request({}, Supersampling{0, SampleFilter::box}),
        request({}, {}, {"depht"}), request({}, {}, {"depth", "depth"}),
        request({}, {}, {}, true, &other), request({}, {}, {}, true, &grey_depths),
        request({}, {}, {}, true, &broken)}) {
    EXPECT_THAT([&] { require_possible(wrong, scene.image); },
                ThrowsMessage<UsageError>(Not(HasSubstr("--"))));
    EXPECT_THROW(session.picture(scene, wrong), UsageError);
  }
}

TEST(Session, WhatIsWrongWithAPictureBehindIsSaid) {
  const auto told = [](const Image& under, std::optional<PixelRect> part = {}) -> std::string {
    try {
      require_possible(request(part, {}, {}, true, &under), ImageSize{64, 48});
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(told(Image(64, 48, rgba_channels())), "");
  EXPECT_EQ(told(Image(64, 48, {"Y"})), "");
  EXPECT_EQ(told(Image(5, 4, {"Y"}), PixelRect{1, 2, 5, 4}), "");
  EXPECT_EQ(told(Image(64, 47, {"Y"})),
            "the picture behind is of another size (64 x 48 pixels expected, 64 x 47 found)");
  EXPECT_EQ(told(Image(64, 48, {"Y"}), PixelRect{1, 2, 5, 4}),
            "the picture behind is of another size (5 x 4 pixels expected, 64 x 48 found)");
  EXPECT_EQ(told(Image(64, 48, {"depth"})), "the picture behind has no colour");
  EXPECT_EQ(told(Image(64, 48, {"A"})), "the picture behind has no colour");
  Image broken(64, 48, {"depth", "R", "G", "B", "A"});
  broken.at(1, 2, 0) = std::numeric_limits<double>::infinity();  // no channel that is drawn over
  EXPECT_EQ(told(broken), "");
  broken.at(5, 7, 4) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(told(broken),
            "the picture behind: pixel 5,7: channel A is not finite (a finite number expected, inf "
            "found)");
}

TEST(Session, TellsItsMonitorOfEveryStageOnce) {
  const ZooMesh mesh = small_mesh();
  Scene scene = small_view(mesh);
  Progress progress;
  std::vector<std::string> stages;
  Session session(
      mesh, {.progress = &progress,
             .stage_ended = [&](const std::string& stage, double) { stages.push_back(stage); }});
  session.picture(scene);
  EXPECT_THAT(stages, ElementsAre("adjacency", "basis", "order", "hash", "render"));
  EXPECT_EQ(progress.state().stage, "tiles");
  EXPECT_GT(progress.state().total, 0U);
  EXPECT_EQ(progress.state().done, progress.state().total);
  stages.clear();
  scene.camera.eye[0] += 0.1;
  session.picture(scene);
  EXPECT_THAT(stages, ElementsAre("order", "render"));
}

TEST(Session, OrdersThatAreGivenAreUsedAndHaveToFit) {
  const ZooMesh mesh = small_mesh();
  const Scene scene = small_view(mesh);
  Session first(mesh);
  OrderRecord record = first.order(scene)->record;
  record.order.algorithm = "stein";
  std::vector<std::string> notes;
  Session session(mesh, {.note = [&](const std::string& line) { notes.push_back(line); }});
  session.use_orders("x.order", {encode_order(record)});
  EXPECT_NO_THROW(session.require_order(scene));
  expect_same(session.picture(scene).image, first.picture(scene).image);
  EXPECT_THAT(notes, ElementsAre("x.order: the order is by stein, not by the exact algorithm"));
  EXPECT_FALSE(session.order(scene)->statistics);
  Scene other = scene;
  other.camera.eye[1] += 1;
  EXPECT_THAT([&] { session.require_order(other); },
              ThrowsMessage<InputError>(HasSubstr("x.order: the order belongs to another view")));
  EXPECT_THROW(session.picture(other), InputError);
  EXPECT_THROW(session.look_for_overlaps(1e-10), UsageError);
}

TEST(Session, OverlappingCellsBecomeGroups) {
  ZooMesh mesh = test::side_by_side(
      test::structured(1, test::Cut::tetrahedra),
      test::moved(test::structured(1, test::Cut::tetrahedra), [](const test::Position& p) {
        return test::Position{p[0] + 0.3, p[1] + 0.2, p[2] + 0.1};
      }));
  test::add_node_field(mesh, "f", test::smooth_field);
  const Scene scene = small_view(mesh);
  std::vector<std::string> notes;
  Session session(mesh, {.note = [&](const std::string& line) { notes.push_back(line); }});
  session.look_for_overlaps(scene.render.planarity);
  const auto order = session.order(scene);
  EXPECT_GT(order->overlapping_pairs, 0U);
  EXPECT_FALSE(order->record.order.groups.empty());
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], HasSubstr("pairs of cells overlap, or may"));
}

TEST(Session, InvalidCellsAreRefusedOrLeftOut) {
  ZooMesh mesh = test::make_mesh({{0, 0, 0},
                                  {1, 0, 0},
                                  {2, 0, 0},
                                  {0, 1, 0},
                                  {1, 1, 0},
                                  {2, 1, 0},
                                  {0, 0, 1},
                                  {1, 0, 1},
                                  {2, 0, 1},
                                  {0, 1, 1},
                                  {1, 1, 1},
                                  {1.1, 0.1, 0.1}},
                                 {{CellKind::brick8, {0, 1, 4, 3, 6, 7, 10, 9}},
                                  {CellKind::brick8, {1, 2, 5, 4, 7, 8, 11, 10}}});
  test::add_node_field(mesh, "f", test::smooth_field);
  const Scene scene = small_view(mesh);
  Session session(mesh);
  EXPECT_THAT([&] { session.require_drawable(scene); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("cell 1 (brick8)"), Not(HasSubstr("--")))));
  EXPECT_THAT(session.skip_invalid_cells(scene), ElementsAre(1));
  const auto order = session.order(scene);
  ASSERT_EQ(order->record.order.cells.size(), 1U);
  EXPECT_EQ(order->record.order.cells[0], 0U);
}

TEST(Session, APixelIsThePictures) {
  const ZooMesh mesh = small_mesh();
  const Scene scene = small_view(mesh);
  Session session(mesh);
  const Image image = session.picture(scene).image;
  const Explanation explained = session.explain(scene, 30, 22);
  EXPECT_FALSE(explained.pixel->segments.empty());
  for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(explained.pixel->rgba[c], image.at(30, 22, c));
  EXPECT_EQ(explained.order->record.view_hash, view_hash(scene));
}

// The truth is a session of that step alone.
TEST(Session, AStepOfTheSameGeometryKeepsTheOrder) {
  const ZooMesh first = small_mesh();
  const Scene scene = small_view(first);
  ZooMesh second = test::structured(3, test::Cut::prisms);
  test::add_node_field(second, "f", [](const test::Position& p) { return p[0] * p[2]; });
  Session session(first), alone(second);
  const Picture before = session.picture(scene);
  ZooMesh step = second;
  ASSERT_TRUE(session.take_step(step));
  const Picture after = session.picture(scene), truth = alone.picture(scene);
  EXPECT_EQ(after.order, before.order);
  EXPECT_EQ(after.mesh_hash, truth.mesh_hash);
  expect_same(after.image, truth.image);
  EXPECT_NE(std::memcmp(before.image.values().data(), after.image.values().data(),
                        after.image.values().size_bytes()),
            0);
  // another view has another order
  Scene other = scene;
  other.camera.eye[0] += 1;
  EXPECT_NE(session.picture(other).order, before.order);
  expect_same(session.picture(other).image, alone.picture(other).image);
}

// Pictures of few pixels, in which rays are followed from cell to cell.
void expect_by_rays(Session& session, const Scene& scene) {
  const auto by_rays = session.picture_by_rays(scene);
  ASSERT_TRUE(by_rays.has_value());
  const Picture by_order = session.picture(scene);
  EXPECT_EQ(by_rays->order, nullptr);
  EXPECT_EQ(by_rays->mesh_hash, by_order.mesh_hash);
  EXPECT_EQ(by_rays->segments, by_order.segments);
  EXPECT_EQ(by_rays->covered_pixels, by_order.covered_pixels);
  ASSERT_EQ(by_rays->image.values().size(), by_order.image.values().size());
  double largest = 0;
  for (std::size_t k = 0; k < by_order.image.values().size(); ++k)
    largest = std::max(largest, std::abs(by_rays->image.values()[k] - by_order.image.values()[k]));
  EXPECT_LE(largest, 1e-12);
}

Scene coarse_view(const ZooMesh& mesh) {
  Scene scene = small_view(mesh);
  scene.image = {32, 24};
  scene.background.color = {0.2, 0.4, 0.6};
  return scene;
}

TEST(Session, PicturesByRaysAreThoseOfAnOrder) {
  ZooMesh mesh = test::random_delaunay(250, 1);
  test::add_node_field(mesh, "f", test::smooth_field);
  Scene scene = coarse_view(mesh);
  ASSERT_TRUE(scene.edges.has_value());
  Session session(mesh);
  expect_by_rays(session, scene);
  scene.edges->show = EdgeChoice::boundary;
  expect_by_rays(session, scene);
  scene.edges.reset();
  expect_by_rays(session, scene);
  scene.camera.eye[0] += 1;
  expect_by_rays(session, scene);
  const auto without = session.picture_by_rays(scene, false);
  ASSERT_TRUE(without.has_value());
  PictureRequest request;
  request.background = false;
  EXPECT_NEAR(without->image.at(0, 0, 2), session.picture(scene, request).image.at(0, 0, 2), 1e-12);
  EXPECT_NE(without->image.at(0, 0, 2), session.picture_by_rays(scene)->image.at(0, 0, 2));
  // another step's field
  ZooMesh step = mesh;
  step.fields.clear();
  test::add_node_field(step, "f", [](const test::Position& p) { return p[0] * p[2]; });
  ASSERT_TRUE(session.take_step(step));
  expect_by_rays(session, scene);
}

TEST(Session, PicturesByRaysAreNotMadeWhereAnOrderIsFasterOrDecides) {
  const ZooMesh prisms = small_mesh();
  EXPECT_FALSE(Session(prisms).picture_by_rays(coarse_view(prisms)).has_value());
  ZooMesh mesh = test::structured(4, test::Cut::tetrahedra);
  test::add_node_field(mesh, "f", test::smooth_field);
  Scene scene = coarse_view(mesh);
  Session session(mesh);
  EXPECT_TRUE(session.picture_by_rays(scene).has_value());
  scene.image = {320, 240};
  EXPECT_FALSE(session.picture_by_rays(scene).has_value());
  scene = coarse_view(mesh);
  session.look_for_overlaps(scene.render.planarity);
  EXPECT_FALSE(session.picture_by_rays(scene).has_value());

  ZooMesh overlapping = test::side_by_side(
      test::structured(4, test::Cut::tetrahedra),
      test::moved(test::structured(4, test::Cut::tetrahedra), [](const test::Position& p) {
        return test::Position{p[0] + 0.3, p[1] + 0.2, p[2] + 0.1};
      }));
  overlapping.fields.clear();
  test::add_node_field(overlapping, "f", test::smooth_field);
  const Scene view = coarse_view(overlapping);
  EXPECT_FALSE(Session(overlapping).picture_by_rays(view).has_value());
}

TEST(Session, AStepOfAnotherGeometryIsNotTaken) {
  const ZooMesh first = small_mesh();
  const Scene scene = small_view(first);
  Session session(first);
  const Picture before = session.picture(scene);
  ZooMesh step = test::moved(first, [](const test::Position& p) {
    return test::Position{p[0], p[1], p[2] == 1 ? 1.25 : p[2]};
  });
  EXPECT_FALSE(session.take_step(step));
  EXPECT_EQ(step.cell_count(), first.cell_count());
  EXPECT_EQ(session.mesh().position(0)[2], first.position(0)[2]);
  expect_same(session.picture(scene).image, before.image);
}

}  // namespace
}  // namespace hiac

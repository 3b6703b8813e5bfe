// The window as a whole: real files are opened, turned, zoomed, edited; its picture is that of
// hiac-render, and its text that of the file.

#include <QAction>
#include <QClipboard>
#include <QTest>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hiac/base/seconds.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/scene/camera_motion.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "tests/view/open_window.hpp"

namespace hiac::view::test {
namespace {

const std::string kSampleView = std::string(HIAC_SOURCE_DIR) + "/samples/reactor-pool/view.toml";

std::string data_folder() {
  const char* const given = std::getenv("HIAC_DATA_DIR");
  return given != nullptr ? given : HIAC_DEFAULT_DATA_DIR;
}

bool run(const std::string& command) { return std::system(command.c_str()) == 0; }

// The sample as a zoo mesh, converted once.
const std::string& sample() {
  static const hiac::test::ScratchFolder kFolder;
  static const std::string kFile = [] {
    const std::string file = kFolder.file("flow.zoo");
    EXPECT_TRUE(run(fmt::format("hiac-convert -q '{}/samples/reactor-pool/flow.vtu' -o '{}'",
                                HIAC_SOURCE_DIR, file)));
    return file;
  }();
  return kFile;
}

// A smaller picture of the sample's own specification, comments included.
std::string small_view(const OpenWindow& window) {
  std::string text = hiac::test::bytes_of(kSampleView);
  text = with_key(with_key(text, "image.width", "161"), "image.height", "120");
  return window.write("small.toml", text);
}

// The bytes that hiac-render puts into a PNG of the window's saved specification.
std::vector<std::uint8_t> rendered(OpenWindow& window, const std::string& mesh) {
  const std::string view = window.file("saved.toml"), picture = window.file("rendered.png");
  EXPECT_TRUE(window->files().save_to(QString::fromStdString(view)));
  EXPECT_TRUE(run(fmt::format("{} -q '{}' --view '{}' --skip-invalid -o '{}'", HIAC_RENDER, mesh,
                              view, picture)));
  const QImage image(QString::fromStdString(picture));
  std::vector<std::uint8_t> bytes;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const QRgb pixel = image.pixel(x, y);
      for (const int part : {qRed(pixel), qGreen(pixel), qBlue(pixel)})
        bytes.push_back(static_cast<std::uint8_t>(part));
    }
  return bytes;
}

void drag(QWidget& widget, Qt::MouseButton button, Qt::KeyboardModifiers modifiers, QPoint from,
          QPoint by) {
  QTest::mousePress(&widget, button, modifiers, from);
  for (int step = 1; step <= 4; ++step) {
    const QPointF at = from + by * step / 4.0;
    QMouseEvent event(QEvent::MouseMove, at, widget.mapToGlobal(at), Qt::NoButton, button,
                      modifiers);
    QCoreApplication::sendEvent(&widget, &event);
  }
  QTest::mouseRelease(&widget, button, modifiers, from + by);
}

void trigger(OpenWindow& window, const char* name) {
  auto* action = window->findChild<QAction*>(QLatin1String(name));
  ASSERT_NE(action, nullptr) << name;
  action->trigger();
}

// One edit of the camera or of something else.
void edit_at_random(OpenWindow& window, std::mt19937_64& random) {
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const QPoint from(300, 300);
  const QPoint by(static_cast<int>(number(-150, 150)), static_cast<int>(number(-150, 150)) | 16);
  Viewport& viewport = window->viewport();
  const auto set = [&](const std::string& key, const std::string& value) {
    window->document().edit(QStringLiteral("set"), with_key(window->document().text(), key, value));
  };
  switch (std::uniform_int_distribution<int>(0, 11)(random)) {
    case 0:
      return drag(viewport, Qt::LeftButton, Qt::NoModifier, from, by);
    case 1:
      return drag(viewport, Qt::LeftButton, Qt::ShiftModifier, from, by / 4);
    case 2:
      return drag(viewport, Qt::RightButton, Qt::NoModifier, from, by / 2);
    case 3:
      return drag(viewport, Qt::LeftButton, Qt::ControlModifier, from, by);
    case 4:
      return trigger(window, "projection");
    case 5:
      return trigger(window, "axis_views");
    case 6:
      return trigger(window, "color_bar");
    case 7:
      return window->view().set_clip(std::array{number(0, 3), number(4, 9)}, false);
    case 8:
      return set("background.color", fmt::format("[{}, {}, {}]", number(0, 1), number(0, 1), 0.5));
    case 9:
      return set("image.width", std::to_string(100 + random() % 60));
    case 10:
      return set("volume.extinction.points", fmt::format("[[0.0, 0.0], [1.0, {}]]", number(1, 20)));
    default:
      return trigger(window, "reset");
  }
}

TEST(Window, ShowsAtRestWhatHiacRenderDrawsOfItsSavedSpecification) {
  OpenWindow window;
  ASSERT_TRUE(window.open(sample(), small_view(window))) << window->messages().text().toStdString();
  std::mt19937_64 random(22);
  constexpr int kEdits = hiac::test::kInstrumented ? 3 : 20;
  for (int edit = 0; edit < kEdits; ++edit) {
    edit_at_random(window, random);
    ASSERT_TRUE(window.rest()) << window->document().text();
    EXPECT_EQ(window->picture()->step, 1U);
    EXPECT_TRUE(window->picture()->bytes == rendered(window, sample())) << "edit " << edit;
  }
}

TEST(Window, UndoesEverythingAndKeepsTheText) {
  OpenWindow window;
  const std::string view = small_view(window), before = hiac::test::bytes_of(view);
  ASSERT_TRUE(window.open(sample(), view));
  EXPECT_EQ(window->document().text(), before);
  std::mt19937_64 random(7);
  for (int edit = 0; edit < 30; ++edit) edit_at_random(window, random);
  const std::string after = window->document().text();
  EXPECT_NE(after, before);
  QUndoStack& stack = window->document().undo_stack();
  while (stack.canUndo()) stack.undo();
  EXPECT_EQ(window->document().text(), before);
  while (stack.canRedo()) stack.redo();
  EXPECT_EQ(window->document().text(), after);
}

TEST(Window, UndoesADragAtOnce) {
  OpenWindow window;
  ASSERT_TRUE(window.open(sample(), small_view(window)));
  const std::string before = window->document().text();
  for (int times = 0; times < 2; ++times)
    drag(window->viewport(), Qt::LeftButton, Qt::NoModifier, {300, 300}, {80, 40});
  EXPECT_EQ(window->document().undo_stack().count(), 2);
  trigger(window, "undo");
  trigger(window, "undo");
  EXPECT_EQ(window->document().text(), before);
}

TEST(Window, TellsOfAPixelWhatHiacRenderTells) {
  OpenWindow window;
  const std::string view = small_view(window);
  ASSERT_TRUE(window.open(sample(), view));
  const std::string told = window.file("told.txt");
  for (const auto& [x, y] : {std::pair(80, 60), std::pair(2, 2), std::pair(60, 70)}) {
    Q_EMIT window->viewport().pixel_chosen(QPoint(x, y));
    const QString end = QStringLiteral("pixel %1,%2:").arg(x).arg(y);
    ASSERT_TRUE(wait_until([&] { return window->pixel_panel().text().contains(end); }));
    ASSERT_TRUE(run(fmt::format("{} -q '{}' --view '{}' --pixel {},{} > '{}'", HIAC_RENDER,
                                sample(), view, x, y, told)));
    EXPECT_EQ(window->pixel_panel().text().toStdString(), hiac::test::bytes_of(told));
  }
}

// After an edit the panel tells of the new picture; a pixel that the picture has no more is
// dropped.
TEST(Window, GoesOnExplainingThePixelThatWasChosen) {
  OpenWindow window;
  ASSERT_TRUE(window.open(sample(), small_view(window)));
  Q_EMIT window->viewport().pixel_chosen(QPoint(80, 60));
  ASSERT_TRUE(wait_until([&] { return !window->pixel_panel().text().isEmpty(); }));
  const QString before = window->pixel_panel().text();
  window->view().move_camera(orbited(*window->view().camera(), 20, 5), QStringLiteral("turn"),
                             false);
  EXPECT_FALSE(window->pixel_panel().isEnabled());  // what it tells is of the picture before
  ASSERT_TRUE(window.rest());
  EXPECT_TRUE(window->pixel_panel().isEnabled());
  EXPECT_NE(window->pixel_panel().text(), before);
  const std::string view = window.file("turned.toml"), told = window.file("told.txt");
  ASSERT_TRUE(window->files().save_to(QString::fromStdString(view)));
  ASSERT_TRUE(run(fmt::format("{} -q '{}' --view '{}' --pixel 80,60 > '{}'", HIAC_RENDER, sample(),
                              view, told)));
  EXPECT_EQ(window->pixel_panel().text().toStdString(), hiac::test::bytes_of(told));
  window->view().set_size({70, 120});
  EXPECT_TRUE(window->pixel_panel().isEnabled());
  EXPECT_TRUE(window->pixel_panel().text().isEmpty());
  EXPECT_TRUE(window.rest());
}

TEST(Window, BringsWhatIsSeenToTheCentre) {
  OpenWindow window;
  ASSERT_TRUE(window.open(sample(), small_view(window)));
  for (const bool has_skin : {false, true}) {
    if (has_skin)
      window->document().edit(QStringLiteral("skin"),
                              window->document().text() + "\n[skin]\nopacity = 0.2\n");
    ASSERT_TRUE(window.rest());
    const Camera before = *window->view().camera();
    const QPoint pixel(60, 70);
    const auto point_there = [&](double depth) {
      return point_at(before, window->document().scene().image, pixel.x() + 0.5, pixel.y() + 0.5,
                      depth);
    };
    Q_EMIT window->viewport().centre_chosen(pixel);
    ASSERT_TRUE(wait_until([&] { return *window->view().camera() != before; }));
    const Camera after = *window->view().camera();
    EXPECT_EQ(after.up, before.up);
    // the new centre is on the ray of the pixel, in the depths of the mesh
    double depth = 0;
    const auto ahead = axes_of(before).ahead;
    for (std::size_t c = 0; c < 3; ++c) depth += (after.look_at[c] - before.eye[c]) * ahead[c];
    const auto expected = point_there(depth);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(after.look_at[c], expected[c], 1e-9);
    EXPECT_GT(depth, window->view().depths()[0]);
    EXPECT_LT(depth, window->view().depths()[1]);
  }
}

// Edits are made in the thread of the window, many a second while the mouse moves.
TEST(Window, MovesTheCameraWithinAFewMilliseconds) {
  OpenWindow window;
  ASSERT_TRUE(window.open(sample(), small_view(window)));
  std::vector<double> took;
  for (int k = 0; k < 100; ++k) {
    const double start = seconds_now();
    window->view().move_camera(orbited(*window->view().camera(), 1, 0.5), QStringLiteral("turn"),
                               k > 0);
    took.push_back(seconds_now() - start);
  }
  std::ranges::sort(took);
  std::printf("a movement takes %.2f ms of the window's thread\n", 1000 * took[50]);
  EXPECT_LT(took[50], hiac::test::kInstrumented ? 0.5 : 0.02);
}

TEST(Window, SavesWithCommentsAndOpensAgain) {
  OpenWindow window;
  const std::string view = small_view(window);
  ASSERT_TRUE(window.open(sample(), view));
  trigger(window, "projection");
  const std::string text = window->document().text();
  const std::string saved = window.file("other.toml");
  ASSERT_TRUE(window->files().save_to(QString::fromStdString(saved)));
  EXPECT_EQ(hiac::test::bytes_of(saved), text);
  EXPECT_EQ(std::ranges::count(text, '#'), std::ranges::count(hiac::test::bytes_of(view), '#'));
  window->files().open_file(QString::fromStdString(view));
  EXPECT_NE(window->document().text(), text);
  window->files().open_file(QString::fromStdString(saved));
  EXPECT_EQ(window->document().text(), text);
  EXPECT_TRUE(window.rest());
}

TEST(Window, RefusesATextThatDoesNotParseAndTellsWhy) {
  OpenWindow window;
  ASSERT_TRUE(window.open(sample(), small_view(window)));
  const std::string text = window->document().text();
  EXPECT_FALSE(window->document().edit(QStringLiteral("fault"), text + "\nnonsense = 1\n"));
  EXPECT_EQ(window->document().text(), text);
  EXPECT_TRUE(window->messages().text().contains(QStringLiteral("nonsense")));
}

TEST(Window, TellsWhyAMeshCannotBeRead) {
  OpenWindow window;
  tools::PictureCommand command;
  command.input = window.file("missing.zoo");
  window->files().open(command);
  EXPECT_TRUE(wait_until([&] { return !window->messages().text().isEmpty(); }));
  EXPECT_TRUE(window->messages().text().contains(QStringLiteral("missing.zoo")));
  EXPECT_FALSE(window->document().has_scene());
}

TEST(Window, CopiesACommandThatMakesItsPicture) {
  OpenWindow window;
  ASSERT_TRUE(window.open(sample(), small_view(window)));
  trigger(window, "reset");
  ASSERT_TRUE(window.rest());
  trigger(window, "copy_command");
  EXPECT_TRUE(window->messages().text().contains(QStringLiteral("Save")));
  const std::vector<std::uint8_t> expected = rendered(window, sample());
  trigger(window, "copy_command");
  const std::string line = QGuiApplication::clipboard()->text().toStdString();
  EXPECT_EQ(line, fmt::format("hiac-render {} --view {} -o picture.png",
                              std::filesystem::path(sample()).lexically_normal().string(),
                              window.file("saved.toml")));
  EXPECT_TRUE(window->picture()->bytes == expected);
}

TEST(Window, ExportsItsPictureWithTheSpecification) {
  OpenWindow window;
  ASSERT_TRUE(window.open(sample(), small_view(window)));
  for (const char* name : {"picture.png", "picture.exr", "picture.npy"}) {
    const std::string file = window.file(name);
    window->files().export_picture(QString::fromStdString(file), window->picture());
    ASSERT_TRUE(wait_until([&] { return !window->files().is_busy(); }));
    const ImageFile image = read_image(file);
    EXPECT_EQ(image.image.width(), 161U);
    if (std::string_view(name) == "picture.npy")
      EXPECT_TRUE(std::ranges::equal(image.image.values(), window->picture()->image->values()));
    else
      EXPECT_EQ(std::ranges::count(image.attributes, "hiac:specification",
                                   &std::pair<std::string, std::string>::first),
                1);
  }
  // over the mesh itself, nothing is written
  window->files().export_picture(QString::fromStdString(sample()), window->picture());
  EXPECT_TRUE(
      wait_until([&] { return window->messages().text().contains(QStringLiteral("flow.zoo")); }));
}

TEST(Window, RecordsKeyframesAndShowsTheirFrames) {
  OpenWindow window;
  ASSERT_TRUE(window.open(sample(), small_view(window)));
  const std::string before = window->document().text();
  const Camera first = *window->view().camera();
  window->view().record_keyframe(10);
  window->view().set_frame(10);
  trigger(window, "axis_views");
  const Camera last = *window->view().camera();
  EXPECT_NE(first, last);
  window->view().record_keyframe(5);
  const auto& path = std::get<KeyframePath>(*window->document().scene().path);
  ASSERT_EQ(path.keyframes.size(), 3U);
  EXPECT_EQ(path.keyframes[0].camera, first);
  EXPECT_EQ(path.keyframes[1].camera, last);
  EXPECT_EQ(path.keyframes[2].camera, last);
  window->view().set_frame(3);
  const std::string text = window->document().text();
  trigger(window, "reset");  // between keyframes there is nothing to edit
  EXPECT_EQ(window->document().text(), text);
  EXPECT_TRUE(window->messages().text().contains(QStringLiteral("keyframe")));
  EXPECT_TRUE(window.rest());
  while (window->document().undo_stack().canUndo()) window->document().undo_stack().undo();
  EXPECT_EQ(window->document().text(), before);
}

TEST(Window, ShowsRealFiles) {
  if (!std::filesystem::is_directory(data_folder()))
    GTEST_SKIP() << "SKIPPED: no folder of data (HIAC_DATA_DIR)";
  const std::vector<std::string> files{
      "abaqus/c3d15.inp",       "ansys_cdb/HexBeam.cdb",    "avs_ucd/gerold_1.inp",
      "calculix_frd/C3D15.frd", "gambit/prism.neu",         "gmsh/piece.asc.v41.msh",
      "mfem/beam-hex.mesh",     "medit/cube-cylinder.mesh", "mfem/beam-tet.mesh",
      "abaqus/beam10p.inp",     "calculix_frd/mesh.frd",    "calculix_frd/furnace.frd"};
  constexpr std::size_t kFiles = hiac::test::kInstrumented ? 2 : 12;
  std::mt19937_64 random(12);
  for (const std::string& name : std::span(files).first(kFiles)) {
    const std::string file = data_folder() + "/" + name;
    OpenWindow window;
    ASSERT_TRUE(window.open(file)) << name << ": " << window->messages().text().toStdString();
    window->view().set_size({120, 90});
    window->document().undo_stack().clear();
    const std::string before = window->document().text();
    drag(window->viewport(), Qt::LeftButton, Qt::NoModifier, {300, 300}, {70, 50});
    drag(window->viewport(), Qt::RightButton, Qt::NoModifier, {300, 300}, {0, -40});
    ASSERT_TRUE(window.rest()) << name;
    EXPECT_TRUE(window->picture()->bytes == rendered(window, file)) << name;
    while (window->document().undo_stack().canUndo()) window->document().undo_stack().undo();
    EXPECT_EQ(window->document().text(), before) << name;
  }
}

}  // namespace
}  // namespace hiac::view::test

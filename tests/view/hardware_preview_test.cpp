#include "tools/view/viewport/hardware_preview.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/image/display_bytes.hpp"
#include "hiac/scene/camera_motion.hpp"
#include "hiac/session/session.hpp"
#include "tests/view/drawing_log.hpp"

namespace hiac::view {
namespace {

bool has_driver() {
  try {
    const HardwarePreview preview;
    return true;
  } catch (const Error&) {
    return false;
  }
}

double largest_difference(const Painted& a, const Painted& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.bytes.size(); ++k)
    largest = std::max(largest, std::abs(static_cast<double>(a.bytes[k]) - b.bytes[k]));
  return largest;
}

// The first picture says which device drew it and is close to the exact one, which follows.
TEST(HardwarePreview, ComesFirstIfThatIsWanted) {
  if (!has_driver()) GTEST_SKIP() << "no OpenGL 4.5 driver";
  for (const auto cut : {hiac::test::Cut::tetrahedra, hiac::test::Cut::bricks}) {
    Wanted wanted = test::wanted_of(4, {160, 120}, cut);
    wanted.hardware = true;
    Drawing drawing;
    test::DrawingLog log(drawing);
    for (int turn = 0; turn < 2; ++turn) {
      log.painted.clear();
      ASSERT_TRUE(log.rests(drawing.show(wanted))) << turn;
      ASSERT_EQ(log.faults.size(), 0) << log.faults.value(0).toStdString();
      ASSERT_EQ(log.painted.size(), 2U);
      EXPECT_FALSE(log.painted[0]->device.empty());
      EXPECT_EQ(log.painted[0]->image, nullptr);  // is not exported
      EXPECT_TRUE(log.painted[1]->device.empty());
      // linear tetrahedra are drawn as they are, bricks by tetrahedra
      EXPECT_LE(largest_difference(*log.painted[0], *log.painted[1]),
                cut == hiac::test::Cut::tetrahedra ? 1 : 12);
      const Picture expected = Session(ZooMesh(*wanted.mesh)).picture(wanted.scene);
      EXPECT_TRUE(log.painted[1]->bytes == display_bytes(expected.image));
      wanted.scene.camera = orbited(wanted.scene.camera, 25, 10);
    }
    // what it does not draw is drawn by the exact engine alone
    log.painted.clear();
    wanted.scene.skin = Skin{};
    ASSERT_TRUE(log.rests(drawing.show(wanted)));
    for (const auto& picture : log.painted) EXPECT_TRUE(picture->device.empty());
  }
}

TEST(HardwarePreview, GoesOnExactlyWhereThereIsNoGraphicsDriver) {
  // EGL looks for drivers once a process: this one has not begun to
  if (std::getenv("HIAC_WITHOUT_DRIVER") == nullptr) {
    const std::string again =
        "HIAC_WITHOUT_DRIVER=1 LIBGL_DRIVERS_PATH=/nowhere __EGL_VENDOR_LIBRARY_FILENAMES=/nowhere "
        "'" +
        QCoreApplication::applicationFilePath().toStdString() +
        "' --gtest_filter=HardwarePreview.GoesOnExactlyWhereThereIsNoGraphicsDriver";
    ASSERT_EQ(std::system(again.c_str()), 0);
    return;
  }
  Wanted wanted = test::wanted_of(4, {90, 60});
  wanted.hardware = true;
  ASSERT_TRUE(HardwarePreview::draws(wanted.scene));
  Drawing drawing;
  test::DrawingLog log(drawing);
  ASSERT_TRUE(log.rests(drawing.show(wanted)));
  ASSERT_EQ(log.faults.size(), 1);
  EXPECT_TRUE(log.faults[0].startsWith(QStringLiteral("No hardware preview: ")));
  wanted.scene.camera = orbited(wanted.scene.camera, 25, 10);
  ASSERT_TRUE(log.rests(drawing.show(wanted)));
  EXPECT_EQ(log.faults.size(), 1);  // told once
  for (const auto& picture : log.painted) EXPECT_TRUE(picture->device.empty());
  const Picture expected = Session(ZooMesh(*wanted.mesh)).picture(wanted.scene);
  EXPECT_TRUE(log.painted.back()->bytes == display_bytes(expected.image));
}

}  // namespace
}  // namespace hiac::view

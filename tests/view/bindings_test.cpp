#include "tools/view/viewport/bindings.hpp"

#include <QStringList>

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace hiac::view {
namespace {

class BindingsTest : public ::testing::Test {
 protected:
  Bindings read() { return {settings_, faults_}; }

  hiac::test::ScratchFolder folder_;
  QSettings settings_{QString::fromStdString(folder_.file("s.ini")), QSettings::IniFormat};
  QStringList faults_;
};

TEST_F(BindingsTest, AreTheUsualOnesWithoutSettings) {
  const Bindings bindings = read();
  EXPECT_EQ(bindings.gesture(Qt::LeftButton, Qt::NoModifier), Gesture::turn);
  EXPECT_EQ(bindings.gesture(Qt::MiddleButton, Qt::NoModifier), Gesture::pan);
  EXPECT_EQ(bindings.gesture(Qt::LeftButton, Qt::ShiftModifier), Gesture::pan);
  EXPECT_EQ(bindings.gesture(Qt::RightButton, Qt::NoModifier), Gesture::zoom);
  EXPECT_EQ(bindings.gesture(Qt::LeftButton, Qt::ControlModifier), Gesture::roll);
  EXPECT_EQ(bindings.gesture(Qt::LeftButton, Qt::ControlModifier | Qt::ShiftModifier),
            std::nullopt);
  EXPECT_EQ(bindings.key(QStringLiteral("reset")), QKeySequence(Qt::Key_R));
  EXPECT_EQ(bindings.key(QStringLiteral("no such action")), QKeySequence());
  EXPECT_TRUE(faults_.isEmpty());
}

TEST_F(BindingsTest, AreThoseOfTheSettings) {
  settings_.setValue(QStringLiteral("mouse/left"), QStringLiteral("zoom"));
  settings_.setValue(QStringLiteral("mouse/right"), QString());
  settings_.setValue(QStringLiteral("keys/reset"), QStringLiteral("Ctrl+F"));
  const Bindings bindings = read();
  EXPECT_EQ(bindings.gesture(Qt::LeftButton, Qt::NoModifier), Gesture::zoom);
  EXPECT_EQ(bindings.gesture(Qt::RightButton, Qt::NoModifier), std::nullopt);
  EXPECT_EQ(bindings.gesture(Qt::MiddleButton, Qt::NoModifier), Gesture::pan);
  EXPECT_EQ(bindings.key(QStringLiteral("reset")), QKeySequence(Qt::CTRL | Qt::Key_F));
  EXPECT_TRUE(faults_.isEmpty());
}

TEST_F(BindingsTest, TellOfAGestureThatDoesNotExist) {
  settings_.setValue(QStringLiteral("mouse/left"), QStringLiteral("fly"));
  EXPECT_EQ(read().gesture(Qt::LeftButton, Qt::NoModifier), Gesture::turn);
  ASSERT_EQ(faults_.size(), 1);
  EXPECT_TRUE(faults_[0].contains(QStringLiteral("fly")));
}

}  // namespace
}  // namespace hiac::view

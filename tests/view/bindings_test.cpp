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

TEST_F(BindingsTest, GiveEveryButtonAndModifierItsGesture) {
  struct Usual {
    const char* name;
    Qt::MouseButton button;
    Qt::KeyboardModifiers modifiers;
    Gesture gesture;
    const char* text;
  };
  const Usual all[] = {
      {"left", Qt::LeftButton, Qt::NoModifier, Gesture::turn, "turn the camera about the centre"},
      {"middle", Qt::MiddleButton, Qt::NoModifier, Gesture::pan, "move the picture"},
      {"right", Qt::RightButton, Qt::NoModifier, Gesture::zoom, "zoom"},
      {"shift+left", Qt::LeftButton, Qt::ShiftModifier, Gesture::pan, "move the picture"},
      {"ctrl+left", Qt::LeftButton, Qt::ControlModifier, Gesture::roll,
       "roll about the line of sight"},
      {"shift+middle", Qt::MiddleButton, Qt::ShiftModifier, Gesture::zoom, "zoom"},
      {"ctrl+middle", Qt::MiddleButton, Qt::ControlModifier, Gesture::roll,
       "roll about the line of sight"},
      {"shift+right", Qt::RightButton, Qt::ShiftModifier, Gesture::roll,
       "roll about the line of sight"},
      {"ctrl+right", Qt::RightButton, Qt::ControlModifier, Gesture::roll,
       "roll about the line of sight"}};
  const Bindings bindings = read();
  const auto lines = bindings.lines();
  ASSERT_EQ(lines.size(), std::size(all));
  for (std::size_t k = 0; k < lines.size(); ++k) {
    EXPECT_EQ(bindings.gesture(all[k].button, all[k].modifiers), all[k].gesture) << all[k].name;
    // other modifiers change nothing
    EXPECT_EQ(bindings.gesture(all[k].button, all[k].modifiers | Qt::AltModifier), all[k].gesture);
    EXPECT_EQ(lines[k].first, QLatin1String(all[k].name));
    EXPECT_EQ(lines[k].second, QLatin1String(all[k].text));
  }
  EXPECT_EQ(bindings.gesture(Qt::BackButton, Qt::NoModifier), std::nullopt);
}

TEST_F(BindingsTest, LeaveOutWhatIsNotWanted) {
  settings_.setValue(QStringLiteral("mouse/right"), QString());
  settings_.setValue(QStringLiteral("keys/reset"), QString());
  const Bindings bindings = read();
  EXPECT_EQ(bindings.lines().size(), 8U);
  EXPECT_TRUE(bindings.key(QStringLiteral("reset")).isEmpty());
  EXPECT_TRUE(faults_.isEmpty());
}

TEST_F(BindingsTest, TellOfAKeyThatDoesNotExist) {
  settings_.setValue(QStringLiteral("keys/reset"), QStringLiteral("Ctrl+Nonsense"));
  settings_.setValue(QStringLiteral("mouse/shift+left"), QStringLiteral("fly"));
  const Bindings bindings = read();
  EXPECT_EQ(bindings.key(QStringLiteral("reset")), QKeySequence(Qt::Key_R));
  EXPECT_EQ(bindings.gesture(Qt::LeftButton, Qt::ShiftModifier), Gesture::pan);
  EXPECT_EQ(faults_,
            (QStringList{QStringLiteral("settings: mouse/shift+left: expected turn, pan, zoom or "
                                        "roll (found fly)"),
                         QStringLiteral("settings: keys/reset: no key is called Ctrl+Nonsense")}));
}

}  // namespace
}  // namespace hiac::view

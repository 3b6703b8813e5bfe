// The panels of the clipping slab and of the camera path, and the line of messages.

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>
#include <limits>

#include <gtest/gtest.h>

#include "tests/view/open_window.hpp"
#include "tools/view/window/clip_panel.hpp"
#include "tools/view/window/message_line.hpp"
#include "tools/view/window/path_panel.hpp"

namespace hiac::view {
namespace {

using Slab = std::array<double, 2>;

class ClipPanelTest : public ::testing::Test {
 protected:
  struct Told {
    std::optional<Slab> clip;
    bool goes_on;
    bool operator==(const Told&) const = default;
  };
  ClipPanelTest() {
    QObject::connect(&panel_, &ClipPanel::clip_changed, &panel_,
                     [this](const std::optional<Slab>& clip, bool goes_on) {
                       told_.push_back({clip, goes_on});
                     });
  }
  void show(std::optional<Slab> clip, const Slab& depths,
            Projection projection = Projection::perspective) {
    Camera camera;
    camera.projection = projection;
    camera.clip = clip;
    panel_.show_camera(camera, depths);
  }
  QSlider& slider(int k) { return *panel_.findChildren<QSlider*>().at(k); }
  QDoubleSpinBox& number(int k) { return *panel_.findChildren<QDoubleSpinBox*>().at(k); }
  QCheckBox& is_on() { return *panel_.findChild<QCheckBox*>(); }
  Slab numbers() { return {number(0).value(), number(1).value()}; }

  ClipPanel panel_;
  std::vector<Told> told_;
};

TEST_F(ClipPanelTest, IsOffWithoutACameraAndWithoutASlab) {
  EXPECT_FALSE(panel_.isEnabled());
  show(std::nullopt, {2, 10});
  EXPECT_TRUE(panel_.isEnabled());
  EXPECT_FALSE(is_on().isChecked());
  for (int k = 0; k < 2; ++k) {
    EXPECT_FALSE(slider(k).isEnabled());
    EXPECT_FALSE(number(k).isEnabled());
    EXPECT_EQ(slider(k).value(), 1000 * k);
  }
  EXPECT_EQ(numbers(), (Slab{2, 10}));
  EXPECT_TRUE(told_.empty());  // what is shown is no change
  is_on().setChecked(true);
  is_on().setChecked(false);
  EXPECT_EQ(told_, (std::vector<Told>{{Slab{2, 10}, false}, {std::nullopt, false}}));
  panel_.show_camera(std::nullopt, {2, 10});
  EXPECT_FALSE(panel_.isEnabled());
}

TEST_F(ClipPanelTest, ShowsTheSlabAmongTheDepths) {
  show(Slab{3, 5}, {1, 11});
  EXPECT_TRUE(is_on().isChecked());
  EXPECT_EQ(numbers(), (Slab{3, 5}));
  for (int k = 0; k < 2; ++k) {
    EXPECT_TRUE(slider(k).isEnabled());
    EXPECT_TRUE(number(k).isEnabled());
    EXPECT_EQ(slider(k).minimum(), 0);
    EXPECT_EQ(slider(k).maximum(), 1000);
    EXPECT_EQ(slider(k).value(), 200 * (k + 1));
    EXPECT_DOUBLE_EQ(number(k).singleStep(), 0.1);
  }
  show(Slab{-5, 50}, {1, 11}, Projection::orthographic);  // beyond the mesh
  EXPECT_EQ(slider(0).value(), 0);
  EXPECT_EQ(slider(1).value(), 1000);
  EXPECT_EQ(numbers(), (Slab{-5, 50}));
  show(Slab{3, std::numeric_limits<double>::infinity()}, {1, 11});
  EXPECT_EQ(slider(1).value(), 1000);
  EXPECT_EQ(number(1).value(), kLargestNumber);
  EXPECT_TRUE(told_.empty());
}

TEST_F(ClipPanelTest, BeginsAtTheEyeInPerspectiveAlone) {
  show(std::nullopt, {-4, 6});
  EXPECT_EQ(numbers(), (Slab{0, 6}));
  EXPECT_EQ(number(0).minimum(), 0);
  EXPECT_EQ(number(1).maximum(), kLargestNumber);
  show(std::nullopt, {-4, 6}, Projection::orthographic);
  EXPECT_EQ(numbers(), (Slab{-4, 6}));
  EXPECT_EQ(number(0).minimum(), -kLargestNumber);
  // a mesh behind the eye, and one without extent
  show(std::nullopt, {-4, -2});
  EXPECT_EQ(numbers(), (Slab{0, 1}));
  show(std::nullopt, {5, 5});
  EXPECT_EQ(numbers(), (Slab{5, 6}));
}

TEST_F(ClipPanelTest, ShowsThreeMoreDigitsThanTheDepthsHave) {
  for (const auto& [size, decimals] :
       {std::pair(1.0, 3), {0.99, 4}, {0.05, 5}, {1000.0, 0}, {999.0, 1}, {1e7, 0}, {2e-15, 12}}) {
    show(std::nullopt, {0, size});
    EXPECT_EQ(number(0).decimals(), decimals) << size;
    EXPECT_EQ(number(1).decimals(), decimals) << size;
  }
}

TEST_F(ClipPanelTest, SlidesInOneEdit) {
  show(Slab{3, 5}, {1, 11});
  slider(0).setValue(300);  // by a key
  EXPECT_EQ(told_, (std::vector<Told>{{Slab{4, 5}, false}}));
  told_.clear();
  slider(1).setSliderDown(true);
  slider(1).setValue(600);
  slider(1).setValue(800);
  slider(1).setSliderDown(false);
  slider(1).setValue(900);
  EXPECT_EQ(told_,
            (std::vector<Told>{{Slab{3, 7}, false}, {Slab{3, 9}, true}, {Slab{3, 10}, false}}));
  // a slider that is held stays below the mouse
  slider(1).setSliderDown(true);
  show(Slab{3, 5}, {1, 11});
  EXPECT_EQ(slider(1).value(), 900);
  EXPECT_EQ(number(1).value(), 5);
  slider(1).setSliderDown(false);
}

TEST_F(ClipPanelTest, TakesTypedNumbersAndKeepsThePlanesApart) {
  show(Slab{3, 5}, {1, 11});
  number(1).setValue(20);
  EXPECT_EQ(told_, (std::vector<Told>{{Slab{3, 20}, false}}));
  number(0).setValue(0.5);
  EXPECT_EQ(told_.back(), (Told{Slab{0.5, 5}, false}));
  told_.clear();
  for (const double wrong : {5.0, 7.0}) number(0).setValue(wrong);
  for (const double wrong : {3.0, 2.0}) number(1).setValue(wrong);
  slider(0).setValue(900);
  EXPECT_TRUE(told_.empty());
}

class PathPanelTest : public ::testing::Test {
 protected:
  PathPanelTest() {
    QObject::connect(&panel_, &PathPanel::frame_chosen, &panel_,
                     [this](std::uint32_t frame) { frames_.push_back(frame); });
    QObject::connect(&panel_, &PathPanel::record_wanted, &panel_,
                     [this](std::uint32_t frame) { recorded_.push_back(frame); });
  }
  QSlider& slider() { return *panel_.findChild<QSlider*>(); }
  QSpinBox& record_at() { return *panel_.findChild<QSpinBox*>(); }
  QPushButton& play() { return *panel_.findChildren<QPushButton*>().at(0); }
  QPushButton& record() { return *panel_.findChildren<QPushButton*>().at(1); }
  QString label() { return panel_.findChild<QLabel*>()->text(); }

  PathPanel panel_;
  std::vector<std::uint32_t> frames_, recorded_;
};

TEST_F(PathPanelTest, OfOneCameraCanOnlyRecord) {
  EXPECT_EQ(label(), QStringLiteral("one camera, no path"));
  EXPECT_FALSE(slider().isEnabled());
  EXPECT_FALSE(play().isEnabled());
  EXPECT_TRUE(record().isEnabled());
  EXPECT_EQ(record_at().minimum(), 1);  // frame 0 is the camera that there is
  EXPECT_EQ(record_at().maximum(), 99999);
  EXPECT_EQ(panel_.record_frame(), 25U);
  record().click();
  EXPECT_EQ(recorded_, std::vector<std::uint32_t>{25});
  panel_.show_path(1, 0, false);
  EXPECT_FALSE(record().isEnabled());
  EXPECT_FALSE(record_at().isEnabled());
  record_at().setValue(7);
  panel_.show_path(1, 0, true);  // what was typed stays
  EXPECT_EQ(panel_.record_frame(), 7U);
  panel_.play(true);
  EXPECT_FALSE(panel_.is_playing());
}

TEST_F(PathPanelTest, ShowsAFrameOfAPath) {
  panel_.show_path(11, 3, true);
  EXPECT_EQ(label(), QStringLiteral("frame 3 of 0 to 10"));
  EXPECT_TRUE(slider().isEnabled());
  EXPECT_TRUE(play().isEnabled());
  EXPECT_EQ(slider().minimum(), 0);
  EXPECT_EQ(slider().maximum(), 10);
  EXPECT_EQ(slider().value(), 3);
  EXPECT_EQ(record_at().minimum(), 0);
  EXPECT_EQ(panel_.record_frame(), 3U);
  panel_.show_path(11, 5, true);
  EXPECT_EQ(panel_.record_frame(), 3U);  // another frame of the same path
  panel_.show_path(12, 5, true);
  EXPECT_EQ(panel_.record_frame(), 5U);
  EXPECT_TRUE(frames_.empty());  // what is shown is no choice
  slider().setValue(8);
  EXPECT_EQ(frames_, std::vector<std::uint32_t>{8});
  panel_.show_path(2, 1, true);
  EXPECT_TRUE(play().isEnabled());
  EXPECT_EQ(label(), QStringLiteral("frame 1 of 0 to 1"));
}

TEST_F(PathPanelTest, PlaysNoFrameBeforeTheLastOneIsDrawn) {
  panel_.show_path(3, 1, true);
  panel_.picture_drawn();  // nothing is played
  EXPECT_TRUE(frames_.empty());
  play().click();
  EXPECT_TRUE(panel_.is_playing());
  panel_.picture_drawn();  // too early: a frame stays a twenty-fifth of a second
  EXPECT_TRUE(frames_.empty());
  ASSERT_TRUE(test::wait_until([&] { return !frames_.empty(); }));
  EXPECT_EQ(frames_, std::vector<std::uint32_t>{2});
  for (const std::uint32_t next : {0U, 1U}) {  // from the start again
    const std::size_t before = frames_.size();
    QTest::qWait(100);
    EXPECT_EQ(frames_.size(), before);  // not drawn yet
    panel_.picture_drawn();
    EXPECT_EQ(frames_.size(), before + 1);
    EXPECT_EQ(frames_.back(), next);
  }
  play().click();
  EXPECT_FALSE(panel_.is_playing());
  panel_.picture_drawn();
  EXPECT_EQ(frames_.size(), 3U);
}

TEST_F(PathPanelTest, StopsWhereThePathIsGone) {
  panel_.show_path(3, 0, true);
  panel_.play(true);
  EXPECT_TRUE(play().isChecked());
  panel_.show_path(4, 0, true);
  EXPECT_TRUE(panel_.is_playing());
  panel_.show_path(1, 0, true);
  EXPECT_FALSE(panel_.is_playing());
  EXPECT_FALSE(play().isChecked());
}

TEST(MessageLine, IsThereAsLongAsThereIsAMessage) {
  MessageLine line;
  EXPECT_TRUE(line.isHidden());
  line.tell(QStringLiteral("<b>no</b> & such file"));
  EXPECT_FALSE(line.isHidden());
  EXPECT_EQ(line.text(), QStringLiteral("<b>no</b> & such file"));
  const auto* label = line.findChild<QLabel*>();
  EXPECT_EQ(label->textFormat(), Qt::PlainText);
  EXPECT_TRUE(label->wordWrap());
  EXPECT_TRUE(label->textInteractionFlags().testFlag(Qt::TextSelectableByMouse));
  // both colours are those of hints: one that is readable on the other
  EXPECT_EQ(line.backgroundRole(), QPalette::ToolTipBase);
  EXPECT_EQ(label->foregroundRole(), QPalette::ToolTipText);
  EXPECT_TRUE(line.autoFillBackground());
  line.findChild<QToolButton*>()->click();
  EXPECT_TRUE(line.isHidden());
  EXPECT_TRUE(line.text().isEmpty());
}

}  // namespace
}  // namespace hiac::view

// The window around the picture: its menus, docks, title, lines and files.

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QStatusBar>
#include <QTimer>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hiac/mesh/zoo_container.hpp"
#include "hiac/scene/camera_motion.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "tests/support/meshes.hpp"
#include "tests/view/open_window.hpp"
#include "tests/view/small_view.hpp"

namespace hiac::view::test {
namespace {

const std::string kMenusView = kSmallView + R"([volume.color]
field = "f"
points = [[0, 0.0, 0.0, 1.0], [1, 1.0, 0.0, 0.0]]
[volume.extinction]
field = "f"
points = [[0.0, 0.5], [1.0, 8.0]]
)";

class WindowMenus : public ::testing::Test {
 protected:
  void SetUp() override {
    ZooMesh mesh = hiac::test::structured(2, hiac::test::Cut::tetrahedra);
    hiac::test::add_node_field(mesh, "f", [](auto&& p) { return p[0]; });
    mesh_ = window_.file("m.zoo");
    write_zoo_file(mesh_, {mesh, {}});
    view_ = window_.write("view.toml", kMenusView);
  }
  QAction& action(const char* name) {
    auto* found = window_->findChild<QAction*>(QLatin1String(name));
    EXPECT_NE(found, nullptr) << name;
    return *found;
  }
  [[nodiscard]] Camera camera() { return *window_->view().camera(); }
  /// Answers the question that comes next.
  void answer(QMessageBox::StandardButton button, int* asked) {
    QTimer::singleShot(0, &*window_, [button, asked] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (box == nullptr) return;
      ++*asked;
      box->button(button)->click();
    });
  }
  void set(const char* key, const char* value) {
    EXPECT_TRUE(window_->document().edit(QStringLiteral("set"),
                                         with_key(window_->document().text(), key, value)));
  }

  OpenWindow window_;
  std::string mesh_, view_;
};

TEST_F(WindowMenus, HaveTheKeysOfTheTableAndSayWhatTheyDo) {
  struct Entry {
    const char *menu, *name, *text, *key;
  };
  const Entry entries[] = {{"&File", "open_mesh", "Open &mesh...", "Ctrl+O"},
                           {"&File", "open_view", "&Open specification...", "Ctrl+Shift+O"},
                           {"&File", "reload", "&Read the mesh again", "F5"},
                           {"&File", "save", "&Save specification", "Ctrl+S"},
                           {"&File", "save_as", "Save specification &as...", "Ctrl+Shift+S"},
                           {"&File", "export_picture", "&Export picture...", "S"},
                           {"&File", "copy_command", "&Copy command", "Ctrl+Shift+C"},
                           {"&File", "quit", "&Quit", "Q"},
                           {"&Edit", "undo", "&Undo", "Ctrl+Z"},
                           {"&Edit", "redo", "&Redo", "Ctrl+Shift+Z"},
                           {"&Edit", "add_bump", "Add a &bump", "B"},
                           {"&View", "reset", "&Reset", "R"},
                           {"&View", "axis_views", "Next &axis view", "Shift+R"},
                           {"&View", "projection", "&Perspective or parallel", "J"},
                           {"&View", "color_bar", "&Colour bar", "C"},
                           {"&View", "fit_window", "Picture as large as the &window", "F"},
                           {"&View", "hardware_preview", "&Hardware preview while moving", ""},
                           {"&View", "explain_pixel", "&Explain the pixel", "P"},
                           {"&View", "play", "Pla&y the camera path", "Space"},
                           {"&View", "record_keyframe", "Record &keyframe", "K"},
                           {"&Help", "help", "&Mouse and keys", "H"}};
  const auto menus = window_->menuBar()->actions();
  for (const Entry& entry : entries) {
    QAction& found = action(entry.name);
    const auto menu = std::ranges::find(menus, QLatin1String(entry.menu), &QAction::text);
    ASSERT_NE(menu, menus.end()) << entry.menu;
    EXPECT_TRUE((*menu)->menu()->actions().contains(&found)) << entry.name;
    EXPECT_TRUE(found.text().startsWith(QLatin1String(entry.text))) << found.text().toStdString();
    EXPECT_EQ(found.shortcut().toString(), QLatin1String(entry.key));
    if (entry.menu != std::string_view("&Edit") || entry.name == std::string_view("add_bump")) {
      EXPECT_GT(found.statusTip().size(), 10) << entry.name;
      EXPECT_EQ(found.toolTip(), found.statusTip());
    }
  }
  QStringList titles;
  for (const QAction* menu : menus) titles << menu->text();
  EXPECT_EQ(titles.join(QLatin1Char(' ')), QStringLiteral("&File &Edit &View &Panels &Help"));
}

TEST_F(WindowMenus, LookFromEverySide) {
  ASSERT_TRUE(window_.open(mesh_, view_));
  const char* const axes = "xyz";
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool minus : {false, true}) {
      QAction& look =
          action(fmt::format("look_from_{}_{}", minus ? "minus" : "plus", axes[axis]).c_str());
      EXPECT_EQ(look.text().toStdString(), fmt::format("{}{}", minus ? "\u2212" : "+", axes[axis]));
      look.trigger();
      const auto ahead = axes_of(camera()).ahead;
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(ahead[c], c != axis ? 0 : minus ? 1 : -1, 1e-9) << look.text().toStdString();
      const auto up = axes_of(camera()).up;
      EXPECT_NEAR(up[axis == 2 ? 1 : 2], 1, 1e-9);
    }
  // one after the other, from the first again
  std::vector<std::array<double, 3>> seen;
  for (int k = 0; k < 7; ++k) {
    action("axis_views").trigger();
    seen.push_back(axes_of(camera()).ahead);
  }
  for (int k = 0; k < 7; ++k) {
    const auto axis = static_cast<std::size_t>(k % 6 / 2);
    EXPECT_NEAR(seen[static_cast<std::size_t>(k)][axis], k % 2 == 0 ? -1 : 1, 1e-9) << k;
  }
}

TEST_F(WindowMenus, FrameTheMeshAndChangeTheProjection) {
  ASSERT_TRUE(window_.open(mesh_, view_));
  set("camera.eye", "[9.0, -30.0, 4.0]");
  const Camera before = camera();
  action("reset").trigger();
  const ImageSize size = window_->document().scene().image;
  EXPECT_EQ(camera(), framing(before, {0.5, 0.5, 0.5}, std::sqrt(3.0) / 2, size));
  const Camera perspective = camera();
  action("projection").trigger();
  EXPECT_EQ(camera(), with_projection(perspective, Projection::orthographic, 30));
  const Camera parallel = camera();
  action("projection").trigger();
  EXPECT_EQ(camera(), with_projection(parallel, Projection::perspective, 30));
  // the depths of a ball around the mesh
  const auto [near, far] = window_->view().depths();
  EXPECT_NEAR(far - near, std::sqrt(3.0), 1e-9);
  const auto ahead = axes_of(camera()).ahead;
  double middle = 0;
  for (std::size_t c = 0; c < 3; ++c) middle += (0.5 - camera().eye[c]) * ahead[c];
  EXPECT_NEAR((near + far) / 2, middle, 1e-9);
}

TEST_F(WindowMenus, SwitchTheColourBarTheSamplesAndTheSize) {
  ASSERT_TRUE(window_.open(mesh_, view_));
  const auto has_bar = [&] {
    return window_->document().parsed().annotation.color_bar.has_value();
  };
  EXPECT_FALSE(has_bar());
  action("color_bar").trigger();
  EXPECT_TRUE(has_bar());
  action("color_bar").trigger();
  EXPECT_FALSE(has_bar());
  for (const int count : {2, 3, 4, 8, 1}) {
    const QString text = QStringLiteral("%1 (--samples %2)").arg(count * count).arg(count);
    QAction* found = nullptr;
    for (auto* some : window_->findChildren<QAction*>())
      if (some->text() == text) found = some;
    ASSERT_NE(found, nullptr) << count;
    EXPECT_TRUE(found->isCheckable());
    found->trigger();
    EXPECT_TRUE(found->isChecked());
    EXPECT_EQ(window_->view().samples(), static_cast<std::uint32_t>(count));
    EXPECT_EQ(window_->view().wanted()->samples, static_cast<std::uint32_t>(count));
  }
  action("fit_window").trigger();
  const ImageSize size = window_->document().scene().image;
  EXPECT_EQ(size.width, static_cast<std::uint32_t>(window_->viewport().width()));
  EXPECT_EQ(size.height, static_cast<std::uint32_t>(window_->viewport().height()));
  EXPECT_TRUE(action("hardware_preview").isCheckable());
  EXPECT_FALSE(action("hardware_preview").isChecked());
}

TEST_F(WindowMenus, ListMouseAndKeysInTheHelp) {
  action("help").trigger();
  QLabel* help = nullptr;
  for (auto* label : window_->findChildren<QLabel*>())
    if (label->windowTitle() == QStringLiteral("Mouse and keys")) help = label;
  ASSERT_NE(help, nullptr);
  EXPECT_TRUE(help->isVisible());
  const auto has = [&](const char* left, const char* right) {
    return help->text().contains(QStringLiteral("<tr><td><b>%1</b></td><td>%2</td></tr>")
                                     .arg(QLatin1String(left), QLatin1String(right)));
  };
  EXPECT_TRUE(has("left", "turn the camera about the centre"));
  EXPECT_TRUE(has("shift+middle", "zoom"));
  EXPECT_TRUE(has("ctrl+right", "roll about the line of sight"));
  EXPECT_TRUE(has("wheel", "zoom"));
  EXPECT_TRUE(has("click", "explain the pixel"));
  EXPECT_TRUE(has("double click", "bring what is seen there to the centre"));
  EXPECT_TRUE(has("Ctrl+O", "Open mesh"));
  EXPECT_TRUE(has("Space", "Play the camera path"));
  // what has no key is not there
  EXPECT_FALSE(help->text().contains(QStringLiteral("Hardware preview")));
  EXPECT_TRUE(help->text().contains(QStringLiteral("settings.ini")));
  action("help").trigger();
  int count = 0;
  for (auto* label : window_->findChildren<QLabel*>())
    count += label->windowTitle() == QStringLiteral("Mouse and keys") ? 1 : 0;
  EXPECT_EQ(count, 1);
}

TEST_F(WindowMenus, PlayThePathAndRecordKeyframes) {
  ASSERT_TRUE(window_.open(mesh_, view_));
  auto* frame = window_->findChild<QDockWidget*>(QStringLiteral("path"))->findChild<QSpinBox*>();
  frame->setValue(7);
  action("record_keyframe").trigger();
  ASSERT_TRUE(window_->document().scene().path.has_value());
  EXPECT_EQ(std::get<KeyframePath>(*window_->document().scene().path).keyframes[1].frame, 7U);
  auto* slider = window_->findChild<QDockWidget*>(QStringLiteral("path"))->findChild<QSlider*>();
  EXPECT_EQ(slider->maximum(), 7);
  action("play").trigger();
  EXPECT_TRUE(wait_until([&] { return window_->view().frame() >= 2; }));
  action("play").trigger();
  const auto now = window_->view().frame();
  EXPECT_TRUE(window_.rest());
  EXPECT_EQ(window_->view().frame(), now);
  slider->setValue(5);
  EXPECT_EQ(window_->view().frame(), 5U);
  window_->view().set_frame(8);  // there is no such
  EXPECT_EQ(window_->view().frame(), 5U);
  window_->document().undo_stack().undo();  // the path is gone
  EXPECT_EQ(window_->view().frame(), 0U);
}

TEST_F(WindowMenus, HavePanelsWithNames) {
  const std::pair<const char*, const char*> expected[] = {{"transfer", "Transfer functions"},
                                                          {"text", "Text"},
                                                          {"pixel", "Pixel"},
                                                          {"clip", "Clip"},
                                                          {"path", "Camera path"}};
  for (const auto& [name, title] : expected) {
    auto* dock = window_->findChild<QDockWidget*>(QLatin1String(name));
    ASSERT_NE(dock, nullptr) << name;
    EXPECT_EQ(dock->windowTitle(), QLatin1String(title));
    EXPECT_NE(dock->widget(), nullptr);
    EXPECT_EQ(window_->dockWidgetArea(dock), Qt::RightDockWidgetArea);
  }
  const auto dock = [&](const char* name) {
    return window_->findChild<QDockWidget*>(QLatin1String(name));
  };
  EXPECT_EQ(window_->tabifiedDockWidgets(dock("transfer")).size(), 2);
  EXPECT_EQ(window_->tabifiedDockWidgets(dock("clip")), QList<QDockWidget*>{dock("path")});
}

// For those who hear the window, and for those who ask what a control does.
TEST_F(WindowMenus, NameWhatCanBeSetAndTypedInto) {
  int count = 0;
  const auto expect_named = [&](const QWidget& widget) {
    ++count;
    EXPECT_FALSE(widget.accessibleName().isEmpty()) << widget.metaObject()->className();
    EXPECT_FALSE(widget.toolTip().isEmpty()) << widget.accessibleName().toStdString();
  };
  for (auto* slider : window_->findChildren<QSlider*>()) expect_named(*slider);
  for (auto* box : window_->findChildren<QComboBox*>()) expect_named(*box);
  for (auto* number : window_->findChildren<QDoubleSpinBox*>()) expect_named(*number);
  for (auto* number : window_->findChildren<QSpinBox*>()) expect_named(*number);
  EXPECT_EQ(count, 4 + 3 + 2 + 1);
  for (auto* box : window_->findChildren<QCheckBox*>()) {
    EXPECT_FALSE(box->toolTip().isEmpty()) << box->text().toStdString();
  }
  for (auto* button : window_->findChildren<QPushButton*>())
    if (!button->text().startsWith(QStringLiteral("Copy"))) {
      EXPECT_FALSE(button->toolTip().isEmpty()) << button->text().toStdString();
    }
  for (auto* text : window_->findChildren<QPlainTextEdit*>()) {
    EXPECT_FALSE(text->accessibleName().isEmpty());
    EXPECT_EQ(text->lineWrapMode(), QPlainTextEdit::NoWrap);
  }
  EXPECT_EQ(window_->viewport().accessibleName(), QStringLiteral("Picture"));
  for (const QWidget* widget : {static_cast<QWidget*>(&window_->viewport()),
                                static_cast<QWidget*>(&window_->transfer_panel().curve())}) {
    EXPECT_EQ(widget->focusPolicy(), Qt::StrongFocus);
    EXPECT_TRUE(widget->hasMouseTracking());  // they tell of what is below the mouse
    EXPECT_FALSE(widget->accessibleName().isEmpty());
  }
  EXPECT_GT(window_->transfer_panel().curve().statusTip().size(), 40);
}

TEST_F(WindowMenus, TellOfFilesAndPixelsInTitleAndStatusLine) {
  EXPECT_EQ(window_->windowTitle(), QStringLiteral("hiac-view"));
  ASSERT_TRUE(window_.open(mesh_));
  EXPECT_EQ(window_->windowTitle(), QStringLiteral("m.zoo \u2013 unsaved view \u2013 hiac-view"));
  set("camera.fov", "25.0");
  EXPECT_FALSE(window_->isWindowModified());  // there is no file that it differs from
  ASSERT_TRUE(window_.open(mesh_, view_));
  EXPECT_EQ(window_->windowTitle(), QStringLiteral("m.zoo \u2013 view.toml[*] \u2013 hiac-view"));
  EXPECT_FALSE(window_->isWindowModified());
  set("camera.fov", "25.0");
  EXPECT_TRUE(window_->isWindowModified());
  ASSERT_TRUE(window_->files().save());
  EXPECT_FALSE(window_->isWindowModified());
  const auto labels = [&] {
    QStringList texts;
    for (const auto* label : window_->statusBar()->findChildren<QLabel*>()) texts << label->text();
    return texts.join(QLatin1Char('|'));
  };
  ASSERT_TRUE(window_.rest());
  EXPECT_TRUE(labels().contains(QStringLiteral("exact: 1200 pixels"))) << labels().toStdString();
  EXPECT_TRUE(labels().contains(QStringLiteral("error at most")));
  Q_EMIT window_->viewport().hovered(QPoint(3, 4));
  EXPECT_TRUE(labels().contains(QStringLiteral("pixel 3,4")));
  Q_EMIT window_->viewport().hovered(std::nullopt);
  EXPECT_FALSE(labels().contains(QStringLiteral("pixel 3,4")));
}

TEST_F(WindowMenus, OpenWhatIsDropped) {
  ASSERT_TRUE(window_.open(mesh_, view_));
  window_->messages().tell(QStringLiteral("old"));
  const std::string other = window_.write("other.toml", with_key(kMenusView, "camera.fov", "20"));
  QMimeData data;
  data.setUrls({QUrl(QStringLiteral("https://example.org/x.toml")),
                QUrl::fromLocalFile(QString::fromStdString(other))});
  QDragEnterEvent enter({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  enter.ignore();
  QCoreApplication::sendEvent(&*window_, &enter);
  EXPECT_TRUE(enter.isAccepted());
  QMimeData text;
  text.setText(QStringLiteral("words"));
  QDragEnterEvent with_text({10, 10}, Qt::CopyAction, &text, Qt::LeftButton, Qt::NoModifier);
  with_text.ignore();
  QCoreApplication::sendEvent(&*window_, &with_text);
  EXPECT_FALSE(with_text.isAccepted());
  QDropEvent drop(QPointF(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&*window_, &drop);
  EXPECT_EQ(window_->document().file(), other);
  EXPECT_EQ(camera().fov, 20);
  EXPECT_TRUE(window_->messages().text().isEmpty());  // what was told is of what was there before
}

TEST_F(WindowMenus, KeepTheFilesOpenedLast) {
  ASSERT_TRUE(window_.open(mesh_, view_));
  const auto names = [&] {
    Q_EMIT window_->files().recent_menu()->aboutToShow();
    QStringList files;
    for (const QAction* entry : window_->files().recent_menu()->actions())
      files << QString::fromStdString(
          std::filesystem::path(entry->text().toStdString()).filename().string());
    return files;
  };
  EXPECT_EQ(names(), (QStringList{QStringLiteral("m.zoo"), QStringLiteral("view.toml")}));
  for (int k = 0; k < 12; ++k)
    window_->files().open_view(QString::fromStdString(
        window_.write(k == 11 ? "a&b.toml" : fmt::format("{}.toml", k), kMenusView)));
  const QStringList found = names();
  ASSERT_EQ(found.size(), 10);
  EXPECT_EQ(found[0], QStringLiteral("a&&b.toml"));  // an ampersand that is shown
  EXPECT_EQ(found[9], QStringLiteral("2.toml"));
  window_->files().recent_menu()->actions()[9]->trigger();
  EXPECT_TRUE(window_->document().file().ends_with("/2.toml"));
  EXPECT_EQ(names()[0], QStringLiteral("2.toml"));
  EXPECT_EQ(names().size(), 10);  // once in the list
  window_->files().recent_menu()->actions()[1]->trigger();
  EXPECT_TRUE(window_->document().file().ends_with("/a&b.toml"));
}

TEST_F(WindowMenus, ReadTheMeshAgainWithTheViewAsItIs) {
  window_->files().reload();  // there is none
  EXPECT_FALSE(window_->files().is_busy());
  ASSERT_TRUE(window_.open(mesh_, view_));
  set("camera.fov", "25.0");
  ZooMesh mesh = hiac::test::structured(3, hiac::test::Cut::tetrahedra);
  hiac::test::add_node_field(mesh, "f", [](auto&& p) { return p[0]; });
  write_zoo_file(mesh_, {mesh, {}});
  action("reload").trigger();
  ASSERT_TRUE(wait_until([&] { return !window_->files().is_busy(); }));
  EXPECT_EQ(window_->document().mesh()->cell_count(), 6U * 27);
  EXPECT_EQ(camera().fov, 25);
  EXPECT_EQ(window_->document().undo_stack().count(), 1);
  EXPECT_TRUE(window_.rest());
}

TEST_F(WindowMenus, AskBeforeChangesAreLost) {
  ASSERT_TRUE(window_.open(mesh_, view_));
  int asked = 0;
  answer(QMessageBox::Cancel, &asked);
  EXPECT_TRUE(window_->close());  // nothing is changed
  EXPECT_EQ(asked, 0);
  QCoreApplication::processEvents();
  window_->show();
  set("camera.fov", "25.0");
  answer(QMessageBox::Cancel, &asked);
  EXPECT_FALSE(window_->close());
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(hiac::test::bytes_of(view_), kMenusView);
  answer(QMessageBox::Save, &asked);
  EXPECT_TRUE(window_->close());
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(hiac::test::bytes_of(view_), window_->document().text());
  window_->show();
  set("camera.fov", "20.0");
  answer(QMessageBox::Discard, &asked);
  action("quit").trigger();
  EXPECT_EQ(asked, 3);
  EXPECT_TRUE(window_->isHidden());
  EXPECT_NE(hiac::test::bytes_of(view_), window_->document().text());
}

TEST(WindowSettings, KeepWhetherHardwareDrawsWhileSomethingMoves) {
  const hiac::test::ScratchFolder folder;
  QSettings settings(QString::fromStdString(folder.file("s.ini")), QSettings::IniFormat);
  const QString key = QStringLiteral("view/hardware_preview");
  settings.setValue(key, true);
  tools::Tool tool("hiac-view", "", "");
  MainWindow window(tool, settings);
  auto* action = window.findChild<QAction*>(QStringLiteral("hardware_preview"));
  EXPECT_TRUE(window.view().hardware());
  EXPECT_TRUE(action->isChecked());
  action->trigger();
  EXPECT_FALSE(window.view().hardware());
  EXPECT_FALSE(action->isChecked());
  EXPECT_FALSE(settings.value(key).toBool());
  action->trigger();
  EXPECT_TRUE(settings.value(key).toBool());
}

}  // namespace
}  // namespace hiac::view::test

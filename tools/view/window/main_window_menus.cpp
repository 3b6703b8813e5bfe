// The menus of the main window.

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QUndoStack>
#include <array>

#include "tools/view/window/main_window.hpp"

namespace hiac::view {

QAction* MainWindow::add_action(QMenu* menu, const QString& text, const QString& name,
                                const QString& tip, const std::function<void()>& action) {
  QAction* added = menu->addAction(text);
  added->setObjectName(name);
  added->setShortcut(bindings_.key(name));
  added->setStatusTip(tip);
  added->setToolTip(tip);
  connect(added, &QAction::triggered, this, action);
  return added;
}

void MainWindow::make_menus() {
  make_file_menu();
  QMenu* edit = menuBar()->addMenu(tr("&Edit"));
  QAction* undo = document_.undo_stack().createUndoAction(this, tr("&Undo"));
  undo->setObjectName(QStringLiteral("undo"));
  undo->setShortcut(bindings_.key(QStringLiteral("undo")));
  QAction* redo = document_.undo_stack().createRedoAction(this, tr("&Redo"));
  redo->setObjectName(QStringLiteral("redo"));
  redo->setShortcut(bindings_.key(QStringLiteral("redo")));
  edit->addAction(undo);
  edit->addAction(redo);
  edit->addSeparator();
  add_action(edit, tr("Add a &bump"), QStringLiteral("add_bump"),
             tr("A peak of the extinction at the value that is seen most at the pixel under the "
                "mouse (Alt+click, too)"),
             [this] {
               const auto place = viewport_->mapFromGlobal(QCursor::pos());
               if (const auto pixel = viewport_->pixel_at(place)) add_bump_at(*pixel);
             });
  make_view_menu();
  QMenu* docks = createPopupMenu();
  docks->setTitle(tr("&Panels"));
  docks->setParent(menuBar(), docks->windowFlags());
  menuBar()->addMenu(docks);
  QMenu* help = menuBar()->addMenu(tr("&Help"));
  add_action(help, tr("&Mouse and keys"), QStringLiteral("help"),
             tr("What the mouse and the keys do"), [this] { show_help(); });
}

void MainWindow::make_file_menu() {
  QMenu* menu = menuBar()->addMenu(tr("&File"));
  add_action(menu, tr("Open &mesh..."), QStringLiteral("open_mesh"),
             tr("A zoo mesh, or any file that hiac-convert reads"),
             [this] { files_.choose_mesh(); });
  add_action(menu, tr("&Open specification..."), QStringLiteral("open_view"),
             tr("A TOML file, or a picture that holds its specification"),
             [this] { files_.choose_view(); });
  menu->addMenu(files_.recent_menu());
  add_action(menu, tr("&Read the mesh again"), QStringLiteral("reload"),
             tr("After a solver has written it anew"), [this] { files_.reload(); });
  menu->addSeparator();
  add_action(menu, tr("&Save specification"), QStringLiteral("save"),
             tr("hiac-render makes this very picture of it"), [this] { files_.save(); });
  add_action(menu, tr("Save specification &as..."), QStringLiteral("save_as"),
             tr("Into another file"), [this] { files_.choose_save(); });
  add_action(menu, tr("&Export picture..."), QStringLiteral("export_picture"),
             tr("In any format of hiac-render, with the specification in it"),
             [this] { files_.choose_export(picture_); });
  add_action(menu, tr("&Copy command"), QStringLiteral("copy_command"),
             tr("The line for a shell that makes this very picture"), [this] { copy_command(); });
  menu->addSeparator();
  add_action(menu, tr("&Quit"), QStringLiteral("quit"), tr("Close the window"),
             [this] { close(); });
}

void MainWindow::make_view_menu() {
  QMenu* menu = menuBar()->addMenu(tr("&View"));
  add_action(menu, tr("&Reset"), QStringLiteral("reset"), tr("All of the mesh, from where you are"),
             [this] { view_.reset(); });
  add_action(menu, tr("Next &axis view"), QStringLiteral("axis_views"),
             tr("The next of the six views along the axes"), [this] { view_.next_axis_view(); });
  QMenu* axes = menu->addMenu(tr("&Look from"));
  const std::array<QString, 3> names{QStringLiteral("x"), QStringLiteral("y"), QStringLiteral("z")};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool backwards : {false, true})
      add_action(axes, (backwards ? QStringLiteral("\u2212") : QStringLiteral("+")) + names[axis],
                 QStringLiteral("look_%1%2")
                     .arg(backwards ? QStringLiteral("from_minus_") : QStringLiteral("from_plus_"),
                          names[axis]),
                 tr("Towards the centre, from this side"),
                 [this, axis, backwards] { view_.look_along(axis, backwards); });
  add_action(menu, tr("&Perspective or parallel"), QStringLiteral("projection"),
             tr("The other projection, with the same size at the centre"),
             [this] { view_.toggle_projection(); });
  add_action(menu, tr("&Colour bar"), QStringLiteral("color_bar"),
             tr("Draw the colour map on the picture, or not"),
             [this] { view_.toggle_color_bar(); });
  menu->addSeparator();
  add_action(menu, tr("Picture as large as the &window"), QStringLiteral("fit_window"),
             tr("Make the picture's size that of the window, in pixels"),
             [this] { fit_picture_to_window(); });
  QMenu* samples = menu->addMenu(tr("Rays a pixel at &rest"));
  auto* group = new QActionGroup(samples);
  for (const std::uint32_t count : {1U, 2U, 3U, 4U, 8U}) {
    QAction* action = samples->addAction(tr("%1 (--samples %2)").arg(count * count).arg(count));
    action->setCheckable(true);
    action->setChecked(count == view_.samples());
    group->addAction(action);
    connect(action, &QAction::triggered, this, [this, count] { view_.set_samples(count); });
  }
  QAction* hardware = add_action(
      menu, tr("&Hardware preview while moving"), QStringLiteral("hardware_preview"),
      tr("Draw in single precision by OpenGL while something moves, and exactly at rest; the "
         "status "
         "line names the device. Without a graphics card it is slower than the exact engine."),
      [this] {
        const bool on = !view_.hardware();
        settings_.setValue(QStringLiteral("view/hardware_preview"), on);
        view_.set_hardware(on);
      });
  hardware->setCheckable(true);
  hardware->setChecked(view_.hardware());
  add_action(menu, tr("&Explain the pixel"), QStringLiteral("explain_pixel"),
             tr("What the ray of the pixel under the mouse meets"), [this] {
               const auto place = viewport_->mapFromGlobal(QCursor::pos());
               if (const auto pixel = viewport_->pixel_at(place)) explain(*pixel);
             });
  add_action(menu, tr("Pla&y the camera path"), QStringLiteral("play"), tr("Frame after frame"),
             [this] { path_panel_->play(!path_panel_->is_playing()); });
  add_action(menu, tr("Record &keyframe"), QStringLiteral("record_keyframe"),
             tr("The present camera, at the frame that the panel of the camera path names"),
             [this] { view_.record_keyframe(path_panel_->record_frame()); });
}

void MainWindow::show_help() {
  QString text = QStringLiteral("<table cellpadding=4>");
  const auto add = [&](const QString& left, const QString& right) {
    text += QStringLiteral("<tr><td><b>%1</b></td><td>%2</td></tr>")
                .arg(left.toHtmlEscaped(), right.toHtmlEscaped());
  };
  for (const auto& [drag, gesture] : bindings_.lines()) add(drag, gesture);
  add(tr("wheel"), tr("zoom"));
  add(tr("click"), tr("explain the pixel"));
  add(tr("double click"), tr("bring what is seen there to the centre"));
  for (const QAction* action : findChildren<QAction*>())
    if (!action->objectName().isEmpty() && !action->shortcut().isEmpty())
      add(action->shortcut().toString(QKeySequence::NativeText),
          action->text().remove(QLatin1Char('&')).remove(QStringLiteral("...")));
  text += QStringLiteral("</table>");
  if (help_ == nullptr) {
    help_ = new QLabel(this, Qt::Tool);
    help_->setWindowTitle(tr("Mouse and keys"));
    help_->setMargin(12);
  }
  help_->setText(
      text +
      tr("<p>The settings file has this table: %1</p>").arg(settings_.fileName().toHtmlEscaped()));
  help_->show();
  help_->raise();
}

}  // namespace hiac::view

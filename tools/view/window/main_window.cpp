#include "tools/view/window/main_window.hpp"

#include <QDockWidget>
#include <QStatusBar>

namespace hiac::view {

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent) {
  setWindowTitle(tr("hiac-view"));
  connect(&document_, &Document::message, this,
          [this](const QString& line) { statusBar()->showMessage(line); });
}

QDockWidget* MainWindow::add_dock(const QString& name, const QString& title, QWidget* content) {
  auto* dock = new QDockWidget(title, this);
  dock->setObjectName(name);
  dock->setWidget(content);
  addDockWidget(Qt::RightDockWidgetArea, dock);
  return dock;
}

}  // namespace hiac::view

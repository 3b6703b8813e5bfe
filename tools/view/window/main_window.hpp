#pragma once

#include <QMainWindow>
#include <QString>

#include "tools/view/document/document.hpp"

class QDockWidget;

namespace hiac::view {

/// The window: the picture in the middle, docks on its right, menus and a status line.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  explicit MainWindow(QWidget* parent = nullptr);

  [[nodiscard]] Document& document() { return document_; }

 private:
  /// A dock on the right. `name` identifies it in the settings.
  QDockWidget* add_dock(const QString& name, const QString& title, QWidget* content);

  Document document_;
};

}  // namespace hiac::view

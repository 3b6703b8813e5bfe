// hiac-view: the picture in a window.

#include <QApplication>

#include "tools/view/window/main_window.hpp"

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  hiac::view::MainWindow window;
  window.show();
  return QApplication::exec();
}

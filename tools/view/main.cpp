// hiac-view: the picture in a window.

#include <QApplication>
#include <QIcon>
#include <QSettings>
#include <memory>
#include <string>
#include <vector>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "tools/common/foreign_mesh.hpp"
#include "tools/common/picture/picture_command.hpp"
#include "tools/common/threshold.hpp"
#include "tools/common/tool.hpp"
#include "tools/view/channels/channel_window.hpp"
#include "tools/view/viewport/bindings.hpp"
#include "tools/view/window/main_window.hpp"

namespace {

using namespace hiac;
using namespace hiac::view;

// Shows the channels of a picture until the window is closed.
void show_channels(const std::string& path, QSettings& settings) {
  QStringList faults;
  const Bindings bindings(settings, faults);
  ChannelWindow window(read_image(path).image, QString::fromStdString(path), bindings);
  window.resize(900, 700);
  window.show();
  QApplication::exec();
}

// Shows the window until it is closed.
void show(tools::Tool& tool, const tools::PictureCommand& command) {
  // Qt ends the process by itself, without an exit code of ours, where there is no screen
  if (qEnvironmentVariableIsEmpty("DISPLAY") && qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY") &&
      qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
    throw UsageError("there is no screen for a window (DISPLAY or WAYLAND_DISPLAY expected)");
  int count = 1;
  std::string name = "hiac-view";
  std::vector<char*> arguments{name.data(), nullptr};
  QApplication application(count, arguments.data());
  QApplication::setApplicationName(QStringLiteral("hiac-view"));
  QApplication::setDesktopFileName(QStringLiteral("hiac-view"));
  QApplication::setWindowIcon(QIcon::fromTheme(QStringLiteral("hiac-view")));
  QSettings settings(QSettings::IniFormat, QSettings::UserScope, QStringLiteral("hiac"),
                     QStringLiteral("hiac-view"));
  if (has_image_extension(command.input)) {
    show_channels(command.input, settings);
    return;
  }
  MainWindow window(tool, settings);
  window.show();
  if (!command.input.empty())
    window.files().open(command);
  else if (!command.view.empty())
    window.files().open_view(QString::fromStdString(command.view));
  QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
  tools::Tool tool(
      "hiac-view",
      "Shows a mesh in a window, in which the view and the transfer functions are set: at rest the "
      "picture is that of hiac-render, bit for bit.",
      "  hiac-view run.inp                     # any file that hiac-convert reads\n"
      "  hiac-view part.zoo --view view.toml\n"
      "  hiac-view run.exo --convert '--step 3' --field stress\n"
      "  hiac-view part.exr                    # a picture's channels");
  tools::PictureCommand command;
  auto& app = tool.app();
  app.add_option("MESH", command.input,
                 "Zoo mesh, or any file that hiac-convert reads; none: open one in the window; a "
                 "picture: show its channels");
  tools::add_conversion(app, command.conversion);
  tools::add_threshold(app, command.threshold);
  app.add_option("--block", command.block, "Show only this block of a foreign file")
      ->type_name("NAME");
  app.add_option(
         "--view", command.view,
         "Image specification (TOML), a picture made by one (.png .exr .tiff), or a state of "
         "ParaView (.pvsm); without it the window begins with a starter view")
      ->type_name("SPEC");
  tools::add_starter_options(app, command.starter);
  return tool.run(argc, argv, [&] { show(tool, command); });
}

// A settings file with any damage opens a window. HIAC_MUTATIONS: how many are tried (40).

#include <QCoreApplication>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/mutated_bytes.hpp"
#include "tests/view/open_window.hpp"

namespace hiac::view::test {
namespace {

class DamagedSettings : public ::testing::Test {
 protected:
  [[nodiscard]] QString file() const { return QString::fromStdString(folder_.file("s.ini")); }

  /// Shows a window with the settings as they are, and closes it, which keeps its layout in them.
  void open_and_close() {
    QSettings settings(file(), QSettings::IniFormat);
    MainWindow window(tool_, settings);
    window.show();
    QCoreApplication::processEvents();
    window.close();
  }

  hiac::test::ScratchFolder folder_;
  tools::Tool tool_{"hiac-view", "", ""};
};

TEST_F(DamagedSettings, OpenAWindow) {
  {
    QSettings settings(file(), QSettings::IniFormat);
    settings.setValue(QStringLiteral("mouse/left"), QStringLiteral("zoom"));
    settings.setValue(QStringLiteral("keys/reset"), QStringLiteral("Ctrl+F"));
    settings.setValue(QStringLiteral("files/folder"), QStringLiteral("/tmp"));
    settings.setValue(QStringLiteral("files/recent"),
                      QStringList{QStringLiteral("/tmp/a.zoo"), QStringLiteral("/tmp/b.toml")});
  }
  open_and_close();
  const std::string sound = hiac::test::bytes_of(folder_.file("s.ini"));
  ASSERT_NE(sound.find("geometry"), std::string::npos) << sound;
  std::mt19937 random(20261125);
  for (int round = 0; round < hiac::test::mutations_wanted(40); ++round) {
    const std::string bytes = hiac::test::mutated(sound, random);
    SCOPED_TRACE(bytes);
    static_cast<void>(folder_.write("s.ini", bytes));
    open_and_close();
  }
}

}  // namespace
}  // namespace hiac::view::test

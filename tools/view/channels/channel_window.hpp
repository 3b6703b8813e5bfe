#pragma once

#include <QMainWindow>
#include <memory>
#include <optional>

#include "hiac/image/image.hpp"
#include "tools/view/viewport/bindings.hpp"
#include "tools/view/viewport/viewport.hpp"

class QCheckBox;
class QComboBox;
class QLabel;

namespace hiac::view {

/// Shows a picture's channels: its colours as hiac-render encodes them, or one channel in grey, and
/// the values of all channels at the pixel below the mouse.
class ChannelWindow : public QMainWindow {
  Q_OBJECT

 public:
  /// `name`: the picture's file.
  ChannelWindow(Image image, const QString& name, const Bindings& bindings,
                QWidget* parent = nullptr);

  [[nodiscard]] Viewport& viewport() { return *viewport_; }
  [[nodiscard]] QComboBox& choice() { return *choice_; }
  [[nodiscard]] QCheckBox& logarithmic() { return *logarithmic_; }
  /// What the status line says of the channel that is shown, and of the pixel below the mouse.
  [[nodiscard]] QString range_text() const;
  [[nodiscard]] QString pixel_text() const;

 private:
  void show_choice();
  void tell_pixel(std::optional<QPoint> pixel);

  Image image_;
  Viewport* viewport_;
  QComboBox* choice_;
  QCheckBox* logarithmic_;
  QLabel *range_, *pixel_;
};

}  // namespace hiac::view

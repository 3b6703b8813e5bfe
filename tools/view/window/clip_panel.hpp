#pragma once

#include <QWidget>
#include <array>
#include <optional>

#include "tools/view/document/document.hpp"

class QCheckBox;
class QDoubleSpinBox;
class QSlider;

namespace hiac::view {

/// The clipping slab of the camera: near and far by sliders through the mesh's depths, or typed.
class ClipPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ClipPanel(QWidget* parent = nullptr);

  /// Shows a camera's slab, of a mesh that lies between these depths. None: there is no camera.
  void show_camera(const std::optional<Camera>& camera, std::array<double, 2> depths);

 Q_SIGNALS:
  /// None: no slab. `goes_on`: the same drag as before.
  void clip_changed(std::optional<std::array<double, 2>> clip, bool goes_on);

 private:
  void slide(std::size_t which, int value);
  void type(std::size_t which, double value);
  [[nodiscard]] double depth_of(int value) const;
  [[nodiscard]] int value_of(double depth) const;

  QCheckBox* is_on_;
  std::array<QSlider*, 2> sliders_;
  std::array<QDoubleSpinBox*, 2> numbers_;
  std::array<double, 2> depths_{0, 1}, clip_{0, 1};
  bool is_perspective_ = true;
  bool is_shown_ = false;  // values change because a camera is shown
  bool goes_on_ = false;
};

}  // namespace hiac::view

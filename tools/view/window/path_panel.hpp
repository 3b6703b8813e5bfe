#pragma once

#include <QTimer>
#include <QWidget>
#include <cstdint>

class QLabel;
class QPushButton;
class QSlider;
class QSpinBox;

namespace hiac::view {

/// The frames of a camera path: which is shown, playing them, and recording the present camera.
class PathPanel : public QWidget {
  Q_OBJECT

 public:
  explicit PathPanel(QWidget* parent = nullptr);

  /// Shows a path of so many frames, 1 for one camera; `can_record`: of keyframes, or none yet.
  void show_path(std::uint32_t frames, std::uint32_t frame, bool can_record);

  void play(bool on);
  [[nodiscard]] bool is_playing() const { return timer_.isActive(); }
  /// The frame at which a keyframe is recorded: the one that is typed, which may lie behind the
  /// end.
  [[nodiscard]] std::uint32_t record_frame() const;
  /// The next frame while frames are played; called when the last one has been drawn.
  void picture_drawn();

 Q_SIGNALS:
  void frame_chosen(std::uint32_t frame);
  void record_wanted(std::uint32_t frame);

 private:
  QSlider* slider_;
  QSpinBox* record_at_;
  QPushButton *play_, *record_;
  QLabel* label_;
  QTimer timer_;
  std::uint32_t frames_ = 1;
  bool is_shown_ = false;  // values change because a path is shown
  bool is_due_ = false;    // the next frame's time has come
  bool is_drawn_ = false;  // the frame before it has been drawn
};

}  // namespace hiac::view

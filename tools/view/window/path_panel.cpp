#include "tools/view/window/path_panel.hpp"

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>

#include "hiac/scene/scene.hpp"

namespace hiac::view {

PathPanel::PathPanel(QWidget* parent)
    : QWidget(parent),
      slider_(new QSlider(Qt::Horizontal)),
      record_at_(new QSpinBox),
      play_(new QPushButton(tr("Play"))),
      record_(new QPushButton(tr("Record keyframe at"))),
      label_(new QLabel) {
  constexpr int kMillisecondsPerFrame = 40;  // 25 frames a second, as films of hiac-render have
  timer_.setInterval(kMillisecondsPerFrame);
  play_->setCheckable(true);
  play_->setToolTip(tr("Show frame after frame, at most 25 a second"));
  slider_->setToolTip(tr("Frame of the camera path"));
  slider_->setAccessibleName(tr("Frame of the camera path"));
  record_->setToolTip(tr("Keep the present camera as a keyframe of the path"));
  record_at_->setToolTip(tr("Number of the frame"));
  record_at_->setAccessibleName(tr("Frame of the keyframe"));
  auto* layout = new QGridLayout(this);
  layout->addWidget(label_, 0, 0, 1, 2);
  layout->addWidget(slider_, 1, 0, 1, 2);
  layout->addWidget(play_, 2, 0, 1, 2);
  layout->addWidget(record_, 3, 0);
  layout->addWidget(record_at_, 3, 1);
  layout->setRowStretch(4, 1);
  connect(slider_, &QSlider::valueChanged, this, [this](int value) {
    if (!is_shown_) Q_EMIT frame_chosen(static_cast<std::uint32_t>(value));
  });
  connect(play_, &QPushButton::toggled, this, &PathPanel::play);
  connect(record_, &QPushButton::clicked, this, [this] { Q_EMIT record_wanted(record_frame()); });
  connect(&timer_, &QTimer::timeout, this, [this] {
    is_due_ = true;
    if (is_drawn_) picture_drawn();
  });
  show_path(1, 0, true);
}

void PathPanel::show_path(std::uint32_t frames, std::uint32_t frame, bool can_record) {
  is_shown_ = true;
  if (frames != frames_ && frames > 1) record_at_->setValue(static_cast<int>(frame));
  frames_ = frames;
  label_->setText(frames > 1 ? tr("frame %1 of 0 to %2").arg(frame).arg(frames - 1)
                             : tr("one camera, no path"));
  slider_->setEnabled(frames > 1);
  play_->setEnabled(frames > 1);
  slider_->setRange(0, static_cast<int>(frames) - 1);
  slider_->setValue(static_cast<int>(frame));
  record_->setEnabled(can_record);
  record_at_->setEnabled(can_record);
  record_at_->setRange(frames > 1 ? 0 : 1, static_cast<int>(kMaxFrames) - 1);
  if (frames == 1 && record_at_->value() == 1) record_at_->setValue(25);
  if (frames == 1) play(false);
  is_shown_ = false;
}

void PathPanel::play(bool on) {
  play_->setChecked(on);
  is_due_ = false;
  is_drawn_ = on;
  if (on && frames_ > 1)
    timer_.start();
  else
    timer_.stop();
}

std::uint32_t PathPanel::record_frame() const {
  return static_cast<std::uint32_t>(record_at_->value());
}

void PathPanel::picture_drawn() {
  if (!timer_.isActive()) return;
  is_drawn_ = true;
  if (!is_due_) return;
  is_due_ = is_drawn_ = false;
  slider_->setValue((slider_->value() + 1) % static_cast<int>(frames_));
}

}  // namespace hiac::view

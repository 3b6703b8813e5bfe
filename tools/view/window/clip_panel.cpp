#include "tools/view/window/clip_panel.hpp"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QSlider>
#include <algorithm>
#include <cmath>

namespace hiac::view {
namespace {

constexpr int kSliderSteps = 1000;

}  // namespace

ClipPanel::ClipPanel(QWidget* parent)
    : QWidget(parent), is_on_(new QCheckBox(tr("Clip to a slab"))) {
  auto* layout = new QGridLayout(this);
  layout->addWidget(is_on_, 0, 0, 1, 3);
  is_on_->setToolTip(tr("Draw only what lies between two planes that are parallel to the picture"));
  const std::array<QString, 2> names{tr("near"), tr("far")};
  for (std::size_t k = 0; k < 2; ++k) {
    sliders_[k] = new QSlider(Qt::Horizontal);
    sliders_[k]->setRange(0, kSliderSteps);
    numbers_[k] = new QDoubleSpinBox;
    numbers_[k]->setKeyboardTracking(false);
    numbers_[k]->setMaximumWidth(140);
    for (QWidget* widget :
         {static_cast<QWidget*>(sliders_[k]), static_cast<QWidget*>(numbers_[k])}) {
      widget->setToolTip(tr("Distance from the eye's plane along the view direction, world units"));
      widget->setAccessibleName(tr("Clipping plane: %1").arg(names[k]));
    }
    const int row = static_cast<int>(k) + 1;
    layout->addWidget(new QLabel(names[k]), row, 0);
    layout->addWidget(sliders_[k], row, 1);
    layout->addWidget(numbers_[k], row, 2);
    connect(sliders_[k], &QSlider::valueChanged, this, [this, k](int v) { slide(k, v); });
    connect(sliders_[k], &QSlider::sliderReleased, this, [this] { goes_on_ = false; });
    connect(numbers_[k], &QDoubleSpinBox::valueChanged, this, [this, k](double v) { type(k, v); });
  }
  layout->setColumnStretch(1, 1);
  layout->setRowStretch(3, 1);
  connect(is_on_, &QCheckBox::toggled, this, [this](bool on) {
    if (is_shown_) return;
    Q_EMIT clip_changed(on ? std::optional(clip_) : std::nullopt, false);
  });
  show_camera(std::nullopt, {0, 1});
}

double ClipPanel::depth_of(int value) const {
  return std::lerp(depths_[0], depths_[1], static_cast<double>(value) / kSliderSteps);
}

int ClipPanel::value_of(double depth) const {
  const double share = (depth - depths_[0]) / (depths_[1] - depths_[0]);
  return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * kSliderSteps));
}

void ClipPanel::show_camera(const std::optional<Camera>& camera, std::array<double, 2> depths) {
  is_shown_ = true;
  setEnabled(camera.has_value());
  const bool is_on = camera && camera->clip;
  is_on_->setChecked(is_on);
  is_perspective_ = camera && camera->projection == Projection::perspective;
  if (is_perspective_) depths[0] = std::max(depths[0], 0.0);
  if (!(depths[0] < depths[1])) depths[1] = depths[0] + 1;
  depths_ = depths;
  clip_ = is_on ? *camera->clip : depths;
  const double size = depths[1] - depths[0];
  const int decimals = std::clamp(3 - static_cast<int>(std::floor(std::log10(size))), 0, 12);
  for (std::size_t k = 0; k < 2; ++k) {
    sliders_[k]->setEnabled(is_on);
    numbers_[k]->setEnabled(is_on);
    if (!sliders_[k]->isSliderDown()) sliders_[k]->setValue(value_of(clip_[k]));
    numbers_[k]->setDecimals(decimals);
    numbers_[k]->setSingleStep(size / 100);
    numbers_[k]->setRange(is_perspective_ ? 0 : -kLargestNumber, kLargestNumber);
    numbers_[k]->setValue(std::min(clip_[k], kLargestNumber));
  }
  is_shown_ = false;
}

void ClipPanel::slide(std::size_t which, int value) {
  if (is_shown_) return;
  type(which, depth_of(value));
  goes_on_ = sliders_[which]->isSliderDown();
}

void ClipPanel::type(std::size_t which, double value) {
  if (is_shown_) return;
  std::array<double, 2> clip = clip_;
  clip[which] = value;
  if (!(clip[0] < clip[1])) return;  // the planes do not pass each other
  Q_EMIT clip_changed(clip, goes_on_);
}

}  // namespace hiac::view

#include "tools/view/channels/channel_window.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QStatusBar>
#include <QToolBar>
#include <utility>

#include "hiac/image/display_bytes.hpp"
#include "tools/view/channels/channel_picture.hpp"

namespace hiac::view {
namespace {

constexpr int kColors = -1;  // the choice that is no single channel

}  // namespace

ChannelWindow::ChannelWindow(Image image, const QString& name, const Bindings& bindings,
                             QWidget* parent)
    : QMainWindow(parent),
      image_(std::move(image)),
      viewport_(new Viewport(bindings)),
      choice_(new QComboBox),
      logarithmic_(new QCheckBox(tr("logarithmic"))),
      range_(new QLabel),
      pixel_(new QLabel) {
  setWindowTitle(QStringLiteral("%1 \u2013 hiac-view").arg(name));
  setCentralWidget(viewport_);
  choice_->setAccessibleName(tr("Channel"));
  choice_->setToolTip(tr("The channel that is shown"));
  if (color_channels(image_)) choice_->addItem(tr("colours"), kColors);
  for (std::size_t c = 0; c < image_.channel_count(); ++c)
    choice_->addItem(QString::fromStdString(image_.channels()[c]), static_cast<int>(c));
  logarithmic_->setToolTip(tr("Grey is even in the value's logarithm"));
  QToolBar* bar = addToolBar(tr("Channel"));
  bar->setObjectName(QStringLiteral("channel"));
  bar->setMovable(false);
  bar->addWidget(choice_);
  bar->addWidget(logarithmic_);
  statusBar()->addWidget(range_, 1);
  statusBar()->addPermanentWidget(pixel_);
  connect(choice_, &QComboBox::currentIndexChanged, this, &ChannelWindow::show_choice);
  connect(logarithmic_, &QCheckBox::toggled, this, &ChannelWindow::show_choice);
  connect(viewport_, &Viewport::hovered, this, &ChannelWindow::tell_pixel);
  show_choice();
}

QString ChannelWindow::range_text() const { return range_->text(); }

QString ChannelWindow::pixel_text() const { return pixel_->text(); }

void ChannelWindow::show_choice() {
  const int chosen = choice_->currentData().toInt();
  auto painted = std::make_shared<Painted>();
  painted->size = {static_cast<std::uint32_t>(image_.width()),
                   static_cast<std::uint32_t>(image_.height())};
  logarithmic_->setEnabled(false);
  if (chosen == kColors) {
    range_->setText(tr("%1 x %2 pixels, colours in sRGB").arg(image_.width()).arg(image_.height()));
    painted->bytes = display_bytes(image_);
    viewport_->show_picture(painted);
    return;
  }
  const auto channel = static_cast<std::size_t>(chosen);
  const auto range = finite_range(image_, channel);
  if (!range) {
    range_->setText(tr("no finite value"));
    viewport_->show_text(tr("The channel has no finite value"));
    return;
  }
  const bool has_logarithm = (*range)[0] > 0;
  logarithmic_->setEnabled(has_logarithm);
  painted->bytes =
      channel_bytes(image_, channel, *range, has_logarithm && logarithmic_->isChecked());
  range_->setText(tr("%1: black %2, white %3, red: not finite")
                      .arg(choice_->currentText())
                      .arg((*range)[0], 0, 'g', 6)
                      .arg((*range)[1], 0, 'g', 6));
  viewport_->show_picture(painted);
}

void ChannelWindow::tell_pixel(std::optional<QPoint> pixel) {
  if (!pixel) return pixel_->clear();
  QString text = tr("pixel %1,%2:").arg(pixel->x()).arg(pixel->y());
  const auto values =
      image_.pixel(static_cast<std::size_t>(pixel->x()), static_cast<std::size_t>(pixel->y()));
  for (std::size_t c = 0; c < values.size(); ++c)
    text += QStringLiteral(" %1 %2")
                .arg(QString::fromStdString(image_.channels()[c]))
                .arg(values[c], 0, 'g', 6);
  pixel_->setText(text);
}

}  // namespace hiac::view

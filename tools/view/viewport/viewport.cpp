#include "tools/view/viewport/viewport.hpp"

#include <QApplication>
#include <QDateTime>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "hiac/scene/camera_motion.hpp"

namespace hiac::view {

Viewport::Viewport(const Bindings& bindings, QWidget* parent)
    : QWidget(parent), bindings_(bindings) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(160, 120);
  setAccessibleName(tr("Picture"));
}

void Viewport::show_picture(std::shared_ptr<const Painted> picture) {
  picture_ = std::move(picture);
  const auto [width, height] = picture_->size;
  image_ = QImage(picture_->bytes.data(), static_cast<int>(width), static_cast<int>(height),
                  static_cast<qsizetype>(width) * 3, QImage::Format_RGB888);
  text_.clear();
  update();
}

void Viewport::show_text(const QString& text) {
  image_ = {};
  picture_.reset();
  text_ = text;
  update();
}

void Viewport::mark(std::optional<QPoint> pixel) {
  mark_ = pixel;
  update();
}

// Pixels of the picture are those of the screen as long as they fit.
double Viewport::scale() const {
  if (image_.isNull()) return 1;
  const double screen = devicePixelRatioF();
  return std::min({1.0, width() * screen / image_.width(), height() * screen / image_.height()});
}

QRectF Viewport::picture_rect() const {
  const double screen = devicePixelRatioF(), shrunk = scale() / screen;
  const QSizeF size(image_.width() * shrunk, image_.height() * shrunk);
  // the corner on a pixel of the screen, so that pixels stay what they are
  const auto whole = [&](double place) { return std::floor(place * screen) / screen; };
  return {QPointF(whole((width() - size.width()) / 2), whole((height() - size.height()) / 2)),
          size};
}

std::optional<QPoint> Viewport::pixel_at(const QPointF& place) const {
  const QRectF rect = picture_rect();
  if (image_.isNull() || rect.isEmpty()) return std::nullopt;
  const int x =
      static_cast<int>(std::floor((place.x() - rect.x()) / rect.width() * image_.width()));
  const int y =
      static_cast<int>(std::floor((place.y() - rect.y()) / rect.height() * image_.height()));
  if (!QRect({}, image_.size()).contains(x, y)) return std::nullopt;
  return QPoint(x, y);
}

void Viewport::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Dark));
  if (image_.isNull()) {
    painter.setPen(palette().color(QPalette::BrightText));
    painter.drawText(rect().adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap, text_);
    return;
  }
  const QRectF place = picture_rect();
  painter.setRenderHint(QPainter::SmoothPixmapTransform, scale() < 1);
  painter.drawImage(place, image_);
  if (!mark_) return;
  const double pixel = place.width() / image_.width();
  const QPointF at(place.x() + (mark_->x() + 0.5) * pixel, place.y() + (mark_->y() + 0.5) * pixel);
  constexpr double kNear = 4, kFar = 12;
  for (const auto& [color, width] : {std::pair(Qt::black, 3.0), std::pair(Qt::white, 1.0)}) {
    painter.setPen(QPen(color, width));
    for (const QPointF& way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
      painter.drawLine(at + kNear * way, at + kFar * way);
  }
}

void Viewport::mousePressEvent(QMouseEvent* event) {
  gesture_ = bindings_.gesture(event->button(), event->modifiers());
  pressed_ = last_ = event->position();
  has_moved_ = false;
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
  Q_EMIT hovered(pixel_at(event->position()));
  if (!gesture_ || event->buttons() == Qt::NoButton || !camera_) return;
  const double moved = (event->position() - pressed_).manhattanLength();
  if (!has_moved_ && moved < QApplication::startDragDistance()) return;  // may be a click
  move_camera(*gesture_, last_, event->position());
  last_ = event->position();
  has_moved_ = true;
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
  if (!has_moved_ && event->button() == Qt::LeftButton)
    if (const auto pixel = pixel_at(event->position())) {
      if (event->modifiers() == Qt::NoModifier) Q_EMIT pixel_chosen(*pixel);
      if (event->modifiers() == Qt::AltModifier) Q_EMIT bump_chosen(*pixel);
    }
  gesture_.reset();
  has_moved_ = false;
}

void Viewport::mouseDoubleClickEvent(QMouseEvent* event) {
  gesture_.reset();
  has_moved_ = true;  // its release is no click
  if (event->button() != Qt::LeftButton) return;
  if (const auto pixel = pixel_at(event->position())) Q_EMIT centre_chosen(*pixel);
}

void Viewport::wheelEvent(QWheelEvent* event) {
  event->accept();
  if (!camera_ || event->angleDelta().y() == 0) return;
  constexpr double kNotch = 120, kFactor = 1.1;
  // notches that follow one another are one gesture
  constexpr qint64 kPause = 500;
  const qint64 now = QDateTime::currentMSecsSinceEpoch();
  const bool goes_on = now - last_wheel_ < kPause;
  last_wheel_ = now;
  Q_EMIT camera_moved(zoomed(*camera_, std::pow(kFactor, event->angleDelta().y() / kNotch)),
                      tr("zoom"), goes_on);
}

void Viewport::leaveEvent(QEvent*) { Q_EMIT hovered(std::nullopt); }

void Viewport::move_camera(Gesture gesture, const QPointF& from, const QPointF& to) {
  const QRectF place = picture_rect();
  const double side = image_.isNull() ? height() : place.height();
  if (!(side > 0)) return;
  const QPointF by = to - from;
  constexpr double kDegrees = 180;  // a half turn for the picture's height
  constexpr double kZoom = 4;       // times, for the picture's height
  switch (gesture) {
    case Gesture::turn:
      Q_EMIT camera_moved(orbited(*camera_, by.x() / side * kDegrees, by.y() / side * kDegrees),
                          tr("turn"), has_moved_);
      break;
    case Gesture::pan:
      Q_EMIT camera_moved(panned(*camera_, by.x() / side, -by.y() / side), tr("pan"), has_moved_);
      break;
    case Gesture::zoom:
      Q_EMIT camera_moved(zoomed(*camera_, std::pow(kZoom, -by.y() / side)), tr("zoom"),
                          has_moved_);
      break;
    case Gesture::roll: {
      const QPointF centre = place.center();
      const auto angle = [&](const QPointF& at) {
        return std::atan2(centre.y() - at.y(), at.x() - centre.x());
      };
      const double degrees = (angle(to) - angle(from)) * 180 / M_PI;
      Q_EMIT camera_moved(rolled(*camera_, degrees), tr("roll"), has_moved_);
      break;
    }
  }
}

}  // namespace hiac::view

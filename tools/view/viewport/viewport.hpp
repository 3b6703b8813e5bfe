#pragma once

#include <QImage>
#include <QPoint>
#include <QString>
#include <QWidget>
#include <memory>
#include <optional>

#include "hiac/scene/scene.hpp"
#include "tools/view/viewport/bindings.hpp"
#include "tools/view/viewport/painter.hpp"

namespace hiac::view {

/// Shows the picture, as large as it is or scaled down to fit, and turns what the mouse does into
/// movements of the camera. It draws nothing itself.
class Viewport : public QWidget {
  Q_OBJECT

 public:
  explicit Viewport(const Bindings& bindings, QWidget* parent = nullptr);

  /// The picture, which stays the last one until the next comes.
  void show_picture(std::shared_ptr<const Painted> picture);
  /// No picture, but a text in the middle.
  void show_text(const QString& text);
  [[nodiscard]] const QImage& image() const { return image_; }

  /// The camera that gestures start from; none: they do nothing.
  void set_camera(const std::optional<Camera>& camera) { camera_ = camera; }

  /// A cross on a pixel; none: no cross.
  void mark(std::optional<QPoint> pixel);

  /// The pixel of the picture below a place of the widget; none beside the picture.
  [[nodiscard]] std::optional<QPoint> pixel_at(const QPointF& place) const;
  /// The screen's pixels that one pixel of the picture has along its side.
  [[nodiscard]] double scale() const;

  [[nodiscard]] QSize sizeHint() const override { return {800, 600}; }

 Q_SIGNALS:
  /// A gesture moved the camera. `label` names it; `goes_on`: the same gesture as before.
  void camera_moved(const hiac::Camera& camera, const QString& label, bool goes_on);
  void pixel_chosen(QPoint pixel);   ///< a click
  void centre_chosen(QPoint pixel);  ///< a double click
  void bump_chosen(QPoint pixel);    ///< a click with Alt
  void hovered(std::optional<QPoint> pixel);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  [[nodiscard]] QRectF picture_rect() const;  // in the widget
  void move_camera(Gesture gesture, const QPointF& from, const QPointF& to);

  const Bindings& bindings_;
  std::shared_ptr<const Painted> picture_;  // owns the bytes of image_
  QImage image_;
  QString text_;
  std::optional<Camera> camera_;
  std::optional<QPoint> mark_;
  std::optional<Gesture> gesture_;
  QPointF pressed_, last_;
  bool has_moved_ = false;
  qint64 last_wheel_ = 0;  // milliseconds
};

}  // namespace hiac::view

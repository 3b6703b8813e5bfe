#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "tools/view/viewport/drawing.hpp"

namespace hiac::view {

/// What the ray of a pixel meets, over depth: the field, the transparency of all in front, and what
/// every cell adds to the pixel; ticks where the ray leaves a cell for the next.
class DepthCurve : public QWidget {
  Q_OBJECT

 public:
  explicit DepthCurve(QWidget* parent = nullptr);

  /// Null: nothing.
  void show_pixel(std::shared_ptr<const ExplainedPixel> pixel);

  [[nodiscard]] QSize sizeHint() const override { return {420, 220}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  [[nodiscard]] QRectF plot_rect() const;
  [[nodiscard]] double depth_at(double x) const;
  [[nodiscard]] double x_at(double depth) const;
  void paint_frame(QPainter& painter) const;
  void paint_contributions(QPainter& painter) const;
  void paint_transparency(QPainter& painter) const;
  void paint_field(QPainter& painter) const;
  [[nodiscard]] QString tip_at(double x) const;

  std::shared_ptr<const ExplainedPixel> pixel_;
  double near_ = 0, far_ = 1;  // depths
  double low_ = 0, high_ = 1;  // of the field
  double most_added_ = 0;      // by one cell, of any channel
};

}  // namespace hiac::view

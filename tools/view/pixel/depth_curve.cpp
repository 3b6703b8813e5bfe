#include "tools/view/pixel/depth_curve.hpp"

#include <QHelpEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hiac/render/explain_pixel.hpp"

namespace hiac::view {
namespace {

constexpr QColor kTransparency(120, 120, 120), kField(31, 119, 180), kSurface(214, 39, 40);

// The field that decides what is seen: that of the extinction, or, without one, of the colour.
double field_of(const SegmentEnd& end, const Scene& scene) {
  return scene.volume.extinction ? end.extinction_field : end.color_field;
}

QString field_name(const Scene& scene) {
  const Volume& volume = scene.volume;
  if (volume.extinction) return QString::fromStdString(volume.extinction->field);
  return volume.color ? QString::fromStdString(volume.color->field) : QString();
}

// What a segment adds to the pixel.
Color added(const std::vector<PixelSegment>& segments, std::size_t k) {
  Color sum = segments[k].color;
  if (k > 0)
    for (std::size_t c = 0; c < 3; ++c) sum[c] -= segments[k - 1].color[c];
  return sum;
}

QColor shown(const Color& color) {
  const double most = std::ranges::max(color);
  const auto part = [&](double value) {
    return most > 0 ? static_cast<float>(std::clamp(std::sqrt(value / most), 0.0, 1.0)) : 0.5F;
  };
  return QColor::fromRgbF(part(color[0]), part(color[1]), part(color[2]));
}

QString four_digits(double value) { return QString::number(value, 'g', 4); }

}  // namespace

DepthCurve::DepthCurve(QWidget* parent) : QWidget(parent) {
  setMinimumHeight(140);
  setAccessibleName(tr("Values along the ray of the pixel"));
}

void DepthCurve::show_pixel(std::shared_ptr<const ExplainedPixel> pixel) {
  pixel_ = std::move(pixel);
  low_ = near_ = std::numeric_limits<double>::infinity();
  high_ = far_ = -low_;
  most_added_ = 0;
  if (pixel_) {
    const auto& segments = pixel_->explanation.pixel->segments;
    for (std::size_t k = 0; k < segments.size(); ++k) {
      for (const SegmentEnd& end : {segments[k].front, segments[k].back}) {
        near_ = std::min(near_, end.depth);
        far_ = std::max(far_, end.depth);
        if (segments[k].part != RayPart::inside) continue;
        low_ = std::min(low_, field_of(end, pixel_->scene));
        high_ = std::max(high_, field_of(end, pixel_->scene));
      }
      most_added_ = std::max(most_added_, std::ranges::max(added(segments, k)));
    }
  }
  update();
}

QRectF DepthCurve::plot_rect() const {
  const double line = fontMetrics().height();
  return QRectF(rect()).adjusted(8, line + 6, -8, -2 * line - 6);
}

double DepthCurve::x_at(double depth) const {
  const QRectF plot = plot_rect();
  return plot.left() + plot.width() * (far_ > near_ ? (depth - near_) / (far_ - near_) : 0.5);
}

double DepthCurve::depth_at(double x) const {
  const QRectF plot = plot_rect();
  return near_ + (x - plot.left()) / plot.width() * (far_ - near_);
}

void DepthCurve::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (!pixel_ || pixel_->explanation.pixel->segments.empty()) {
    painter.drawText(
        rect(), Qt::AlignCenter,
        pixel_ ? tr("The ray of this pixel meets no cell") : tr("Click a pixel of the picture"));
    return;
  }
  paint_contributions(painter);
  paint_frame(painter);
  paint_transparency(painter);
  paint_field(painter);
}

void DepthCurve::paint_frame(QPainter& painter) const {
  const QRectF plot = plot_rect();
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawRect(plot);
  for (const PixelSegment& segment : pixel_->explanation.pixel->segments)
    for (const double depth : {segment.front.depth, segment.back.depth})
      painter.drawLine(QPointF(x_at(depth), plot.bottom()),
                       QPointF(x_at(depth), plot.bottom() + 5));
  painter.setPen(palette().color(QPalette::Text));
  const QRectF below(plot.left(), plot.bottom() + 5, plot.width(), fontMetrics().height());
  painter.drawText(below, Qt::AlignLeft, four_digits(near_));
  painter.drawText(below, Qt::AlignHCenter, tr("depth"));
  painter.drawText(below, Qt::AlignRight, four_digits(far_));
  const QRectF above(plot.left(), 2, plot.width(), fontMetrics().height());
  painter.setPen(kField);
  if (low_ <= high_)  // the ray passes a cell
    painter.drawText(
        above, Qt::AlignLeft,
        tr("%1: %2 to %3").arg(field_name(pixel_->scene), four_digits(low_), four_digits(high_)));
  painter.setPen(kTransparency);
  painter.drawText(above, Qt::AlignRight, tr("transparency: 0 to 1"));
}

// Areas as wide as the segment and as high as its share, in its colour.
void DepthCurve::paint_contributions(QPainter& painter) const {
  if (!(most_added_ > 0)) return;
  const QRectF plot = plot_rect();
  const auto& segments = pixel_->explanation.pixel->segments;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Color color = added(segments, k);
    const double high = std::max(0.0, std::ranges::max(color)) / most_added_ * plot.height();
    const double left = x_at(segments[k].front.depth), right = x_at(segments[k].back.depth);
    QColor fill = shown(color);
    fill.setAlpha(110);
    painter.fillRect(QRectF(left, plot.bottom() - high, std::max(right - left, 1.0), high), fill);
  }
}

void DepthCurve::paint_transparency(QPainter& painter) const {
  const QRectF plot = plot_rect();
  const auto y = [&](double transparency) { return plot.bottom() - transparency * plot.height(); };
  QPainterPath path(QPointF(plot.left(), y(1)));
  double before = 1;
  for (const PixelSegment& segment : pixel_->explanation.pixel->segments) {
    path.lineTo(x_at(segment.front.depth), y(before));
    path.lineTo(x_at(segment.back.depth), y(segment.transparency));
    before = segment.transparency;
  }
  painter.setPen(QPen(kTransparency, 1.5, Qt::DashLine));
  painter.drawPath(path);
}

void DepthCurve::paint_field(QPainter& painter) const {
  const QRectF plot = plot_rect();
  const double range = high_ > low_ ? high_ - low_ : 1;
  const auto at = [&](const SegmentEnd& end) {
    const double share = (field_of(end, pixel_->scene) - low_) / range;
    return QPointF(x_at(end.depth), plot.bottom() - share * plot.height());
  };
  const auto paint_surface = [&](double depth) {
    painter.setPen(QPen(kSurface, 1.5));
    painter.drawLine(QPointF(x_at(depth), plot.top()), QPointF(x_at(depth), plot.bottom()));
  };
  for (const PixelSegment& segment : pixel_->explanation.pixel->segments) {
    if (segment.part != RayPart::inside) {
      paint_surface(segment.front.depth);
      continue;
    }
    painter.setPen(QPen(kField, 1.8));
    painter.drawLine(at(segment.front), at(segment.back));
    for (const MetIsosurface& met : segment.surfaces) paint_surface(met.depth);
  }
}

QString DepthCurve::tip_at(double x) const {
  if (!pixel_ || pixel_->explanation.pixel->segments.empty()) return {};
  const double depth = depth_at(x);
  for (const PixelSegment& s : pixel_->explanation.pixel->segments) {
    if (s.part != RayPart::inside || depth < s.front.depth || depth > s.back.depth) continue;
    const auto kind = kind_name(s.kind);
    return tr("cell %1 (%2)\ndepth %3 to %4 (world units)\n%5: %6 to %7\ntransparency behind: %8")
        .arg(s.cell)
        .arg(QLatin1String(kind.data(), static_cast<qsizetype>(kind.size())))
        .arg(four_digits(s.front.depth), four_digits(s.back.depth), field_name(pixel_->scene),
             four_digits(field_of(s.front, pixel_->scene)),
             four_digits(field_of(s.back, pixel_->scene)), four_digits(s.transparency));
  }
  return tr("depth %1: no cell").arg(four_digits(depth));
}

bool DepthCurve::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  QToolTip::showText(help->globalPos(), tip_at(help->pos().x()), this);
  return true;
}

}  // namespace hiac::view

// How the plot of the transfer functions looks.

#include <QPaintEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "hiac/base/transfer_function.hpp"
#include "tools/view/transfer/display_color.hpp"
#include "tools/view/transfer/transfer_curve.hpp"

namespace hiac::view {
namespace {

constexpr double kPoint = 4.5;

QString number(double value, int digits = 4) { return QString::number(value, 'g', digits); }

QPointF at(const Place& place) { return {place.x, place.y}; }

}  // namespace

void TransferCurve::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (!document_.has_scene() || field_.empty()) {
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("No transfer function: open a mesh and a specification"));
    return;
  }
  const auto& box = axes_.box();
  const QRectF plot(box.left, box.top, box.right - box.left, box.bottom - box.top);
  painter.fillRect(plot, palette().color(QPalette::Base));
  painter.save();
  painter.setClipRect(plot);
  paint_histogram(painter);
  painter.restore();
  paint_axes(painter);
  painter.save();
  painter.setClipRect(plot.adjusted(-kPoint - 2, -kPoint - 2, kPoint + 2, kPoint + 2));
  paint_extinction(painter);
  painter.restore();
  paint_color(painter);
  paint_surfaces(painter);
  for (const ChosenHandle& handle : handles())
    if (handle.kind != Handle::surface && handle != chosen_) paint_handle(painter, handle);
  if (chosen_ && chosen_->kind != Handle::surface) paint_handle(painter, *chosen_);
  paint_readout(painter);
}

// Volume by value, as a density: bins that are cut by a zoom keep their height.
void TransferCurve::paint_histogram(QPainter& painter) const {
  if (!histogram_) return;
  const auto& volumes = histogram_->volumes;
  const auto& edges = histogram_->edges;
  const double most = *std::ranges::max_element(volumes);
  if (!(most > 0)) return;
  const auto& box = axes_.box();
  constexpr double kDecades = 5;
  const auto height = [&](double volume) {
    if (!(volume > 0)) return 0.0;
    const double share = volume / most;
    return log_counts_ ? std::max(0.0, 1 + std::log10(share) / kDecades) : share;
  };
  QPainterPath path(QPointF(axes_.x_of(edges.front()), box.bottom));
  for (std::size_t k = 0; k < volumes.size(); ++k) {
    const double y = box.bottom - 0.92 * height(volumes[k]) * (box.bottom - box.top);
    path.lineTo(axes_.x_of(edges[k]), y);
    path.lineTo(axes_.x_of(edges[k + 1]), y);
  }
  path.lineTo(axes_.x_of(edges.back()), box.bottom);
  painter.setPen(Qt::NoPen);
  painter.setBrush(mixed(palette().color(QPalette::Base), palette().color(QPalette::Text), 0.22));
  painter.drawPath(path);
}

void TransferCurve::paint_axes(QPainter& painter) const {
  const auto& box = axes_.box();
  const QColor text = palette().color(QPalette::Text), base = palette().color(QPalette::Base);
  const QPen faint(mixed(base, text, 0.18), 1), strong(mixed(base, text, 0.5), 1);
  const double line = fontMetrics().height();
  // powers of ten of the extinction, as many as there is room for
  const int from = static_cast<int>(std::lround(std::log10(axes_.extinctions()[0])));
  const int to = static_cast<int>(std::lround(std::log10(axes_.extinctions()[1])));
  const double room = (axes_.zero_line() - box.top) / std::max(to - from, 1);
  const int step = std::max(1, static_cast<int>(std::ceil(1.4 * line / std::max(room, 1.0))));
  const auto label = [&](double y, const QString& name) {
    painter.setPen(text);
    painter.drawText(QRectF(0, y - line / 2, box.left - 6, line), Qt::AlignRight, name);
  };
  for (int power = to; power >= from; power -= step) {
    const double y = axes_.y_of(std::pow(10, power));
    painter.setPen(faint);
    painter.drawLine(QPointF(box.left, y), QPointF(box.right, y));
    label(y, QStringLiteral("1e%1").arg(power));
  }
  // zero, below a gap that no logarithm crosses
  painter.setPen(QPen(strong.color(), 1, Qt::DotLine));
  painter.drawLine(QPointF(box.left, axes_.zero_line() + CurveAxes::kZeroBand / 2),
                   QPointF(box.right, axes_.zero_line() + CurveAxes::kZeroBand / 2));
  label(box.bottom - 2, QStringLiteral("0"));
  painter.setPen(strong);
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(QRectF(box.left, box.top, box.right - box.left, box.bottom - box.top));
  const QRectF below(box.left, strip_middle() + kStrip / 2 + 3, box.right - box.left, line);
  painter.setPen(text);
  painter.drawText(below, Qt::AlignLeft, number(axes_.values()[0]));
  const QString name = QString::fromStdString(field_);
  painter.drawText(below, Qt::AlignHCenter,
                   axes_.scale() == TransferScale::log ? tr("%1 (log)").arg(name) : name);
  painter.drawText(below, Qt::AlignRight, number(axes_.values()[1]));
}

void TransferCurve::paint_extinction(QPainter& painter) const {
  if (!has_extinction()) return;
  const auto& box = axes_.box();
  const PiecewiseLinear<1> function = document_.scene().volume.extinction->function();
  // on the logarithmic axis lines are curves: a place for every half pixel, and both sides of a
  // step
  QPolygonF curve;
  const int count = std::max(2, static_cast<int>(2 * (box.right - box.left)));
  std::vector<double> scalars;
  for (int i = 0; i <= count; ++i)
    scalars.push_back(axes_.value_along(static_cast<double>(i) / count));
  for (const double s : function.breakpoints()) {
    scalars.push_back(s);
    scalars.push_back(std::nextafter(s, -HUGE_VAL));
  }
  std::ranges::sort(scalars);
  for (const double s : scalars) curve << QPointF(axes_.x_of(s), axes_.y_of(function(s)[0]));
  const QColor color = palette().color(QPalette::Highlight);
  QColor below = color;
  below.setAlpha(36);
  QPolygonF area = curve;
  area << QPointF(box.right, box.bottom) << QPointF(box.left, box.bottom);
  painter.save();
  painter.setClipRect(QRectF(box.left, box.top - 2, box.right - box.left, box.bottom - box.top + 4),
                      Qt::IntersectClip);
  painter.setPen(Qt::NoPen);
  painter.setBrush(below);
  painter.drawPolygon(area);
  painter.setPen(QPen(color, 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPolyline(curve);
  painter.restore();
}

void TransferCurve::paint_color(QPainter& painter) const {
  const auto& box = axes_.box();
  const QRectF strip(box.left, strip_middle() - kStrip / 2, box.right - box.left, kStrip);
  painter.setPen(mixed(palette().color(QPalette::Base), palette().color(QPalette::Text), 0.5));
  painter.setBrush(palette().color(QPalette::Base));
  painter.drawRect(strip);
  if (!has_color()) return;
  const PiecewiseLinear<3> function = document_.scene().volume.color->function();
  const int columns = std::max(1, static_cast<int>(std::ceil(strip.width())));
  for (int i = 0; i < columns; ++i) {
    const double share = (i + 0.5) / columns;
    painter.fillRect(QRectF(strip.left() + i, strip.top() + 1, 1.5, strip.height() - 1),
                     on_screen(function(axes_.value_along(share))));
  }
}

void TransferCurve::paint_surfaces(QPainter& painter) const {
  if (!document_.has_scene()) return;
  const auto& box = axes_.box();
  for (const ChosenHandle& handle : handles()) {
    if (handle.kind != Handle::surface) continue;
    const Place place = *place_of(handle);
    if (place.x < box.left - 1 || place.x > box.right + 1) continue;
    const Isosurface& surface = document_.scene().isosurfaces[handle.index];
    const QColor frame = palette().color(handle == chosen_ ? QPalette::Highlight : QPalette::Text);
    painter.setPen(QPen(frame, handle == chosen_ ? 1.8 : 1, Qt::DashLine));
    painter.drawLine(QPointF(place.x, place.y), QPointF(place.x, box.bottom));
    // a flag in the surface's colour, as full as it is opaque
    const QRectF flag(place.x - 6, place.y - 7, 12, 14);
    painter.setPen(QPen(frame, handle == chosen_ ? 2 : 1));
    painter.setBrush(palette().color(QPalette::Base));
    painter.drawRoundedRect(flag, 3, 3);
    QRectF full = flag.adjusted(1, 1, -1, -1);
    full.setTop(full.bottom() - full.height() * surface.opacity);
    painter.fillRect(full, on_screen(surface.color));
  }
}

void TransferCurve::paint_handle(QPainter& painter, const ChosenHandle& handle) const {
  const std::optional<Place> place = place_of(handle);
  const auto& box = axes_.box();
  if (!place || place->x < box.left - 1 || place->x > box.right + 1) return;
  const bool is_chosen = handle == chosen_;
  const QColor text = palette().color(QPalette::Text), base = palette().color(QPalette::Base);
  painter.setPen(
      QPen(is_chosen ? palette().color(QPalette::Highlight) : text, is_chosen ? 2 : 1.3));
  painter.setBrush(
      is_chosen && handle.kind == Handle::extinction ? palette().color(QPalette::Highlight) : base);
  if (handle.kind == Handle::extinction) {
    painter.drawEllipse(at(*place), kPoint, kPoint);
  } else if (handle.kind == Handle::color) {
    // two rings: one of them is seen on any colour
    const QColor ring = painter.pen().color();
    painter.setBrush(on_screen(document_.scene().volume.color->points[handle.index].value));
    painter.setPen(QPen(base, 4));
    painter.drawEllipse(at(*place), kPoint + 0.5, kPoint + 0.5);
    painter.setPen(QPen(ring, is_chosen ? 2.4 : 1.3));
    painter.drawEllipse(at(*place), kPoint + 1.5, kPoint + 1.5);
  } else {
    // a bracket around the colours between the ends
    const double inwards = handle.index == 0 ? 5 : -5, half = kStrip / 2 + 2;
    const QPolygonF bracket{{QPointF(place->x + inwards, place->y - half),
                             QPointF(place->x, place->y - half), QPointF(place->x, place->y + half),
                             QPointF(place->x + inwards, place->y + half)}};
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(base, 5));
    painter.drawPolyline(bracket);
    painter.setPen(QPen(is_chosen ? palette().color(QPalette::Highlight) : text, 2.4));
    painter.drawPolyline(bracket);
  }
}

QString TransferCurve::readout(const Place& place) const {
  const double value = axes_.value_at(place.x);
  QStringList parts{number(value)};
  if (has_extinction()) {
    const double extinction = document_.scene().volume.extinction->function()(value)[0];
    parts << tr("extinction %1").arg(number(extinction));
    if (const auto length = half_value_length(extinction))
      parts << tr("half after %1").arg(number(*length));
  }
  if (histogram_ && value >= histogram_->edges.front() && value <= histogram_->edges.back()) {
    const auto& edges = histogram_->edges;
    const auto bin =
        std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(edges, value) - edges.begin() - 1, 0,
                                   static_cast<std::ptrdiff_t>(edges.size()) - 2);
    double whole = histogram_->outside[0] + histogram_->outside[1] + histogram_->without_value;
    for (const double volume : histogram_->volumes) whole += volume;
    if (whole > 0)
      parts << tr("%1 % of volume")
                   .arg(
                       number(100 * histogram_->volumes[static_cast<std::size_t>(bin)] / whole, 2));
  }
  return parts.join(QStringLiteral("  ·  "));
}

void TransferCurve::paint_readout(QPainter& painter) const {
  if (!hover_ && !chosen_) return;
  Place place = hover_.value_or(Place{});
  if (pressed_ || !hover_) place = place_of(*chosen_).value_or(place);
  const auto& box = axes_.box();
  if (place.x < box.left || place.x > box.right) return;
  const QString text = readout(place);
  const QRectF frame(box.left + 4, box.top + 3, box.right - box.left - 8,
                     fontMetrics().height() + 4);
  QColor back = palette().color(QPalette::Base);
  back.setAlpha(215);
  const double width = std::min(frame.width(), fontMetrics().horizontalAdvance(text) + 10.0);
  const QRectF label(frame.right() - width, frame.top(), width, frame.height());
  painter.setPen(Qt::NoPen);
  painter.setBrush(back);
  painter.drawRoundedRect(label, 3, 3);
  painter.setPen(palette().color(QPalette::Text));
  painter.drawText(label, Qt::AlignCenter,
                   fontMetrics().elidedText(text, Qt::ElideRight, static_cast<int>(width)));
}

}  // namespace hiac::view

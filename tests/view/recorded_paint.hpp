#pragma once

#include <QPaintEngine>
#include <QPainter>
#include <QPainterPath>
#include <QWidget>
#include <span>
#include <vector>

namespace hiac::view::test {

/// What a widget painted once: a text, a line or polygon, a rectangle or an ellipse.
struct Drawn {
  enum Kind { text, polygon, rectangle, ellipse, image } kind;
  QString words;     ///< of a text
  QPolygonF points;  ///< a text's start on its baseline, a shape's corners, an ellipse's box
  bool is_closed = false;
  QPen pen;
  QBrush brush;
  QRectF clip;  ///< null: none
  bool is_smooth = false;

  [[nodiscard]] QRectF box() const { return points.boundingRect(); }
  [[nodiscard]] bool is_line() const { return kind == polygon && !is_closed; }
};

/// A device that notes what is painted on it instead of colouring pixels: so a test sees numbers
/// and words, whatever the fonts.
class RecordedPaint : public QPaintDevice {
 public:
  explicit RecordedPaint(QWidget& widget) : widget_(widget), engine_(drawn_) {
    widget.render(this, {}, {}, QWidget::RenderFlags());
  }

  [[nodiscard]] const std::vector<Drawn>& all() const& { return drawn_; }
  [[nodiscard]] std::vector<Drawn> all() && { return drawn_; }
  [[nodiscard]] std::vector<Drawn> of(Drawn::Kind kind) const {
    std::vector<Drawn> found;
    for (const Drawn& one : drawn_)
      if (one.kind == kind) found.push_back(one);
    return found;
  }
  /// The texts; those that are drawn with several fonts are one.
  [[nodiscard]] QStringList words() const {
    QStringList lines;
    for (const Drawn& one : of(Drawn::text)) lines << one.words;
    return lines;
  }

  [[nodiscard]] QPaintEngine* paintEngine() const override { return &engine_; }

 protected:
  [[nodiscard]] int metric(PaintDeviceMetric metric) const override {
    switch (metric) {
      case PdmWidth:
        return widget_.width();
      case PdmHeight:
        return widget_.height();
      case PdmDpiX:
      case PdmPhysicalDpiX:
        return widget_.logicalDpiX();
      case PdmDpiY:
      case PdmPhysicalDpiY:
        return widget_.logicalDpiY();
      case PdmDepth:
        return 32;
      case PdmDevicePixelRatio:
        return 1;
      default:
        return QPaintDevice::metric(metric);
    }
  }

 private:
  class Engine : public QPaintEngine {
   public:
    explicit Engine(std::vector<Drawn>& drawn) : QPaintEngine(AllFeatures), drawn_(drawn) {}
    bool begin(QPaintDevice* /*device*/) override { return true; }
    bool end() override { return true; }
    void updateState(const QPaintEngineState& /*state*/) override {}
    [[nodiscard]] Type type() const override { return User; }

    void drawPath(const QPainterPath& path) override {
      for (const QPolygonF& part : path.toSubpathPolygons()) note(Drawn::polygon, part);
    }
    void drawPolygon(const QPointF* points, int count, PolygonDrawMode mode) override {
      note(Drawn::polygon, QPolygonF(QList<QPointF>(points, points + count)), mode != PolylineMode);
    }
    void drawLines(const QLineF* lines, int count) override {
      for (const QLineF& line : std::span(lines, static_cast<std::size_t>(count)))
        note(Drawn::polygon, QPolygonF({line.p1(), line.p2()}));
    }
    void drawRects(const QRectF* rects, int count) override {
      for (const QRectF& rect : std::span(rects, static_cast<std::size_t>(count)))
        note(Drawn::rectangle, QPolygonF(rect), true);
    }
    void drawEllipse(const QRectF& rect) override { note(Drawn::ellipse, QPolygonF(rect), true); }
    void drawPixmap(const QRectF& rect, const QPixmap& /*pixmap*/,
                    const QRectF& /*from*/) override {
      note(Drawn::image, QPolygonF(rect), true);
    }
    void drawImage(const QRectF& rect, const QImage& /*image*/, const QRectF& /*from*/,
                   Qt::ImageConversionFlags /*flags*/) override {
      note(Drawn::image, QPolygonF(rect), true);
    }
    void drawTextItem(const QPointF& at, const QTextItem& item) override {
      note(Drawn::text, QPolygonF({at}));
      drawn_.back().words = item.text();
    }

   private:
    void note(Drawn::Kind kind, const QPolygonF& points, bool is_closed = false) {
      const QPainter& now = *painter();
      drawn_.push_back({kind,
                        {},
                        points,
                        is_closed,
                        now.pen(),
                        now.brush(),
                        now.hasClipping() ? now.clipBoundingRect() : QRectF(),
                        now.testRenderHint(QPainter::Antialiasing)});
    }

    std::vector<Drawn>& drawn_;
  };

  QWidget& widget_;
  std::vector<Drawn> drawn_;
  mutable Engine engine_;
};

}  // namespace hiac::view::test

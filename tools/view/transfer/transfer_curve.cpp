#include "tools/view/transfer/transfer_curve.hpp"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "hiac/base/error.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "hiac/scene/toml/spec_key.hpp"
#include "tools/view/transfer/apply_edit.hpp"
#include "tools/view/transfer/transfer_text.hpp"

namespace hiac::view {
namespace {

constexpr double kReach = 9;  // pixels
constexpr double kLeft = 52, kTop = 26, kRight = 12, kGap = 8;

Place place_of_event(const QMouseEvent& event) {
  return {event.position().x(), event.position().y()};
}

}  // namespace

TransferCurve::TransferCurve(Document& document, QWidget* parent)
    : QWidget(parent), document_(document) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAccessibleName(tr("Transfer functions over the histogram of the field"));
  setStatusTip(
      tr("Drag points; double click adds one, Delete removes it; Shift moves along one axis; "
         "the wheel zooms into the values; the menu adds isosurfaces"));
  connect(&document_, &Document::changed, this, &TransferCurve::read_document);
  read_document();
}

void TransferCurve::show_field(const std::string& field, const std::array<double, 2>& extent) {
  if (field == field_ && extent == extent_) return;
  field_ = field;
  extent_ = extent;
  zoom_.reset();
  histogram_.reset();
  chosen_.reset();
  read_document();
  Q_EMIT values_shown();
}

void TransferCurve::show_histogram(std::shared_ptr<const VolumeHistogram> histogram) {
  histogram_ = std::move(histogram);
  update();
}

void TransferCurve::set_log_counts(bool on) {
  log_counts_ = on;
  update();
}

void TransferCurve::set_log_values(bool on) {
  if (on == log_values_) return;
  log_values_ = on;
  histogram_.reset();
  show_all_values();
}

void TransferCurve::read_document() {
  if (document_.has_scene()) {
    color_is_preset_ = !preset_of(document_.text()).empty();
    color_is_plain_ = has_plain_points<3>(document_.text());
  }
  if (chosen_ && !place_of(*chosen_)) {
    chosen_.reset();
    Q_EMIT handle_chosen();
  }
  update_axes();
  update();
}

// While something is dragged the axes stay, so that it stays below the mouse.
void TransferCurve::update_axes() {
  const double labels = fontMetrics().height() + 6;
  const CurveAxes::Box box{kLeft, kTop, std::max(width() - kRight, kLeft + 10),
                           std::max(height() - labels - kStrip - kGap, kTop + 40)};
  const std::span<const ExtinctionTransfer::Point> points =
      has_extinction() ? std::span(document_.scene().volume.extinction->points)
                       : std::span<const ExtinctionTransfer::Point>();
  const auto extinctions = pressed_ ? axes_.extinctions() : extinction_range(points);
  const ShownValues all = pressed_ ? ShownValues{axes_.values(), axes_.scale()} : all_values();
  const auto values = pressed_ ? all.values : zoom_.value_or(all.values);
  axes_ = CurveAxes(box, values, extinctions, all.scale);
}

// Those of the field, and the points' beside them.
TransferCurve::ShownValues TransferCurve::all_values() const {
  std::vector<double> scalars;
  if (has_extinction())
    for (const auto& point : document_.scene().volume.extinction->points)
      scalars.push_back(point.scalar);
  if (has_color())
    for (const auto& point : document_.scene().volume.color->points)
      scalars.push_back(point.scalar);
  const std::array<double, 2> extent = with_nearby(extent_, scalars);
  if (log_values_)
    if (const auto values = shown_log_values(extent)) return {*values, TransferScale::log};
  return {shown_values(extent), TransferScale::linear};
}

bool TransferCurve::has_extinction() const {
  return document_.has_scene() && document_.scene().volume.extinction &&
         document_.scene().volume.extinction->field == field_ &&
         !document_.scene().volume.extinction->points.empty();
}

bool TransferCurve::has_color() const {
  return document_.has_scene() && document_.scene().volume.color &&
         document_.scene().volume.color->field == field_ &&
         !document_.scene().volume.color->points.empty();
}

double TransferCurve::strip_middle() const { return axes_.box().bottom + kGap + kStrip / 2; }

bool TransferCurve::is_on_strip(const Place& place) const {
  return std::abs(place.y - strip_middle()) <= kStrip / 2 + 3;
}

std::vector<ChosenHandle> TransferCurve::handles() const {
  std::vector<ChosenHandle> all;
  if (!document_.has_scene()) return all;
  const Scene& scene = document_.scene();
  for (std::size_t i = 0; i < scene.isosurfaces.size(); ++i)
    if (scene.isosurfaces[i].field == field_) all.push_back({Handle::surface, i});
  if (has_color() && color_is_preset_) {
    all.insert(all.end(), {{Handle::color_range, 0}, {Handle::color_range, 1}});
  } else if (has_color() && color_is_plain_) {
    for (std::size_t i = 0; i < scene.volume.color->points.size(); ++i)
      all.push_back({Handle::color, i});
  }
  if (has_extinction())
    for (std::size_t i = 0; i < scene.volume.extinction->points.size(); ++i)
      all.push_back({Handle::extinction, i});
  return all;
}

std::optional<Place> TransferCurve::place_of(const ChosenHandle& handle) const {
  const std::vector<ChosenHandle> all = handles();
  if (std::ranges::find(all, handle) == all.end()) return std::nullopt;
  const Scene& scene = document_.scene();
  switch (handle.kind) {
    case Handle::surface:
      return Place{axes_.x_of(scene.isosurfaces[handle.index].value), kTop - 10};
    case Handle::color:
      return Place{axes_.x_of(scene.volume.color->points[handle.index].scalar), strip_middle()};
    case Handle::color_range: {
      const auto& points = scene.volume.color->points;
      const auto& end = handle.index == 0 ? points.front() : points.back();
      return Place{axes_.x_of(end.scalar), strip_middle()};
    }
    default: {
      const auto& point = scene.volume.extinction->points[handle.index];
      return Place{axes_.x_of(point.scalar), axes_.y_of(point.value[0])};
    }
  }
}

// The nearest one; of several at one place the last, which is painted above the others.
std::optional<ChosenHandle> TransferCurve::handle_at(const Place& place) const {
  std::vector<ChosenHandle> all = handles();
  std::vector<Place> places;
  for (const ChosenHandle& handle : all) places.push_back(*place_of(handle));
  if (const auto found = nearest(places, place, kReach)) return all[*found];
  return std::nullopt;
}

void TransferCurve::choose(const std::optional<ChosenHandle>& handle) {
  if (chosen_ == handle) return;
  chosen_ = handle;
  update();
  Q_EMIT handle_chosen();
}

void TransferCurve::resizeEvent(QResizeEvent*) { update_axes(); }

void TransferCurve::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  const Place place = place_of_event(*event);
  choose(handle_at(place));
  goes_on_ = false;
  if (!chosen_) return;
  const Place handle = *place_of(*chosen_);
  pressed_ = place;
  grip_ = {place.x - handle.x, place.y - handle.y};
}

void TransferCurve::mouseMoveEvent(QMouseEvent* event) {
  const Place place = place_of_event(*event);
  hover_ = place;
  if (pressed_ && (event->buttons() & Qt::LeftButton) != 0)
    drag_to(place, (event->modifiers() & Qt::ShiftModifier) != 0);
  else
    setCursor(handle_at(place) ? Qt::PointingHandCursor : Qt::CrossCursor);
  update();
}

void TransferCurve::mouseReleaseEvent(QMouseEvent*) {
  pressed_.reset();
  goes_on_ = false;
  update_axes();
  update();
}

void TransferCurve::drag_to(const Place& place, bool one_axis) {
  // a click with an unsteady hand is no drag
  if (!goes_on_ && std::hypot(place.x - pressed_->x, place.y - pressed_->y) < 3) return;
  Place target{place.x - grip_.x, place.y - grip_.y};
  if (one_axis) {
    const bool sideways = std::abs(place.x - pressed_->x) > std::abs(place.y - pressed_->y);
    (sideways ? target.y : target.x) = sideways ? pressed_->y - grip_.y : pressed_->x - grip_.x;
  }
  move(*chosen_, target, goes_on_);
  goes_on_ = true;
}

void TransferCurve::move(const ChosenHandle& handle, const Place& place, bool goes_on) {
  const double value = axes_.value_at(place.x);
  const std::string& text = document_.text();
  const Scene& scene = document_.scene();
  const std::size_t index = handle.index;
  switch (handle.kind) {
    case Handle::surface:
      apply_edit(document_, tr("move isosurface"), goes_on,
                 [&] { return with_surface_value(text, index, value); });
      return;
    case Handle::color:
      apply_edit(document_, tr("move colour"), goes_on, [&] {
        auto point = scene.volume.color->points[index];
        point.scalar = between_neighbors<3>(scene.volume.color->points, index, value);
        return with_point<3>(text, scene, index, point);
      });
      return;
    case Handle::color_range: {
      const auto& points = scene.volume.color->points;
      std::array<double, 2> range{points.front().scalar, points.back().scalar};
      range[index] = value;
      // two ends that meet are no range
      if (range[0] < range[1])
        apply_edit(document_, tr("colour range"), goes_on,
                   [&] { return with_color_range(text, range); });
      return;
    }
    case Handle::extinction:
      apply_edit(document_, tr("move point"), goes_on, [&] {
        const auto& points = scene.volume.extinction->points;
        return with_point<1>(
            text, scene, index,
            {between_neighbors<1>(points, index, value), {axes_.extinction_at(place.y)}});
      });
  }
}

void TransferCurve::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !document_.has_scene()) return;
  const Place place = place_of_event(*event);
  const std::optional<ChosenHandle> handle = handle_at(place);
  if (!handle)
    add_at(place);
  else if (handle->kind == Handle::color || handle->kind == Handle::surface)
    Q_EMIT color_wanted(*handle);
}

void TransferCurve::add_at(const Place& place) {
  if (is_on_strip(place))
    add_color(axes_.value_at(place.x));
  else
    add_extinction(place);
}

void TransferCurve::add_extinction(const Place& place) {
  const ExtinctionTransfer::Point point{axes_.value_at(place.x), {axes_.extinction_at(place.y)}};
  const Scene& scene = document_.scene();
  if (!scene.volume.extinction) {
    apply_edit(document_, tr("add point"), false, [&] {
      const std::array<double, 2> row{point.scalar, point.value[0]};
      const std::vector<std::pair<std::string, std::string>> keys{
          {"field", toml_text(field_)}, {"points", "[" + toml_text(row) + "]"}};
      return with_table(document_.text(), "volume.extinction", keys);
    });
    return;
  }
  if (!has_extinction()) return;  // that of another field
  const auto& points = scene.volume.extinction->points;
  const auto behind = std::ranges::count_if(
      points, [&](const auto& other) { return other.scalar <= point.scalar; });
  if (apply_edit(document_, tr("add point"), false,
                 [&] { return with_new_point<1>(document_.text(), scene, point); }))
    choose(ChosenHandle{Handle::extinction, static_cast<std::size_t>(behind)});
}

void TransferCurve::add_color(double value) {
  if (!has_color()) return;
  apply_edit(document_, tr("add colour"), false, [&] {
    if (!color_is_plain_)
      throw UsageError("the colour map has no points of its own (turn it into points first)");
    const Scene& scene = document_.scene();
    return with_new_point<3>(document_.text(), scene,
                             {value, scene.volume.color->function()(value)});
  });
}

void TransferCurve::add_surface(double value) {
  apply_edit(document_, tr("add isosurface"), false, [&] {
    Isosurface surface;
    surface.field = field_;
    surface.value = value;
    surface.opacity = 0.5;
    if (has_color()) surface.color = document_.scene().volume.color->function()(value);
    return with_surface(document_.text(), document_.scene(), surface);
  });
}

double TransferCurve::value_here() const {
  const auto& box = axes_.box();
  const auto place = chosen_ ? place_of(*chosen_) : std::nullopt;
  return axes_.value_at(place ? place->x : (box.left + box.right) / 2);
}

void TransferCurve::add_point_here() {
  const double value = value_here();
  const double extinction =
      has_extinction() ? document_.scene().volume.extinction->function()(value)[0] : 0;
  add_extinction({axes_.x_of(value), axes_.y_of(extinction)});
}

void TransferCurve::add_surface_here() { add_surface(value_here()); }

void TransferCurve::remove_chosen() {
  if (!chosen_) return;
  const ChosenHandle handle = *chosen_;
  const std::string& text = document_.text();
  const Scene& scene = document_.scene();
  const auto refuse_last = [](std::size_t count) {
    if (count < 2) throw UsageError("the last point stays: a transfer function has one at least");
  };
  if (handle.kind == Handle::surface)
    apply_edit(document_, tr("remove isosurface"), false,
               [&] { return without_surface(text, handle.index); });
  if (handle.kind == Handle::extinction)
    apply_edit(document_, tr("remove point"), false, [&] {
      refuse_last(scene.volume.extinction->points.size());
      return without_point<1>(text, scene, handle.index);
    });
  if (handle.kind == Handle::color)
    apply_edit(document_, tr("remove colour"), false, [&] {
      refuse_last(scene.volume.color->points.size());
      return without_point<3>(text, scene, handle.index);
    });
}

void TransferCurve::show_all_values() {
  zoom_.reset();
  update_axes();
  update();
  Q_EMIT values_shown();
}

void TransferCurve::wheelEvent(QWheelEvent* event) {
  const double factor = std::pow(0.8, event->angleDelta().y() / 120.0);
  const std::array<double, 2> all = all_values().values;
  const std::array<double, 2> wanted = axes_.zoomed(event->position().x(), factor);
  const bool is_all = wanted[0] <= all[0] && wanted[1] >= all[1];
  zoom_ = is_all ? std::nullopt : std::optional(wanted);
  update_axes();
  update();
  event->accept();
  Q_EMIT values_shown();
}

void TransferCurve::step_through(int by) {
  const std::vector<ChosenHandle> all = handles();
  if (all.empty()) return;
  const auto count = static_cast<std::ptrdiff_t>(all.size());
  const auto now = chosen_ ? std::ranges::find(all, *chosen_) - all.begin() : (by > 0 ? -1 : count);
  choose(all[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(now + by, 0, count - 1))]);
}

void TransferCurve::keyPressEvent(QKeyEvent* event) {
  const bool moves = (event->modifiers() & Qt::ControlModifier) != 0;
  const int key = event->key();
  const int right = key == Qt::Key_Right ? 1 : key == Qt::Key_Left ? -1 : 0;
  const int down = key == Qt::Key_Down ? 1 : key == Qt::Key_Up ? -1 : 0;
  if (key == Qt::Key_Delete || key == Qt::Key_Backspace) {
    remove_chosen();
  } else if (moves && chosen_ && (right != 0 || down != 0)) {
    const Place place = *place_of(*chosen_);
    move(*chosen_, {place.x + right, place.y + down}, event->isAutoRepeat());
  } else if (!moves && right != 0) {
    step_through(right);
  } else {
    QWidget::keyPressEvent(event);
  }
}

void TransferCurve::contextMenuEvent(QContextMenuEvent* event) {
  if (!document_.has_scene()) return;
  const Place place{static_cast<double>(event->pos().x()), static_cast<double>(event->pos().y())};
  const double value = axes_.value_at(place.x);
  choose(handle_at(place));
  QMenu menu(this);
  if (chosen_ && chosen_->kind != Handle::color_range)
    menu.addAction(tr("Remove"), this, &TransferCurve::remove_chosen);
  menu.addAction(is_on_strip(place) ? tr("Add colour here") : tr("Add point here"), this,
                 [&] { add_at(place); });
  menu.addAction(tr("Add isosurface at %1").arg(value), this, [&] { add_surface(value); });
  menu.addSeparator();
  menu.addAction(tr("Show all values"), this, &TransferCurve::show_all_values);
  menu.exec(event->globalPos());
}

void TransferCurve::leaveEvent(QEvent*) {
  hover_.reset();
  update();
}

}  // namespace hiac::view

#pragma once

#include <QWidget>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hiac/session/histogram/volume_histogram.hpp"
#include "tools/view/document/document.hpp"
#include "tools/view/transfer/curve_axes.hpp"

class QPainter;

namespace hiac::view {

/// What can be dragged in a plot of transfer functions.
enum class Handle : std::uint8_t { extinction, color, color_range, surface };

struct ChosenHandle {
  Handle kind;
  std::size_t index;
  bool operator==(const ChosenHandle&) const = default;
};

/// The extinction, the colour and the isosurfaces of one field over the histogram of its values, to
/// be edited: points are dragged, added by a double click, and removed by a key; so are isosurfaces
/// (their menu adds them), and the ends of a colour map. With Shift a point moves along one axis.
/// The wheel zooms into the values.
class TransferCurve : public QWidget {
  Q_OBJECT

 public:
  explicit TransferCurve(Document& document, QWidget* parent = nullptr);

  /// The field on the axis, and the extent of its values.
  void show_field(const std::string& field, const std::array<double, 2>& extent);
  [[nodiscard]] const std::string& field() const { return field_; }
  /// Null: none is known.
  void show_histogram(std::shared_ptr<const VolumeHistogram> histogram);
  /// Null: none has been measured.
  [[nodiscard]] const VolumeHistogram* histogram() const { return histogram_.get(); }
  void set_log_counts(bool on);
  /// Values lie evenly in their logarithm where the field has positive ones.
  void set_log_values(bool on);

  [[nodiscard]] const CurveAxes& axes() const { return axes_; }
  /// Where a handle is; none if there is no such.
  [[nodiscard]] std::optional<Place> place_of(const ChosenHandle& handle) const;
  [[nodiscard]] const std::optional<ChosenHandle>& chosen() const { return chosen_; }
  void choose(const std::optional<ChosenHandle>& handle);

  [[nodiscard]] QSize sizeHint() const override { return {420, 280}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {260, 200}; }

 public Q_SLOTS:
  void remove_chosen();
  /// A point on the curve, an isosurface: at the chosen handle's value, or in the middle.
  void add_point_here();
  void add_surface_here();
  void show_all_values();

 Q_SIGNALS:
  void handle_chosen();
  void color_wanted(hiac::view::ChosenHandle handle);  ///< a double click on a colour or a surface
  void values_shown();  ///< the axis shows other values: another histogram is wanted

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  void read_document();
  void update_axes();
  /// What the axis shows without a zoom.
  struct ShownValues {
    std::array<double, 2> values;
    TransferScale scale;
  };
  [[nodiscard]] ShownValues all_values() const;
  [[nodiscard]] bool has_extinction() const;
  [[nodiscard]] bool has_color() const;
  [[nodiscard]] std::vector<ChosenHandle> handles() const;
  [[nodiscard]] std::optional<ChosenHandle> handle_at(const Place& place) const;
  [[nodiscard]] bool is_on_strip(const Place& place) const;
  static constexpr double kStrip = 18;  // pixels, the height of the strip of colours
  [[nodiscard]] double strip_middle() const;

  void drag_to(const Place& place, bool one_axis);
  void move(const ChosenHandle& handle, const Place& place, bool goes_on);
  void add_at(const Place& place);
  void add_extinction(const Place& place);
  void add_color(double value);
  void add_surface(double value);
  [[nodiscard]] double value_here() const;
  void step_through(int by);

  void paint_histogram(QPainter& painter) const;
  void paint_extinction(QPainter& painter) const;
  void paint_color(QPainter& painter) const;
  void paint_surfaces(QPainter& painter) const;
  void paint_axes(QPainter& painter) const;
  void paint_handle(QPainter& painter, const ChosenHandle& handle) const;
  void paint_readout(QPainter& painter) const;
  [[nodiscard]] QString readout(const Place& place) const;

  Document& document_;
  std::string field_;
  std::array<double, 2> extent_{0, 1};
  std::optional<std::array<double, 2>> zoom_;  // none: all values
  std::shared_ptr<const VolumeHistogram> histogram_;
  bool log_counts_ = false, log_values_ = false;
  bool color_is_preset_ = false, color_is_plain_ = false;  // as the text has it
  CurveAxes axes_;
  std::optional<ChosenHandle> chosen_;
  std::optional<Place> pressed_;  // a drag of the chosen handle begins here
  Place grip_{0, 0};              // from the handle to where it was pressed
  bool goes_on_ = false;
  std::optional<Place> hover_;
};

}  // namespace hiac::view

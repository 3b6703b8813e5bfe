#pragma once

#include <QWidget>
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "tools/view/document/document.hpp"
#include "tools/view/transfer/histogram_source.hpp"
#include "tools/view/transfer/transfer_curve.hpp"
#include "tools/view/transfer/transfer_tables.hpp"

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;
class QSlider;

namespace hiac::view {

/// The editor of transfer functions and isosurfaces: curves over histograms, a density slider,
/// colour maps, and the numbers. One plot shows extinction and colour if they are of one field,
/// two otherwise.
class TransferPanel : public QWidget {
  Q_OBJECT

 public:
  explicit TransferPanel(Document& document, QWidget* parent = nullptr);

  /// The optical depth along the mean ray that meets the mesh, of the picture that is shown; none:
  /// there is no picture.
  void show_depth(std::optional<double> mean_optical_depth);

  [[nodiscard]] TransferCurve& curve() { return *curve_; }
  [[nodiscard]] TransferCurve& color_curve() { return *color_curve_; }
  [[nodiscard]] TransferTables& tables() { return *tables_; }
  [[nodiscard]] QSlider& density() { return *density_; }
  [[nodiscard]] QCheckBox& log_values() { return *log_values_; }
  [[nodiscard]] QComboBox& presets() { return *preset_; }
  [[nodiscard]] QComboBox& extinction_fields() { return *extinction_field_; }
  [[nodiscard]] QComboBox& color_fields() { return *color_field_; }
  /// Whether all histograms have been measured.
  [[nodiscard]] bool is_at_rest() const;

  /// The files of both curves (saved_curves.hpp). What goes wrong is told by the document's
  /// message.
  void save_curves(const QString& file);
  void load_curves(const QString& file);

 private:
  void lay_out();
  QWidget* make_choices();
  QWidget* make_density();
  QWidget* make_buttons();
  void connect_curve(TransferCurve& curve, HistogramSource& source);
  void fill_fields();
  void show_document();
  void show_extent(TransferCurve& curve, const std::string& field);
  void choose_extinction_field(const QString& field);
  void choose_color_field(const QString& field);
  void choose_preset(const QString& name);
  void slide_density(int value);
  void turn_into_points();

  Document& document_;
  QComboBox *extinction_field_, *color_field_, *preset_;
  QPushButton* to_points_;
  TransferCurve *curve_, *color_curve_;
  HistogramSource histogram_, color_histogram_;
  QSlider* density_;
  QLabel *factor_, *depth_;
  QCheckBox *log_counts_, *log_values_;
  TransferTables* tables_;
  std::string undense_;  // the text where the slider's drag began; empty: there is none
};

}  // namespace hiac::view

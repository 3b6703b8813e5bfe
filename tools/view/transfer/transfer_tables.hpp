#pragma once

#include <QTabWidget>
#include <functional>
#include <optional>

#include "tools/view/document/document.hpp"
#include "tools/view/transfer/transfer_curve.hpp"

class QTableWidget;

namespace hiac::view {

/// The numbers behind the curves, to be typed: points of the extinction with their half-value
/// lengths, points of the colour, and isosurfaces.
class TransferTables : public QTabWidget {
  Q_OBJECT

 public:
  explicit TransferTables(Document& document, QWidget* parent = nullptr);

  [[nodiscard]] QTableWidget& extinctions() { return *extinctions_; }
  [[nodiscard]] QTableWidget& colors() { return *colors_; }
  [[nodiscard]] QTableWidget& surfaces() { return *surfaces_; }

  /// Shows the row of a handle of the curves.
  void show_handle(const std::optional<ChosenHandle>& handle);
  /// Lets the user choose the colour of a point or an isosurface.
  void pick_color(const ChosenHandle& handle);

 Q_SIGNALS:
  void row_chosen(hiac::view::ChosenHandle handle);

 private:
  QTableWidget* add_table(const QString& title, const QStringList& columns, Handle kind);
  void fill();
  void fill_extinctions();
  void fill_colors();
  void fill_surfaces();
  void type_extinction(int row, int column, const QString& text);
  void type_color(int row, int column, const QString& text);
  void type_surface(int row, int column, const QString& text);
  void set_color(const ChosenHandle& handle, const Color& color);
  double number_from(const QString& text) const;

  Document& document_;
  QTableWidget *extinctions_, *colors_, *surfaces_;
  bool is_filling_ = false;
};

}  // namespace hiac::view

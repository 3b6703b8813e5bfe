#include "tools/view/transfer/transfer_tables.hpp"

#include <QColorDialog>
#include <QHeaderView>
#include <QLocale>
#include <QTableWidget>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "hiac/scene/toml/spec_key.hpp"
#include "tools/view/transfer/apply_edit.hpp"
#include "tools/view/transfer/display_color.hpp"
#include "tools/view/transfer/transfer_text.hpp"

namespace hiac::view {
namespace {

/// A number with all its digits, so that what is shown is what is there.
QString exact(double value) { return QString::fromStdString(fmt::format("{}", value)); }

void set_cell(QTableWidget& table, int row, int column, const QString& text, bool editable) {
  // an item stays: it may be the one that tells of its own change
  QTableWidgetItem* item = table.item(row, column);
  if (item == nullptr) {
    item = new QTableWidgetItem;
    table.setItem(row, column, item);
  }
  item->setText(text);
  item->setFlags(editable ? item->flags() | Qt::ItemIsEditable
                          : item->flags() & ~Qt::ItemIsEditable);
}

void set_color_cell(QTableWidget& table, int row, int column, const Color& color, bool editable) {
  set_cell(table, row, column, color_text(color), editable);
  QPixmap swatch(12, 12);
  swatch.fill(on_screen(color));
  table.item(row, column)->setIcon(swatch);
}

}  // namespace

TransferTables::TransferTables(Document& document, QWidget* parent)
    : QTabWidget(parent), document_(document) {
  extinctions_ = add_table(tr("Extinction"),
                           {tr("value"), tr("extinction per length"), tr("half-value length")},
                           Handle::extinction);
  colors_ = add_table(tr("Colour"), {tr("value"), tr("colour")}, Handle::color);
  surfaces_ = add_table(tr("Isosurfaces"), {tr("field"), tr("value"), tr("colour"), tr("opacity")},
                        Handle::surface);
  const QString help = tr("#rrggbb as on the screen, a name, or linear red, green and blue");
  colors_->horizontalHeaderItem(1)->setToolTip(help);
  surfaces_->horizontalHeaderItem(2)->setToolTip(help);
  extinctions_->horizontalHeaderItem(2)->setToolTip(
      tr("ln 2 / extinction: the length over which half of the light is absorbed"));
  connect(&document_, &Document::changed, this, &TransferTables::fill);
  fill();
}

QTableWidget* TransferTables::add_table(const QString& title, const QStringList& columns,
                                        Handle kind) {
  auto* table = new QTableWidget(0, static_cast<int>(columns.size()));
  table->setHorizontalHeaderLabels(columns);
  table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table->verticalHeader()->hide();
  table->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 8);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setSelectionMode(QAbstractItemView::SingleSelection);
  table->setAccessibleName(title);
  connect(table, &QTableWidget::cellChanged, this, [this, table, kind](int row, int column) {
    if (is_filling_) return;
    const QString text = table->item(row, column)->text();
    if (kind == Handle::extinction)
      type_extinction(row, column, text);
    else if (kind == Handle::color)
      type_color(row, column, text);
    else
      type_surface(row, column, text);
    fill();  // a refused number goes back to what it was
  });
  connect(table, &QTableWidget::itemSelectionChanged, this, [this, table, kind] {
    if (!is_filling_ && table->currentRow() >= 0)
      Q_EMIT row_chosen({kind, static_cast<std::size_t>(table->currentRow())});
  });
  addTab(table, title);
  return table;
}

void TransferTables::fill() {
  is_filling_ = true;
  fill_extinctions();
  fill_colors();
  fill_surfaces();
  is_filling_ = false;
}

void TransferTables::fill_extinctions() {
  const bool has_any = document_.has_scene() && document_.scene().volume.extinction;
  const auto points = has_any ? document_.scene().volume.extinction->points
                              : std::vector<ExtinctionTransfer::Point>();
  extinctions_->setRowCount(static_cast<int>(points.size()));
  for (int row = 0; row < extinctions_->rowCount(); ++row) {
    const auto& point = points[static_cast<std::size_t>(row)];
    const auto length = half_value_length(point.value[0]);
    set_cell(*extinctions_, row, 0, exact(point.scalar), true);
    set_cell(*extinctions_, row, 1, exact(point.value[0]), true);
    set_cell(*extinctions_, row, 2,
             length ? QString::number(*length, 'g', 6) : QStringLiteral("\u221e"), true);
  }
}

void TransferTables::fill_colors() {
  const bool has_any = document_.has_scene() && document_.scene().volume.color;
  const auto points =
      has_any ? document_.scene().volume.color->points : std::vector<ColorTransfer::Point>();
  const bool is_plain = has_any && has_plain_points<3>(document_.text());
  colors_->setToolTip(is_plain ? QString()
                               : tr("From a colour map: turn it into points to edit them"));
  colors_->setRowCount(static_cast<int>(points.size()));
  for (int row = 0; row < colors_->rowCount(); ++row) {
    const auto& point = points[static_cast<std::size_t>(row)];
    set_cell(*colors_, row, 0, exact(point.scalar), is_plain);
    set_color_cell(*colors_, row, 1, point.value, is_plain);
  }
}

void TransferTables::fill_surfaces() {
  const auto surfaces =
      document_.has_scene() ? document_.scene().isosurfaces : std::vector<Isosurface>();
  surfaces_->setRowCount(static_cast<int>(surfaces.size()));
  for (int row = 0; row < surfaces_->rowCount(); ++row) {
    const Isosurface& surface = surfaces[static_cast<std::size_t>(row)];
    set_cell(*surfaces_, row, 0, QString::fromStdString(surface.field), true);
    set_cell(*surfaces_, row, 1, exact(surface.value), true);
    set_color_cell(*surfaces_, row, 2, surface.color, true);
    set_cell(*surfaces_, row, 3, exact(surface.opacity), true);
  }
}

double TransferTables::number_from(const QString& text) const {
  bool is_number = false;
  const double value = QLocale::c().toDouble(text.trimmed(), &is_number);
  if (!is_number || !std::isfinite(value))
    throw UsageError(
        fmt::format("\"{}\": not a number (expected a finite number)", text.toStdString()));
  return value;
}

void TransferTables::type_extinction(int row, int column, const QString& text) {
  const auto index = static_cast<std::size_t>(row);
  apply_edit(document_, tr("type point"), false, [&] {
    auto point = document_.scene().volume.extinction->points[index];
    if (column == 0) point.scalar = number_from(text);
    if (column == 1) point.value[0] = number_from(text);
    if (column == 2) {
      const bool is_infinite = text.trimmed() == QStringLiteral("\u221e");
      const double length = is_infinite ? 0 : number_from(text);
      if (!is_infinite && !(length > 0)) throw UsageError("a half-value length is positive");
      point.value[0] = is_infinite ? 0 : std::numbers::ln2 / length;
    }
    return with_point<1>(document_.text(), document_.scene(), index, point);
  });
}

void TransferTables::type_color(int row, int column, const QString& text) {
  const ChosenHandle handle{Handle::color, static_cast<std::size_t>(row)};
  if (column == 1) {
    if (const auto color = color_from(text))
      set_color(handle, *color);
    else
      Q_EMIT document_.message(tr("\"%1\": not a colour").arg(text));
    return;
  }
  apply_edit(document_, tr("type colour"), false, [&] {
    auto point = document_.scene().volume.color->points[handle.index];
    point.scalar = number_from(text);
    return with_point<3>(document_.text(), document_.scene(), handle.index, point);
  });
}

void TransferTables::type_surface(int row, int column, const QString& text) {
  const ChosenHandle handle{Handle::surface, static_cast<std::size_t>(row)};
  if (column == 2) {
    if (const auto color = color_from(text))
      set_color(handle, *color);
    else
      Q_EMIT document_.message(tr("\"%1\": not a colour").arg(text));
    return;
  }
  apply_edit(document_, tr("type isosurface"), false, [&] {
    const std::string& before = document_.text();
    if (column == 0)
      return with_key(before, fmt::format("isosurface.{}.field", handle.index),
                      toml_text(text.toStdString()));
    return column == 1 ? with_surface_value(before, handle.index, number_from(text))
                       : with_surface_opacity(before, handle.index, number_from(text));
  });
}

void TransferTables::set_color(const ChosenHandle& handle, const Color& color) {
  apply_edit(document_, tr("colour"), false, [&] {
    if (handle.kind == Handle::surface)
      return with_surface_color(document_.text(), handle.index, color);
    auto point = document_.scene().volume.color->points[handle.index];
    point.value = color;
    return with_point<3>(document_.text(), document_.scene(), handle.index, point);
  });
}

void TransferTables::pick_color(const ChosenHandle& handle) {
  const Scene& scene = document_.scene();
  const Color before = handle.kind == Handle::surface
                           ? scene.isosurfaces[handle.index].color
                           : scene.volume.color->points[handle.index].value;
  const QColor picked = QColorDialog::getColor(on_screen(before), this, tr("Colour"));
  if (picked.isValid() && picked != on_screen(before)) set_color(handle, from_screen(picked));
}

void TransferTables::show_handle(const std::optional<ChosenHandle>& handle) {
  if (!handle || handle->kind == Handle::color_range) return;
  QTableWidget* table = handle->kind == Handle::extinction ? extinctions_
                        : handle->kind == Handle::color    ? colors_
                                                           : surfaces_;
  is_filling_ = true;
  setCurrentWidget(table);
  table->selectRow(static_cast<int>(handle->index));
  is_filling_ = false;
}

}  // namespace hiac::view

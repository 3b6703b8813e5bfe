#include "tools/view/pixel/pixel_panel.hpp"

#include <QApplication>
#include <QClipboard>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTextBlock>
#include <QVBoxLayout>

#include "tools/common/picture/pixel_report.hpp"
#include "tools/view/pixel/depth_curve.hpp"

namespace hiac::view {

PixelPanel::PixelPanel(QWidget* parent)
    : QWidget(parent),
      curve_(new DepthCurve),
      table_(new QPlainTextEdit),
      cell_(new QLabel),
      copy_text_(new QPushButton(tr("Copy as text"))),
      copy_json_(new QPushButton(tr("Copy as JSON"))) {
  table_->setReadOnly(true);
  table_->setLineWrapMode(QPlainTextEdit::NoWrap);
  table_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  table_->setAccessibleName(tr("Table of the segments along the ray"));
  table_->setToolTip(
      tr("Every cell on the ray, front to back: depth in world units, extinction "
         "(tau) per world unit"));
  cell_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  cell_->setWordWrap(true);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(copy_text_);
  buttons->addWidget(copy_json_);
  buttons->addStretch();
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(curve_, 1);
  layout->addWidget(table_, 2);
  layout->addWidget(cell_);
  layout->addLayout(buttons);
  connect(table_, &QPlainTextEdit::cursorPositionChanged, this, &PixelPanel::tell_cell);
  connect(copy_text_, &QPushButton::clicked, this,
          [this] { QApplication::clipboard()->setText(text()); });
  connect(copy_json_, &QPushButton::clicked, this, [this] {
    const auto json = tools::pixel_json(*pixel_->explanation.pixel, pixel_->scene);
    QApplication::clipboard()->setText(QString::fromStdString(json.dump(2)));
  });
  show_pixel(nullptr, nullptr);
}

void PixelPanel::show_pixel(std::shared_ptr<const ExplainedPixel> pixel,
                            std::shared_ptr<const ZooMesh> mesh) {
  pixel_ = std::move(pixel);
  mesh_ = std::move(mesh);
  curve_->show_pixel(pixel_);
  table_->setPlainText(text());
  copy_text_->setEnabled(pixel_ != nullptr);
  copy_json_->setEnabled(pixel_ != nullptr);
  tell_cell();
}

QString PixelPanel::text() const {
  if (!pixel_) return {};
  return QString::fromStdString(tools::pixel_table(*pixel_->explanation.pixel, pixel_->scene));
}

// The cell of the table's line with the cursor: its kind and its nodes.
void PixelPanel::tell_cell() {
  cell_->clear();
  if (!pixel_ || !mesh_) return;
  const auto& segments = pixel_->explanation.pixel->segments;
  // a segment's first line begins with its number, where those of its isosurfaces and of its end
  // have blanks
  const qsizetype digits = QString::number(segments.size()).size();
  for (QTextBlock line = table_->textCursor().block(); line.isValid(); line = line.previous()) {
    bool is_number = false;
    const int number = line.text().left(digits).toInt(&is_number);
    if (!is_number || number < 1 || number > static_cast<int>(segments.size())) continue;
    const PixelSegment& segment = segments[static_cast<std::size_t>(number - 1)];
    if (segment.cell == kNoCell) return;  // of an edge beside all cells
    QStringList nodes;
    for (const NodeId node : mesh_->cell_nodes(segment.cell)) nodes << QString::number(node);
    const auto kind = kind_name(segment.kind);
    cell_->setText(tr("cell %1, %2, nodes %3")
                       .arg(segment.cell)
                       .arg(QLatin1String(kind.data(), static_cast<qsizetype>(kind.size())),
                            nodes.join(QLatin1Char(' '))));
    return;
  }
}

}  // namespace hiac::view

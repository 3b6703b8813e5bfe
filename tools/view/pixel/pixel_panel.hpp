#pragma once

#include <QWidget>
#include <memory>

#include "hiac/mesh/zoo_mesh.hpp"
#include "tools/view/viewport/drawing.hpp"

class QLabel;
class QPlainTextEdit;
class QPushButton;

namespace hiac::view {

class DepthCurve;

/// How one pixel is computed: a curve over depth, and hiac-render's table of --pixel.
class PixelPanel : public QWidget {
  Q_OBJECT

 public:
  explicit PixelPanel(QWidget* parent = nullptr);

  /// `mesh` has the cells of the pixel; null pixel: nothing is shown.
  void show_pixel(std::shared_ptr<const ExplainedPixel> pixel, std::shared_ptr<const ZooMesh> mesh);

  /// The table, to the letter that of hiac-render --pixel.
  [[nodiscard]] QString text() const;

 private:
  void tell_cell();

  std::shared_ptr<const ExplainedPixel> pixel_;
  std::shared_ptr<const ZooMesh> mesh_;
  DepthCurve* curve_;
  QPlainTextEdit* table_;
  QLabel* cell_;
  QPushButton *copy_text_, *copy_json_;
};

}  // namespace hiac::view

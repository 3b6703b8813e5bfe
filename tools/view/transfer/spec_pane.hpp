#pragma once

#include <QWidget>

#include "tools/view/document/document.hpp"

class QLabel;
class QPlainTextEdit;
class QPushButton;

namespace hiac::view {

/// The text of the specification, live. What is typed there becomes the document by a button (or
/// Ctrl+Return) if it parses; if not, the parser's line is shown, and the text stays typed. A typed
/// text is not overwritten by other edits.
class SpecPane : public QWidget {
  Q_OBJECT

 public:
  explicit SpecPane(Document& document, QWidget* parent = nullptr);

  [[nodiscard]] QPlainTextEdit& editor() { return *editor_; }
  [[nodiscard]] QString fault() const;

 public Q_SLOTS:
  void apply();
  void revert();

 private:
  void show_document();
  void show_state();

  Document& document_;
  QPlainTextEdit* editor_;
  QPushButton *apply_, *revert_;
  QLabel* fault_;
  bool is_typed_ = false, is_shown_ = false;
};

}  // namespace hiac::view

#pragma once

#include <QFrame>

class QLabel;

namespace hiac::view {

/// A line for errors and findings, above the picture; not there as long as there is none.
class MessageLine : public QFrame {
  Q_OBJECT

 public:
  explicit MessageLine(QWidget* parent = nullptr);

  void tell(const QString& line);
  void dismiss();
  [[nodiscard]] QString text() const;

 private:
  QLabel* label_;
};

}  // namespace hiac::view

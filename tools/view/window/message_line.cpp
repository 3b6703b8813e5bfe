#include "tools/view/window/message_line.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

namespace hiac::view {

MessageLine::MessageLine(QWidget* parent) : QFrame(parent), label_(new QLabel) {
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  setBackgroundRole(QPalette::ToolTipBase);
  label_->setForegroundRole(QPalette::ToolTipText);
  label_->setWordWrap(true);
  label_->setTextFormat(Qt::PlainText);
  label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* close = new QToolButton;
  close->setText(QStringLiteral("\u00d7"));
  close->setAutoRaise(true);
  close->setToolTip(tr("Close this message"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(8, 2, 2, 2);
  layout->addWidget(label_, 1);
  layout->addWidget(close);
  connect(close, &QToolButton::clicked, this, &MessageLine::dismiss);
  dismiss();
}

void MessageLine::tell(const QString& line) {
  label_->setText(line);
  show();
}

void MessageLine::dismiss() {
  label_->clear();
  hide();
}

QString MessageLine::text() const { return label_->text(); }

}  // namespace hiac::view

#include "tools/view/transfer/spec_pane.hpp"

#include <QFontDatabase>
#include <QHBoxLayout>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QShortcut>
#include <QSyntaxHighlighter>
#include <QVBoxLayout>
#include <algorithm>
#include <string>

#include "hiac/scene/toml/text_layout.hpp"
#include "tools/view/transfer/display_color.hpp"

namespace hiac::view {
namespace {

/// Where the comment of a line begins, or the line's end.
std::size_t comment_begin(const std::string& line) {
  std::size_t at = 0;
  while (at < line.size() && line[at] != '#')
    at = line[at] == '"' || line[at] == '\'' ? skip_string(line, at) : at + 1;
  return std::min(at, line.size());
}

/// Headers stand out, and comments step back.
class TomlColors : public QSyntaxHighlighter {
 public:
  TomlColors(QTextDocument* text, const QPalette& palette) : QSyntaxHighlighter(text) {
    header_.setFontWeight(QFont::Bold);
    comment_.setForeground(
        mixed(palette.color(QPalette::Text), palette.color(QPalette::Base), 0.45));
  }

 protected:
  void highlightBlock(const QString& line) override {
    const QString code =
        QString::fromStdString(line.toStdString().substr(0, comment_begin(line.toStdString())));
    const QString words = code.trimmed();
    const bool is_header = words.startsWith(QLatin1Char('[')) && words.endsWith(QLatin1Char(']')) &&
                           !words.contains(QLatin1Char(','));
    if (is_header) setFormat(0, static_cast<int>(code.size()), header_);
    setFormat(static_cast<int>(code.size()), static_cast<int>(line.size() - code.size()), comment_);
  }

 private:
  QTextCharFormat header_, comment_;
};

}  // namespace

SpecPane::SpecPane(Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      editor_(new QPlainTextEdit),
      apply_(new QPushButton(tr("Apply"))),
      revert_(new QPushButton(tr("Revert"))),
      fault_(new QLabel) {
  editor_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  editor_->setLineWrapMode(QPlainTextEdit::NoWrap);
  editor_->setAccessibleName(tr("The specification's text"));
  new TomlColors(editor_->document(), palette());
  apply_->setToolTip(tr("The typed text becomes the view (Ctrl+Return)"));
  revert_->setToolTip(tr("Forget what was typed"));
  fault_->setWordWrap(true);
  fault_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(fault_, 1);
  buttons->addWidget(revert_);
  buttons->addWidget(apply_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->addWidget(editor_, 1);
  layout->addLayout(buttons);
  auto* shortcut = new QShortcut(QKeySequence(Qt::CTRL | Qt::Key_Return), this);
  shortcut->setContext(Qt::WidgetWithChildrenShortcut);
  connect(shortcut, &QShortcut::activated, this, &SpecPane::apply);
  connect(apply_, &QPushButton::clicked, this, &SpecPane::apply);
  connect(revert_, &QPushButton::clicked, this, &SpecPane::revert);
  connect(&document_, &Document::changed, this, &SpecPane::show_document);
  connect(editor_, &QPlainTextEdit::textChanged, this, [this] {
    if (is_shown_) return;
    is_typed_ = editor_->toPlainText() != QString::fromStdString(document_.text());
    show_state();
  });
  show_document();
}

QString SpecPane::fault() const { return fault_->text(); }

void SpecPane::show_state() {
  apply_->setEnabled(is_typed_);
  revert_->setEnabled(is_typed_);
  if (!is_typed_) fault_->clear();
}

// Replaces what differs alone: the cursor and the scroll bars stay where they are.
void SpecPane::show_document() {
  if (is_typed_) return;
  is_shown_ = true;
  const QString before = editor_->toPlainText();
  const QString after = QString::fromStdString(document_.text());
  const qsizetype least = std::min(before.size(), after.size());
  qsizetype begin = 0, behind = 0;
  while (begin < least && before[begin] == after[begin]) ++begin;
  while (behind < least - begin &&
         before[before.size() - 1 - behind] == after[after.size() - 1 - behind])
    ++behind;
  const int scrolled = editor_->verticalScrollBar()->value();
  QTextCursor cursor(editor_->document());
  cursor.setPosition(static_cast<int>(begin));
  cursor.setPosition(static_cast<int>(before.size() - behind), QTextCursor::KeepAnchor);
  cursor.insertText(after.mid(begin, after.size() - behind - begin));
  editor_->document()->clearUndoRedoStacks();
  editor_->verticalScrollBar()->setValue(scrolled);
  is_shown_ = false;
  show_state();
}

void SpecPane::apply() {
  if (!is_typed_) return;
  QString line;
  const auto told = connect(&document_, &Document::message, this,
                            [&](const QString& message) { line = message; });
  const std::string text = editor_->toPlainText().toStdString();
  is_typed_ = false;
  const bool is_taken = document_.has_scene()
                            ? document_.edit(tr("typed text"), text)
                            : document_.open_text(text, document_.file(), document_.folder());
  disconnect(told);
  is_typed_ = !is_taken;
  fault_->setText(line);
  show_state();
}

void SpecPane::revert() {
  is_typed_ = false;
  show_document();
}

}  // namespace hiac::view

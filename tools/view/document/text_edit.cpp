#include "tools/view/document/text_edit.hpp"

#include <utility>

#include "tools/view/document/document.hpp"

namespace hiac::view {

TextEdit::TextEdit(Document& document, const QString& label, std::string before, std::string after,
                   bool merges_with_last)
    : QUndoCommand(label),
      document_(document),
      before_(std::move(before)),
      after_(std::move(after)),
      merges_with_last_(merges_with_last) {}

void TextEdit::undo() { document_.show(before_); }

void TextEdit::redo() { document_.show(after_); }

bool TextEdit::mergeWith(const QUndoCommand* later) {
  const auto& other = static_cast<const TextEdit&>(*later);
  if (!other.merges_with_last_ || other.text() != text()) return false;
  after_ = other.after_;
  return true;
}

}  // namespace hiac::view

#pragma once

#include <QString>
#include <QUndoCommand>
#include <string>

namespace hiac::view {

class Document;

/// One edit of a document: the text before it and the text after it, both of which parse.
class TextEdit : public QUndoCommand {
 public:
  TextEdit(Document& document, const QString& label, std::string before, std::string after,
           bool merges_with_last);

  void undo() override;
  void redo() override;
  [[nodiscard]] int id() const override { return kId; }
  bool mergeWith(const QUndoCommand* later) override;

 private:
  static constexpr int kId = 1;  // merging is asked for among edits of one id

  Document& document_;
  std::string before_, after_;
  bool merges_with_last_;
};

}  // namespace hiac::view

#pragma once

#include <QObject>
#include <QString>
#include <QUndoStack>
#include <memory>
#include <optional>
#include <string>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/specification.hpp"
#include "tools/view/document/known_ranges.hpp"

namespace hiac::view {

/// What the window edits: the text of one image specification, and the mesh that it is shown of.
///
/// The text is the document. Every edit makes a new text, and undo goes back to the one before. A
/// text that does not parse never becomes the document: the edit is refused, and `message` tells
/// why. Lives in the thread of the window.
class Document : public QObject {
  Q_OBJECT

 public:
  explicit Document(QObject* parent = nullptr);

  /// The specification in TOML; empty as long as there is none.
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] bool has_scene() const { return parsed_.has_value(); }
  /// What the text says. With a mesh, points of transfer functions stand on their fields' scalars.
  /// There is a text.
  [[nodiscard]] const ParsedScene& parsed() const { return *parsed_; }
  [[nodiscard]] const Scene& scene() const { return parsed_->scene; }

  /// Null as long as there is none.
  [[nodiscard]] const std::shared_ptr<const ZooMesh>& mesh() const { return mesh_; }
  /// The file of the mesh, and that of the text; "" if there is none.
  [[nodiscard]] const std::string& mesh_file() const { return mesh_file_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  /// Where relative paths in the text start; "" for the working folder.
  [[nodiscard]] const std::string& folder() const { return folder_; }

  /// Replaces the text. `label` names the edit in the menu. With `merges_with_last`, an edit of the
  /// same label right before it and this one are undone together: the steps of one drag. Returns
  /// false, and leaves everything as it is, if the text is refused.
  bool edit(const QString& label, std::string text, bool merges_with_last = false);

  /// Begins with a mesh (null: none yet) and a text ("": none yet), which cannot be undone.
  /// `file`: where the text is from, "" for one that no file holds; paths in it are relative to
  /// `folder`. Returns false, and leaves everything as it is, if the text is refused.
  bool open(std::shared_ptr<const ZooMesh> mesh, const std::string& mesh_file, std::string text,
            const std::string& file, const std::string& folder);
  /// Keeps the mesh.
  bool open_text(std::string text, const std::string& file, const std::string& folder);
  /// Goes on with another mesh and the same text, which may be undone as before. Returns false, and
  /// leaves everything as it is, if the mesh lacks a field whose range the text needs.
  bool change_mesh(std::shared_ptr<const ZooMesh> mesh, const std::string& mesh_file);

  /// The text is now that of a file.
  void saved_as(const std::string& file);

  /// Undo and redo, and whether the text is the saved one (QUndoStack::isClean).
  [[nodiscard]] QUndoStack& undo_stack() { return undo_; }

 Q_SIGNALS:
  void changed();              ///< the text is another one, or there is none any more
  void mesh_changed();         ///< comes before `changed`, if both do
  void file_changed();         ///< the text is in another file, or was saved
  void message(QString line);  ///< a refused edit, a finding: one line for the status line

 private:
  friend class TextEdit;
  std::optional<ParsedScene> parsed_from(const std::string& text);
  void show(const std::string& text);  // of an edit that is done, undone or done again

  std::string text_, file_, folder_, mesh_file_;
  std::optional<ParsedScene> parsed_;
  std::optional<ParsedScene> next_;  // of the text that is about to be shown
  std::shared_ptr<const ZooMesh> mesh_;
  KnownRanges ranges_;
  QUndoStack undo_;
};

}  // namespace hiac::view

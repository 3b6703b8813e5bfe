#include "tools/view/document/document.hpp"

#include <utility>

#include "hiac/base/error.hpp"
#include "hiac/scene/toml/spec_text.hpp"
#include "tools/view/document/text_edit.hpp"

namespace hiac::view {

Document::Document(QObject* parent) : QObject(parent) {}

std::optional<ParsedScene> Document::parsed_from(const std::string& text) {
  try {
    ParsedScene parsed = parse_scene(text, file_.empty() ? "view" : file_, folder_);
    return mesh_ ? ranges_.place(std::move(parsed), *mesh_) : std::move(parsed);
  } catch (const Error& error) {
    Q_EMIT message(QString::fromStdString(in_one_line(error.what())));
    return std::nullopt;
  }
}

bool Document::edit(const QString& label, std::string text, bool merges_with_last) {
  if (text == text_) return true;
  std::optional<ParsedScene> parsed = parsed_from(text);
  if (!parsed) return false;
  next_ = std::move(parsed);  // redo() below, which the stack calls, needs no second parse
  undo_.push(new TextEdit(*this, label, text_, std::move(text), merges_with_last));
  return true;
}

void Document::show(const std::string& text) {
  std::optional<ParsedScene> parsed =
      next_ ? std::exchange(next_, std::nullopt) : parsed_from(text);
  if (!parsed) return;  // a preset's file that is gone: told by parsed_from
  text_ = text;
  parsed_ = std::move(parsed);
  Q_EMIT changed();
}

bool Document::open(std::shared_ptr<const ZooMesh> mesh, const std::string& mesh_file,
                    std::string text, const std::string& file, const std::string& folder) {
  const bool is_other_mesh = mesh != mesh_;
  const std::string old_file = std::exchange(file_, file);
  const std::string old_folder = std::exchange(folder_, folder);
  const std::shared_ptr<const ZooMesh> old_mesh = std::exchange(mesh_, std::move(mesh));
  if (is_other_mesh) ranges_.forget();
  std::optional<ParsedScene> parsed;
  if (!text.empty() && !(parsed = parsed_from(text))) {
    file_ = old_file;
    folder_ = old_folder;
    mesh_ = old_mesh;
    if (is_other_mesh) ranges_.forget();
    return false;
  }
  mesh_file_ = mesh_file;
  text_ = std::move(text);
  parsed_ = std::move(parsed);
  undo_.clear();
  if (is_other_mesh) Q_EMIT mesh_changed();
  Q_EMIT changed();
  return true;
}

bool Document::open_text(std::string text, const std::string& file, const std::string& folder) {
  return open(mesh_, mesh_file_, std::move(text), file, folder);
}

bool Document::change_mesh(std::shared_ptr<const ZooMesh> mesh, const std::string& mesh_file) {
  const std::shared_ptr<const ZooMesh> before = std::exchange(mesh_, std::move(mesh));
  ranges_.forget();
  std::optional<ParsedScene> parsed;
  if (parsed_ && !(parsed = parsed_from(text_))) {
    mesh_ = before;
    ranges_.forget();
    return false;
  }
  mesh_file_ = mesh_file;
  parsed_ = std::move(parsed);
  Q_EMIT mesh_changed();
  Q_EMIT changed();
  return true;
}

void Document::saved_as(const std::string& file) {
  file_ = file;
  undo_.setClean();
  Q_EMIT file_changed();
}

}  // namespace hiac::view

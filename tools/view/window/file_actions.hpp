#pragma once

#include <QMenu>
#include <QObject>
#include <QSettings>
#include <QWidget>
#include <memory>
#include <string>

#include "tools/common/picture/picture_command.hpp"
#include "tools/common/tool.hpp"
#include "tools/view/document/document.hpp"
#include "tools/view/document/mesh_loading.hpp"
#include "tools/view/viewport/painter.hpp"

namespace hiac::view {

/// What the window does with files: opening meshes and specifications, saving, exporting pictures.
/// Everything that takes long is done on other threads.
class FileActions : public QObject {
  Q_OBJECT

 public:
  /// All must outlive this object. `window`: the parent of file dialogs.
  FileActions(Document& document, tools::Tool& tool, QSettings& settings, QWidget* window);
  ~FileActions() override;

  /// Opens a mesh as a command line has it, and the specification in `command.view` if there is
  /// one; without, the present one if it fits the mesh, and a starter view otherwise.
  void open(const tools::PictureCommand& command);
  /// Opens a file of either kind: a specification, a picture that holds one, or a mesh.
  void open_file(const QString& path);
  void open_view(const QString& path);
  /// Reads the mesh again.
  void reload();

  bool save();
  bool save_to(const QString& path);
  void export_picture(const QString& path, std::shared_ptr<const Painted> picture);

  // by dialogs
  void choose_mesh();
  void choose_view();
  bool choose_save();
  void choose_export(std::shared_ptr<const Painted> picture);

  /// How the mesh was read; its `view` is empty.
  [[nodiscard]] const tools::PictureCommand& command() const { return command_; }
  [[nodiscard]] bool is_busy() const { return loading_.is_busy() || exports_ > 0; }
  /// A menu of the files opened last.
  [[nodiscard]] QMenu* recent_menu() { return &recent_; }

 Q_SIGNALS:
  void opened();                ///< another mesh or text is there
  void message(QString line);   ///< for the line of messages
  void progress(QString text);  ///< for the middle of the window: what is being done; "": nothing

 private:
  void take(const std::shared_ptr<const LoadedMesh>& mesh);
  void remember(const QString& path);
  void fill_recent_menu();
  [[nodiscard]] QString folder() const;  // where dialogs begin

  Document& document_;
  QSettings& settings_;
  QWidget* window_;
  MeshLoading loading_;
  QMenu recent_;
  tools::PictureCommand command_, next_;
  bool keeps_text_ = false;  // the mesh that is read is the present one, changed
  int exports_ = 0;
};

}  // namespace hiac::view

#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <string>
#include <thread>

#include "hiac/mesh/zoo_mesh.hpp"
#include "tools/common/picture/picture_command.hpp"
#include "tools/common/tool.hpp"

namespace hiac::view {

/// A mesh that was read, and a text to begin with if there was none.
struct LoadedMesh {
  std::shared_ptr<const ZooMesh> mesh;
  std::string file;
  std::string starter_text;  ///< a starter view of the mesh
};

/// Reads meshes on a thread of its own, one at a time: foreign files by hiac-convert.
class MeshLoading : public QObject {
  Q_OBJECT

 public:
  /// `tool` must outlive this object.
  explicit MeshLoading(tools::Tool& tool, QObject* parent = nullptr);
  ~MeshLoading() override;

  /// Begins to read `command.input`. Nothing is being read.
  void start(tools::PictureCommand command);
  [[nodiscard]] bool is_busy() const { return is_busy_; }

 Q_SIGNALS:
  // in the thread of this object
  void loaded(std::shared_ptr<const hiac::view::LoadedMesh> mesh);
  void failed(QString line);

 private:
  tools::Tool& tool_;
  bool is_busy_ = false;
  std::thread thread_;
};

}  // namespace hiac::view

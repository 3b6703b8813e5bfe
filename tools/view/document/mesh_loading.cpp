#include "tools/view/document/mesh_loading.hpp"

#include <exception>
#include <utility>

#include "hiac/scene/toml/spec_text.hpp"
#include "hiac/session/starter_view.hpp"
#include "tools/common/mesh_io.hpp"

namespace hiac::view {
namespace {

LoadedMesh load(tools::Tool& tool, const tools::PictureCommand& command) {
  ZooFile file = tools::mesh_of(tool, command);
  const StarterView starter =
      make_starter_view(file.mesh, tools::input_name(command.input), command.starter);
  return {std::make_shared<const ZooMesh>(std::move(file.mesh)), command.input,
          tools::file_text(starter, tools::input_name(command.input))};
}

}  // namespace

MeshLoading::MeshLoading(tools::Tool& tool, QObject* parent) : QObject(parent), tool_(tool) {}

MeshLoading::~MeshLoading() {
  if (thread_.joinable()) thread_.join();
}

void MeshLoading::start(tools::PictureCommand command) {
  is_busy_ = true;
  if (thread_.joinable()) thread_.join();
  thread_ = std::thread([this, command = std::move(command)] {
    std::shared_ptr<const LoadedMesh> mesh;
    QString fault;
    try {
      mesh = std::make_shared<const LoadedMesh>(load(tool_, command));
    } catch (const std::bad_alloc&) {
      fault = tr("%1: out of memory").arg(QString::fromStdString(command.input));
    } catch (const std::exception& error) {
      fault = QString::fromStdString(in_one_line(error.what()));
    }
    QMetaObject::invokeMethod(this, [this, mesh, fault] {
      is_busy_ = false;
      if (mesh)
        Q_EMIT loaded(mesh);
      else
        Q_EMIT failed(fault);
    });
  });
}

}  // namespace hiac::view

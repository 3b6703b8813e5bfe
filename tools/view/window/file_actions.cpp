#include "tools/view/window/file_actions.hpp"

#include <QFileDialog>
#include <QFileInfo>
#include <QThreadPool>
#include <exception>
#include <filesystem>
#include <utility>

#include "hiac/annotate/annotate.hpp"
#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/scene/paraview/paraview_view.hpp"
#include "hiac/scene/toml/spec_text.hpp"
#include "tools/common/picture/picture_output.hpp"
#include "tools/common/picture/specification.hpp"
#include "tools/common/run_files.hpp"
#include "tools/common/text_output.hpp"

namespace hiac::view {
namespace {

constexpr int kRecentFiles = 10;

QString text_of(const std::exception& error) {
  return QString::fromStdString(in_one_line(error.what()));
}

// What a picture's file gets: the annotation where its format has room for it, as hiac-render does.
Image finished(const Painted& picture, const std::string& path) {
  const Wanted& wanted = *picture.wanted;
  Image image = *picture.image;
  const bool has_room = wanted.annotation.in_float_formats || has_integer_samples(path);
  if (wanted.annotation.draws() && has_room)
    Annotator(wanted.annotation, wanted.scene, annotation_facts(*wanted.mesh, wanted.scene.volume))
        .draw(image, whole_picture(wanted.scene.image), true);
  return image;
}

void write(const Painted& picture, const std::string& path) {
  write_image(
      path, finished(picture, path),
      {.background_included = true,
       .attributes = tools::picture_attributes("hiac-view", picture.mesh_hash,
                                               picture.wanted->scene, picture.wanted->annotation)});
}

}  // namespace

FileActions::FileActions(Document& document, tools::Tool& tool, QSettings& settings,
                         QWidget* window)
    : document_(document),
      settings_(settings),
      window_(window),
      loading_(tool),
      recent_(tr("Open &recent")) {
  connect(&loading_, &MeshLoading::loaded, this, &FileActions::take);
  connect(&loading_, &MeshLoading::failed, this, [this](const QString& line) {
    Q_EMIT progress({});
    Q_EMIT message(line);
  });
  connect(&recent_, &QMenu::aboutToShow, this, &FileActions::fill_recent_menu);
  fill_recent_menu();
}

FileActions::~FileActions() { QThreadPool::globalInstance()->waitForDone(); }

void FileActions::open(const tools::PictureCommand& command) {
  if (loading_.is_busy()) {
    Q_EMIT message(
        tr("%1: another mesh is still being read").arg(QString::fromStdString(command.input)));
    return;
  }
  next_ = command;
  Q_EMIT progress(tr("Reading %1").arg(QString::fromStdString(command.input)));
  loading_.start(command);
}

void FileActions::take(const std::shared_ptr<const LoadedMesh>& mesh) {
  Q_EMIT progress({});
  const bool keeps_text = std::exchange(keeps_text_, false) && document_.has_scene();
  try {
    bool is_open = false;
    if (!next_.view.empty()) {
      is_open =
          document_.open(mesh->mesh, mesh->file, tools::specification_text(next_.view), next_.view,
                         std::filesystem::path(next_.view).parent_path().string());
      if (is_open) remember(QString::fromStdString(next_.view));
    } else if (keeps_text) {
      is_open = document_.change_mesh(mesh->mesh, mesh->file);
    }
    if (!is_open && !keeps_text)
      is_open = document_.open(mesh->mesh, mesh->file, mesh->starter_text, "", "");
    if (!is_open) return;
  } catch (const Error& error) {
    Q_EMIT message(text_of(error));
    document_.open(mesh->mesh, mesh->file, mesh->starter_text, "", "");
  }
  command_ = next_;
  command_.view.clear();
  remember(QString::fromStdString(mesh->file));
  Q_EMIT opened();
}

void FileActions::reload() {
  if (command_.input.empty()) return;
  keeps_text_ = true;
  open(command_);
}

void FileActions::open_view(const QString& path) {
  try {
    const std::string file = path.toStdString();
    if (!document_.open_text(tools::specification_text(file), file,
                             std::filesystem::path(file).parent_path().string()))
      return;
    remember(path);
    Q_EMIT opened();
  } catch (const Error& error) {
    Q_EMIT message(text_of(error));
  }
}

void FileActions::open_file(const QString& path) {
  const std::string file = path.toStdString();
  if (path.endsWith(QStringLiteral(".toml")) || has_image_extension(file) || is_paraview_file(file))
    return open_view(path);
  tools::PictureCommand command;
  command.input = file;
  open(command);
}

bool FileActions::save() {
  const QString file = QString::fromStdString(document_.file());
  // the specification of a picture or of ParaView's state goes into a file of its own
  if (file.isEmpty() || has_image_extension(document_.file()) || is_paraview_file(document_.file()))
    return choose_save();
  return save_to(file);
}

bool FileActions::save_to(const QString& path) {
  if (!document_.has_scene()) return false;
  try {
    const std::string file = path.toStdString();
    tools::require_safe({{command_.input}, {{"save", file, tools::FileKind::specification}}});
    tools::write_text(file, document_.text());
    document_.saved_as(file);
    remember(path);
    return true;
  } catch (const Error& error) {
    Q_EMIT message(text_of(error));
    return false;
  }
}

void FileActions::export_picture(const QString& path, std::shared_ptr<const Painted> picture) {
  if (!picture || !picture->image) {
    Q_EMIT message(tr("The picture is not finished yet: export it when all pixels are shown"));
    return;
  }
  const std::string file = path.toStdString();
  try {
    require_known_image_extension(file);
    tools::RunFiles files{{command_.input, document_.file()}, {}};
    tools::add_image(files.outputs, "export", file);
    tools::require_safe(files);
  } catch (const Error& error) {
    Q_EMIT message(text_of(error));
    return;
  }
  ++exports_;
  QThreadPool::globalInstance()->start([this, picture = std::move(picture), file] {
    QString fault;
    try {
      write(*picture, file);
    } catch (const std::exception& error) {
      fault = text_of(error);
    }
    QMetaObject::invokeMethod(this, [this, fault, file] {
      --exports_;
      Q_EMIT message(fault.isEmpty() ? tr("%1 is written").arg(QString::fromStdString(file))
                                     : fault);
    });
  });
}

QString FileActions::folder() const {
  return settings_.value(QStringLiteral("files/folder")).toString();
}

void FileActions::choose_mesh() {
  const QString path = QFileDialog::getOpenFileName(window_, tr("Open a mesh"), folder());
  if (path.isEmpty()) return;
  tools::PictureCommand command;
  command.input = path.toStdString();
  open(command);
}

void FileActions::choose_view() {
  const QString path = QFileDialog::getOpenFileName(
      window_, tr("Open a specification"), folder(),
      tr("Specifications, and what holds one (*.toml *.pvsm *.png *.exr *.tiff);;All files (*)"));
  if (!path.isEmpty()) open_view(path);
}

bool FileActions::choose_save() {
  QString path = QFileDialog::getSaveFileName(window_, tr("Save the specification"), folder(),
                                              tr("Specifications (*.toml)"));
  if (path.isEmpty()) return false;
  if (QFileInfo(path).suffix().isEmpty()) path += QStringLiteral(".toml");
  return save_to(path);
}

void FileActions::choose_export(std::shared_ptr<const Painted> picture) {
  QStringList patterns;
  for (const QString& extension :
       QString::fromStdString(image_extensions()).split(QLatin1Char(' '), Qt::SkipEmptyParts))
    patterns << QStringLiteral("*") + extension;
  const QString path =
      QFileDialog::getSaveFileName(window_, tr("Export the picture"), folder(),
                                   tr("Pictures (%1)").arg(patterns.join(QLatin1Char(' '))));
  if (!path.isEmpty()) export_picture(path, std::move(picture));
}

void FileActions::remember(const QString& path) {
  if (path.isEmpty() || path == QStringLiteral("-")) return;
  const QFileInfo file(path);
  const QString name = QString::fromStdString(
      std::filesystem::absolute(path.toStdString()).lexically_normal().string());
  QStringList files = settings_.value(QStringLiteral("files/recent")).toStringList();
  files.removeAll(name);
  files.prepend(name);
  while (files.size() > kRecentFiles) files.removeLast();
  settings_.setValue(QStringLiteral("files/recent"), files);
  settings_.setValue(QStringLiteral("files/folder"), file.absolutePath());
}

void FileActions::fill_recent_menu() {
  recent_.clear();
  const QStringList files = settings_.value(QStringLiteral("files/recent")).toStringList();
  for (const QString& file : files) {
    // an ampersand in a name is no mark of a key
    QString label = file;
    connect(recent_.addAction(label.replace(QLatin1Char('&'), QStringLiteral("&&"))),
            &QAction::triggered, this, [this, file] { open_file(file); });
  }
  recent_.setEnabled(!files.isEmpty());
}

}  // namespace hiac::view

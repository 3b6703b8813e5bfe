#include "tools/view/window/main_window.hpp"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QCloseEvent>
#include <QDockWidget>
#include <QMessageBox>
#include <QMimeData>
#include <QStatusBar>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "hiac/geometry/vector.hpp"
#include "hiac/render/explain_pixel.hpp"
#include "hiac/scene/camera_motion.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/scene/toml/spec_text.hpp"
#include "tools/view/document/camera_text.hpp"
#include "tools/view/transfer/bump.hpp"
#include "tools/view/transfer/spec_pane.hpp"
#include "tools/view/window/picture_facts.hpp"
#include "tools/view/window/shell_command.hpp"

namespace hiac::view {
namespace {

constexpr int kLayoutVersion = 1;
constexpr QSize kUsualSize(1240, 800);
constexpr int kUsualDockWidth = 420;

double distance_of_centre(const Camera& camera) { return length(view_direction(camera)); }

// The segment that adds most to the pixel; null if nothing is seen.
const PixelSegment* seen_segment(const PixelExplanation& pixel) {
  const PixelSegment* seen = nullptr;
  double most = 0, before = 1;
  for (const PixelSegment& segment : pixel.segments) {
    const double opacity = before - segment.transparency;
    before = segment.transparency;
    if (opacity <= most) continue;
    most = opacity;
    seen = &segment;
  }
  return seen;
}

}  // namespace

MainWindow::MainWindow(tools::Tool& tool, QSettings& settings, QStringList faults, QWidget* parent)
    : QMainWindow(parent),
      settings_(settings),
      bindings_(settings, faults),
      files_(document_, tool, settings, this),
      view_(document_),
      drawing_(std::make_unique<Drawing>()) {
  view_.set_hardware(settings_.value(QStringLiteral("view/hardware_preview")).toBool());
  setAcceptDrops(true);
  setCentralWidget(make_centre());
  make_docks();
  make_menus();
  facts_ = new QLabel;
  facts_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // the window may be narrow
  hovered_ = new QLabel;
  statusBar()->addWidget(facts_, 1);
  statusBar()->addPermanentWidget(hovered_);
  connect_drawing();
  connect_viewport();
  connect(&document_, &Document::changed, this, &MainWindow::show_document);
  connect(&document_, &Document::file_changed, this, &MainWindow::show_file_name);
  connect(&document_.undo_stack(), &QUndoStack::cleanChanged, this, &MainWindow::show_file_name);
  connect(&view_, &ViewActions::changed, this, &MainWindow::show_document);
  connect(&document_, &Document::message, messages_, &MessageLine::tell);
  connect(&view_, &ViewActions::message, messages_, &MessageLine::tell);
  connect(&files_, &FileActions::message, messages_, &MessageLine::tell);
  connect(&files_, &FileActions::opened, messages_, &MessageLine::dismiss);
  resize(kUsualSize);
  restoreGeometry(settings_.value(QStringLiteral("window/geometry")).toByteArray());
  restoreState(settings_.value(QStringLiteral("window/state")).toByteArray(), kLayoutVersion);
  for (const QString& fault : faults) messages_->tell(fault);
  show_document();
}

MainWindow::~MainWindow() {
  drawing_.reset();  // ends before what it reports to
}

QWidget* MainWindow::make_centre() {
  auto* centre = new QWidget;
  messages_ = new MessageLine;
  viewport_ = new Viewport(bindings_);
  auto* layout = new QVBoxLayout(centre);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(messages_);
  layout->addWidget(viewport_, 1);
  return centre;
}

QDockWidget* MainWindow::add_dock(const QString& name, const QString& title, QWidget* content) {
  auto* dock = new QDockWidget(title, this);
  dock->setObjectName(name);
  dock->setWidget(content);
  addDockWidget(Qt::RightDockWidgetArea, dock);
  return dock;
}

void MainWindow::make_docks() {
  pixel_panel_ = new PixelPanel;
  clip_panel_ = new ClipPanel;
  path_panel_ = new PathPanel;
  transfer_panel_ = new TransferPanel(document_);
  QDockWidget* transfer =
      add_dock(QStringLiteral("transfer"), tr("Transfer functions"), transfer_panel_);
  tabifyDockWidget(transfer, add_dock(QStringLiteral("text"), tr("Text"), new SpecPane(document_)));
  tabifyDockWidget(transfer, add_dock(QStringLiteral("pixel"), tr("Pixel"), pixel_panel_));
  transfer->raise();
  QDockWidget* clip = add_dock(QStringLiteral("clip"), tr("Clip"), clip_panel_);
  QDockWidget* path = add_dock(QStringLiteral("path"), tr("Camera path"), path_panel_);
  tabifyDockWidget(clip, path);
  resizeDocks({clip}, {kUsualDockWidth}, Qt::Horizontal);
  clip->raise();
  connect(clip_panel_, &ClipPanel::clip_changed, &view_, &ViewActions::set_clip);
  connect(path_panel_, &PathPanel::frame_chosen, &view_, &ViewActions::set_frame);
  connect(path_panel_, &PathPanel::record_wanted, &view_, &ViewActions::record_keyframe);
}

void MainWindow::connect_drawing() {
  connect(drawing_.get(), &Drawing::painted, this,
          [this](const std::shared_ptr<const Painted>& picture) {
            if (!view_.wanted()) return;
            picture_ = picture;
            error_.reset();
            viewport_->show_picture(picture);
            show_facts();
            path_panel_->picture_drawn();
          });
  connect(drawing_.get(), &Drawing::bounded, this,
          [this](quint64 number, const std::optional<double>& error) {
            if (number != shown_number_) return;
            error_ = error;
            show_facts();
          });
  connect(drawing_.get(), &Drawing::rested, this, [this](quint64 number) {
    if (number != shown_number_) return;
    if (pixel_is_stale_ && pixel_)
      explain(*pixel_);  // rests again afterwards
    else
      is_at_rest_ = true;
  });
  connect(drawing_.get(), &Drawing::explained, this, &MainWindow::take_explanation);
  connect(drawing_.get(), &Drawing::failed, this, [this](const QString& line, bool of_picture) {
    messages_->tell(line);
    if (!of_picture) return;
    picture_.reset();
    viewport_->show_text(line);
    show_facts();
  });
}

void MainWindow::connect_viewport() {
  connect(viewport_, &Viewport::camera_moved, &view_, &ViewActions::move_camera);
  connect(viewport_, &Viewport::hovered, this, &MainWindow::tell_hovered);
  connect(viewport_, &Viewport::pixel_chosen, this, &MainWindow::explain);
  connect(viewport_, &Viewport::centre_chosen, this, &MainWindow::centre_on);
  connect(viewport_, &Viewport::bump_chosen, this, &MainWindow::add_bump_at);
  connect(&files_, &FileActions::progress, this, [this](const QString& text) {
    if (!text.isEmpty() && !picture_) viewport_->show_text(text);
    statusBar()->showMessage(text);
  });
}

void MainWindow::show_document() {
  const std::optional<Wanted> wanted = view_.wanted();
  is_at_rest_ = false;
  keep_pixel(wanted);
  const auto camera = view_.camera();
  viewport_->set_camera(camera);
  clip_panel_->show_camera(camera, view_.depths());
  if (document_.has_scene()) {
    const Scene& scene = document_.scene();
    path_panel_->show_path(frame_count(scene), view_.frame(),
                           !scene.path || std::holds_alternative<KeyframePath>(*scene.path));
  }
  show_file_name();
  if (wanted) {
    shown_number_ = drawing_->show(*wanted);
    return;
  }
  drawing_->clear();
  picture_.reset();
  viewport_->show_text(
      document_.mesh()
          ? tr("Open a specification (%1)")
                .arg(bindings_.key(QStringLiteral("open_view")).toString(QKeySequence::NativeText))
          : tr("Open a mesh (%1), or drop a file here")
                .arg(
                    bindings_.key(QStringLiteral("open_mesh")).toString(QKeySequence::NativeText)));
  show_facts();
}

// The pixel that is explained stays so, as long as the picture has it: what is told of it is of the
// picture before until the new one is complete.
void MainWindow::keep_pixel(const std::optional<Wanted>& wanted) {
  centres_next_ = false;
  bumps_next_ = false;
  if (pixel_ && wanted && wanted->scene.render.splat_below <= 0 && picture_ &&
      picture_->wanted->mesh == wanted->mesh &&
      QRect(0, 0, static_cast<int>(wanted->scene.image.width),
            static_cast<int>(wanted->scene.image.height))
          .contains(*pixel_)) {
    pixel_is_stale_ = true;
    pixel_panel_->setEnabled(false);
    return;
  }
  pixel_.reset();
  pixel_is_stale_ = false;
  viewport_->mark(std::nullopt);
  pixel_panel_->setEnabled(true);
  pixel_panel_->show_pixel(nullptr, nullptr);
}

void MainWindow::show_file_name() {
  const auto name = [](const std::string& path) {
    return QString::fromStdString(path).section(QLatin1Char('/'), -1);
  };
  QStringList parts;
  if (!document_.mesh_file().empty()) parts << name(document_.mesh_file());
  if (document_.has_scene())
    parts << (document_.file().empty() ? tr("unsaved view")
                                       : name(document_.file()) + QStringLiteral("[*]"));
  parts << QStringLiteral("hiac-view");
  setWindowTitle(parts.join(QStringLiteral(" \u2013 ")));
  setWindowModified(!document_.undo_stack().isClean() && !document_.file().empty());
}

void MainWindow::show_facts() {
  transfer_panel_->show_depth(picture_ ? std::optional(picture_->mean_optical_depth)
                                       : std::nullopt);
  facts_->setText(picture_ ? picture_facts(*picture_, error_, viewport_->scale()) : QString());
  facts_->setToolTip(facts_->text());
}

void MainWindow::tell_hovered(std::optional<QPoint> pixel) {
  hovered_->setText(pixel ? tr("pixel %1,%2").arg(pixel->x()).arg(pixel->y()) : QString());
}

void MainWindow::explain(QPoint pixel) {
  pixel_ = pixel;
  pixel_is_stale_ = false;
  centres_next_ = false;
  bumps_next_ = false;
  viewport_->mark(pixel);
  is_at_rest_ = false;
  drawing_->explain(static_cast<std::uint32_t>(pixel.x()), static_cast<std::uint32_t>(pixel.y()));
}

void MainWindow::add_bump_at(QPoint pixel) {
  explain(pixel);
  bumps_next_ = true;
}

// Where splats are drawn no pixel is explained, and the centre's own depth serves.
void MainWindow::centre_on(QPoint pixel) {
  const std::optional<Wanted> wanted = view_.wanted();
  if (!wanted) return;
  const Scene& scene = wanted->scene;
  if (scene.render.splat_below > 0) {
    centre_at(scene, pixel, distance_of_centre(scene.camera));
    return;
  }
  explain(pixel);
  centres_next_ = true;
}

void MainWindow::centre_at(const Scene& scene, QPoint pixel, double depth) {
  const auto point = point_at(scene.camera, scene.image, pixel.x() + 0.5, pixel.y() + 0.5, depth);
  view_.move_camera(centred(scene.camera, point), tr("centre"), false);
}

void MainWindow::take_explanation(const std::shared_ptr<const ExplainedPixel>& pixel) {
  const PixelExplanation& found = *pixel->explanation.pixel;
  const QPoint place(static_cast<int>(found.x), static_cast<int>(found.y));
  if (!pixel_ || *pixel_ != place) return;
  const PixelSegment* seen = seen_segment(found);
  if (std::exchange(bumps_next_, false)) {
    const bool absorbs = pixel->scene.volume.extinction.has_value();
    const auto value = [&](const SegmentEnd& end) {
      return absorbs ? end.extinction_field : end.color_field;
    };
    if (seen != nullptr)
      add_bump(document_, std::midpoint(value(seen->front), value(seen->back)));
    else
      messages_->tell(tr("Nothing is seen at this pixel: no value to add a bump at"));
    return;
  }
  if (!std::exchange(centres_next_, false)) {
    pixel_panel_->setEnabled(true);
    pixel_panel_->show_pixel(pixel, document_.mesh());
    return;
  }
  pixel_.reset();
  // where nothing is seen, the plane through look_at
  centre_at(pixel->scene, place,
            seen != nullptr ? std::midpoint(seen->front.depth, seen->back.depth)
                            : distance_of_centre(pixel->scene.camera));
}

void MainWindow::copy_command() {
  if (document_.file().empty() || !document_.undo_stack().isClean()) {
    messages_->tell(tr("Save the specification first: the command names its file"));
    return;
  }
  if (files_.command().input.empty()) return;
  const bool has_path = document_.scene().path.has_value();
  const std::string line = shell_command(files_.command(), document_.file(),
                                         has_path ? std::optional(view_.frame()) : std::nullopt,
                                         view_.samples(), picture_ && picture_->left_out > 0);
  QApplication::clipboard()->setText(QString::fromStdString(line));
  messages_->tell(tr("Copied: %1").arg(QString::fromStdString(line)));
}

void MainWindow::fit_picture_to_window() {
  const double screen = viewport_->devicePixelRatioF();
  const auto side = [&](int length) {
    return static_cast<std::uint32_t>(std::max(1.0, std::floor(length * screen)));
  };
  view_.set_size({side(viewport_->width()), side(viewport_->height())});
}

bool MainWindow::may_lose_changes() {
  if (document_.undo_stack().isClean() || !document_.has_scene()) return true;
  const auto answer = QMessageBox::question(
      this, tr("Unsaved changes"), tr("Save the specification before closing?"),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel);
  if (answer == QMessageBox::Save) return files_.save();
  return answer == QMessageBox::Discard;
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!may_lose_changes()) {
    event->ignore();
    return;
  }
  settings_.setValue(QStringLiteral("window/geometry"), saveGeometry());
  settings_.setValue(QStringLiteral("window/state"), saveState(kLayoutVersion));
  event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) files_.open_file(url.toLocalFile());
}

}  // namespace hiac::view

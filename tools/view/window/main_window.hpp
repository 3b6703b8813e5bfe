#pragma once

#include <QLabel>
#include <QMainWindow>
#include <QSettings>
#include <QString>
#include <QStringList>
#include <functional>
#include <memory>
#include <optional>

#include "tools/common/tool.hpp"
#include "tools/view/document/document.hpp"
#include "tools/view/pixel/pixel_panel.hpp"
#include "tools/view/transfer/transfer_panel.hpp"
#include "tools/view/viewport/bindings.hpp"
#include "tools/view/viewport/drawing.hpp"
#include "tools/view/viewport/viewport.hpp"
#include "tools/view/window/clip_panel.hpp"
#include "tools/view/window/file_actions.hpp"
#include "tools/view/window/message_line.hpp"
#include "tools/view/window/path_panel.hpp"
#include "tools/view/window/view_actions.hpp"

class QDockWidget;
class QMenu;

namespace hiac::view {

/// The window: the picture in the middle, docks on its right, menus and a status line.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  /// Both must outlive the window. The settings keep places, recent files, and the table of mouse
  /// and keys.
  MainWindow(tools::Tool& tool, QSettings& settings, QWidget* parent = nullptr)
      : MainWindow(tool, settings, {}, parent) {}
  ~MainWindow() override;

  [[nodiscard]] Document& document() { return document_; }
  [[nodiscard]] FileActions& files() { return files_; }
  [[nodiscard]] ViewActions& view() { return view_; }
  [[nodiscard]] Viewport& viewport() { return *viewport_; }
  [[nodiscard]] Drawing& drawing() { return *drawing_; }
  [[nodiscard]] PixelPanel& pixel_panel() { return *pixel_panel_; }
  [[nodiscard]] TransferPanel& transfer_panel() { return *transfer_panel_; }
  [[nodiscard]] MessageLine& messages() { return *messages_; }
  /// The last picture; null if there is none.
  [[nodiscard]] const std::shared_ptr<const Painted>& picture() const { return picture_; }
  /// Whether the picture is complete, and nothing more will be drawn.
  [[nodiscard]] bool is_at_rest() const { return is_at_rest_; }

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  // `faults`: what is wrong in the settings, which its bindings add to
  MainWindow(tools::Tool& tool, QSettings& settings, QStringList faults, QWidget* parent);

  QWidget* make_centre();
  /// A dock on the right. `name` identifies it in the settings.
  QDockWidget* add_dock(const QString& name, const QString& title, QWidget* content);
  void make_docks();
  void make_menus();
  void make_file_menu();
  void make_view_menu();
  QAction* add_action(QMenu* menu, const QString& text, const QString& name, const QString& tip,
                      const std::function<void()>& action);
  void connect_drawing();
  void connect_viewport();
  void show_document();  // draws what the document says
  void show_file_name();
  void show_facts();
  void tell_hovered(std::optional<QPoint> pixel);
  void explain(QPoint pixel);
  void keep_pixel(const std::optional<Wanted>& wanted);
  void add_bump_at(QPoint pixel);
  void centre_on(QPoint pixel);
  void centre_at(const Scene& scene, QPoint pixel, double depth);
  void take_explanation(const std::shared_ptr<const ExplainedPixel>& pixel);
  void copy_command();
  void show_help();
  void fit_picture_to_window();
  [[nodiscard]] bool may_lose_changes();

  QSettings& settings_;
  Document document_;
  Bindings bindings_;
  FileActions files_;
  ViewActions view_;
  std::unique_ptr<Drawing> drawing_;
  std::shared_ptr<const Painted> picture_;
  std::optional<std::optional<double>> error_;  // of the picture, once it was looked for
  std::uint64_t shown_number_ = 0;              // of what is drawn (Drawing::show)
  bool is_at_rest_ = false;
  std::optional<QPoint> pixel_;  // that is explained
  bool pixel_is_stale_ = false;  // the explanation is of the picture before
  bool centres_next_ = false;    // the next explanation is for centre_on
  bool bumps_next_ = false;      // the next explanation is for a bump of the extinction

  MessageLine* messages_ = nullptr;
  Viewport* viewport_ = nullptr;
  PixelPanel* pixel_panel_ = nullptr;
  ClipPanel* clip_panel_ = nullptr;
  TransferPanel* transfer_panel_ = nullptr;
  PathPanel* path_panel_ = nullptr;
  QLabel *facts_ = nullptr, *hovered_ = nullptr, *help_ = nullptr;
};

}  // namespace hiac::view

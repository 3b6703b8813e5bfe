#pragma once

#include <QObject>
#include <QString>
#include <array>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "hiac/base/progress.hpp"
#include "hiac/session/session.hpp"
#include "tools/view/viewport/painter.hpp"
#include "tools/view/viewport/step_choice.hpp"

namespace hiac::view {

/// A pixel's explanation, and the scene that it is of.
struct ExplainedPixel {
  Explanation explanation;
  Scene scene;
};

/// Draws on a thread of its own, and refines in place: first as many pixels as a twentieth of a
/// second allows (StepChoice), then, while nothing changes, all pixels, then the picture of several
/// rays a pixel if that is wanted, and at last the bound of the error. Where graphics hardware is
/// wanted, its picture comes first, and then all pixels.
///
/// What is wanted anew stops whatever runs, except the first picture of a change: that one is
/// short, and so a hand that moves on does not keep every picture from being finished.
class Drawing : public QObject {
  Q_OBJECT

 public:
  explicit Drawing(QObject* parent = nullptr);
  ~Drawing() override;

  /// Shows this from now on. Returns its number, which signals about it have.
  std::uint64_t show(Wanted wanted);
  /// Shows nothing from now on.
  void clear();
  /// Explains a pixel of what is shown, before the picture is refined further.
  void explain(std::uint32_t x, std::uint32_t y);

  /// The seconds from the last call of `show` until the refinement that it stopped had ended;
  /// negative if it stopped none, or as long as that runs.
  [[nodiscard]] double last_stop_seconds() const;

 Q_SIGNALS:
  // from the thread that draws
  void painted(std::shared_ptr<const hiac::view::Painted> picture);
  /// The largest error of the picture; none: no bound is claimed.
  void bounded(quint64 number, std::optional<double> error);
  void explained(std::shared_ptr<const hiac::view::ExplainedPixel> pixel);
  void failed(QString line, bool of_picture);  ///< `of_picture`: there is none of what is wanted
  void rested(quint64 number);                 ///< nothing is left to do

 private:
  enum class Stage : std::uint8_t { first, middle, all, samples, bound, done };
  static constexpr std::uint32_t kNoStep = 0;  // of a picture by graphics hardware

  void run();
  void work(std::unique_lock<std::mutex>& lock);
  void paint(const std::shared_ptr<const Wanted>& wanted, Stage stage, std::uint64_t number);
  Painted paint_first(const Wanted& wanted);
  std::optional<Painted> paint_by_hardware(const Wanted& wanted);
  void explain_pixel_of(const Wanted& wanted, const std::array<std::uint32_t, 2>& pixel);
  [[nodiscard]] Stage after(Stage stage, const Wanted& wanted) const;
  void stop_refinement();

  mutable std::mutex mutex_;  // guards all down to `stop_seconds_`
  std::condition_variable wake_;
  std::shared_ptr<const Wanted> wanted_;
  std::uint64_t number_ = 0;  // of wanted_
  std::optional<std::array<std::uint32_t, 2>> pixel_;
  Stage stage_ = Stage::done;
  bool is_refining_ = false;  // may be stopped
  bool ends_ = false;
  double stopped_at_ = 0, stop_seconds_ = -1;

  Cancellation cancellation_;
  Painter painter_;  // of the thread alone
  StepChoice steps_;
  std::shared_ptr<const ZooMesh> timed_mesh_;  // whose first picture was drawn
  std::uint32_t shown_step_ = 0;
  bool hardware_failed_ = false;  // since it was last wanted anew
  std::thread thread_;
};

}  // namespace hiac::view

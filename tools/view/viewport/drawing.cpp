#include "tools/view/viewport/drawing.hpp"

#include <chrono>
#include <exception>
#include <utility>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/scene/toml/spec_text.hpp"
#include "tools/view/viewport/hardware_preview.hpp"

namespace hiac::view {

Drawing::Drawing(QObject* parent)
    : QObject(parent), painter_(cancellation_), thread_([this] { run(); }) {}

Drawing::~Drawing() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    cancellation_.request();
  }
  wake_.notify_one();
  thread_.join();
}

// The mutex is locked.
void Drawing::stop_refinement() {
  if (!is_refining_) return;
  if (!cancellation_.requested()) stopped_at_ = seconds_now();
  cancellation_.request();
}

std::uint64_t Drawing::show(Wanted wanted) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    stop_seconds_ = -1;
    const bool is_other_mesh = !wanted_ || wanted_->mesh != wanted.mesh;
    wanted_ = std::make_shared<const Wanted>(std::move(wanted));
    number = ++number_;
    stage_ = Stage::first;
    pixel_.reset();
    if (is_other_mesh)
      cancellation_.request();  // no picture of the mesh before is of use any more
    else
      stop_refinement();
  }
  wake_.notify_one();
  return number;
}

void Drawing::clear() {
  const std::lock_guard lock(mutex_);
  wanted_.reset();
  pixel_.reset();
  stage_ = Stage::done;
  cancellation_.request();
}

void Drawing::explain(std::uint32_t x, std::uint32_t y) {
  {
    const std::lock_guard lock(mutex_);
    if (!wanted_) return;
    pixel_ = {x, y};
    stop_refinement();
  }
  wake_.notify_one();
}

double Drawing::last_stop_seconds() const {
  const std::lock_guard lock(mutex_);
  return stop_seconds_;
}

void Drawing::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return ends_ || pixel_ || (wanted_ && stage_ != Stage::done); });
    if (ends_) break;
    work(lock);
  }
  painter_.leave_hardware();
}

// One explanation, or one stage. The mutex is locked, except while the work is done.
void Drawing::work(std::unique_lock<std::mutex>& lock) {
  const auto pixel = std::exchange(pixel_, std::nullopt);
  const std::shared_ptr<const Wanted> wanted = wanted_;
  const Stage stage = stage_;
  const std::uint64_t number = number_;
  is_refining_ = pixel.has_value() || stage != Stage::first;
  // what was asked for while nothing could be stopped is not asked for any more
  cancellation_.reset();
  lock.unlock();
  QString fault;
  bool cancelled = false;
  try {
    const CancellationScope scope(&cancellation_);
    if (pixel)
      explain_pixel_of(*wanted, *pixel);
    else
      paint(wanted, stage, number);
  } catch (const Cancelled&) {
    cancelled = true;
  } catch (const std::bad_alloc&) {
    fault = tr("out of memory");
  } catch (const std::exception& error) {
    fault = QString::fromStdString(in_one_line(error.what()));
  }
  lock.lock();
  is_refining_ = false;
  if (cancelled && stopped_at_ > 0) stop_seconds_ = seconds_now() - std::exchange(stopped_at_, 0);
  const bool is_current = number == number_ && wanted_ != nullptr;
  if (!fault.isEmpty() && (pixel || is_current)) {
    Q_EMIT failed(fault, !pixel);
    if (!pixel) stage_ = Stage::done;
  } else if (!pixel && !cancelled && is_current) {
    stage_ = after(stage, *wanted);
  }
  if (!pixel_ && wanted_ && stage_ == Stage::done && !ends_) Q_EMIT rested(number_);
}

Drawing::Stage Drawing::after(Stage stage, const Wanted& wanted) const {
  switch (stage) {
    case Stage::first:
      if (shown_step_ == kNoStep) return Stage::all;
      return shown_step_ == 1 ? after(Stage::all, wanted) : Stage::middle;
    case Stage::middle:
      return Stage::all;
    case Stage::all:
      return wanted.samples > 1 ? Stage::samples : Stage::bound;
    case Stage::samples:
      return Stage::bound;
    case Stage::bound:
    case Stage::done:
      break;
  }
  return Stage::done;
}

void Drawing::paint(const std::shared_ptr<const Wanted>& what, Stage stage, std::uint64_t number) {
  const Wanted& wanted = *what;
  const auto publish = [&](Painted painted) {
    shown_step_ = painted.device.empty() ? painted.step : kNoStep;
    painted.wanted = what;
    Q_EMIT this->painted(std::make_shared<const Painted>(std::move(painted)));
  };
  switch (stage) {
    case Stage::first:
      publish(paint_first(wanted));
      break;
    case Stage::middle:
      // a ninth of all pixels comes in between where clearly fewer are shown
      if (shown_step_ > 4) publish(painter_.paint(wanted, 3));
      break;
    case Stage::all:
      publish(painter_.paint(wanted, 1));
      break;
    case Stage::samples:
      publish(painter_.paint_samples(wanted));
      break;
    case Stage::bound:
      Q_EMIT bounded(number, painter_.error_bound(wanted));
      break;
    case Stage::done:
      break;
  }
}

Painted Drawing::paint_first(const Wanted& wanted) {
  if (auto painted = paint_by_hardware(wanted)) return std::move(*painted);
  const std::uint32_t step = steps_.step(wanted.scene.image);
  Painted painted = painter_.paint(wanted, step);
  // the first picture of a mesh takes what all others of it are spared
  if (wanted.mesh == timed_mesh_) steps_.took(painted.seconds);
  timed_mesh_ = wanted.mesh;
  return painted;
}

// None where it is not wanted, or cannot draw the scene, or failed, which is told once.
std::optional<Painted> Drawing::paint_by_hardware(const Wanted& wanted) {
  if (!wanted.hardware) {
    painter_.leave_hardware();
    hardware_failed_ = false;
    return std::nullopt;
  }
  if (hardware_failed_ || !HardwarePreview::draws(wanted.scene)) return std::nullopt;
  try {
    return painter_.paint_by_hardware(wanted);
  } catch (const Error& error) {
    if (error.exit_code() != ExitCode::internal) throw;  // the scene's fault
    hardware_failed_ = true;
    Q_EMIT failed(
        tr("No hardware preview: %1").arg(QString::fromStdString(in_one_line(error.what()))),
        false);
    return std::nullopt;
  }
}

void Drawing::explain_pixel_of(const Wanted& wanted, const std::array<std::uint32_t, 2>& pixel) {
  ExplainedPixel explained{painter_.explain(wanted, pixel[0], pixel[1]), wanted.scene};
  Q_EMIT this->explained(std::make_shared<const ExplainedPixel>(std::move(explained)));
}

}  // namespace hiac::view

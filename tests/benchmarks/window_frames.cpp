// How the window feels: pictures a second while a mesh is turned, the time to the whole picture
// once it rests, and the time until a change stops what runs.
//   window_frames MESH.zoo [WIDTH HEIGHT [VIEW.toml]]

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QThread>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "hiac/base/parallel.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/scene/camera_motion.hpp"
#include "hiac/session/session.hpp"
#include "tools/view/viewport/drawing.hpp"

namespace {

using namespace hiac;
using namespace hiac::view;

// Reports of a drawing, received in this thread.
struct Reports {
  explicit Reports(Drawing& drawing) {
    QObject::connect(&drawing, &Drawing::painted, &here,
                     [this](const std::shared_ptr<const Painted>& picture) {
                       last = picture;
                       ++pictures;
                     });
    QObject::connect(&drawing, &Drawing::failed, &here, [](const QString& line, bool) {
      std::fprintf(stderr, "window_frames: %s\n", line.toUtf8().constData());
      std::exit(1);
    });
    QObject::connect(&drawing, &Drawing::rested, &here, [this](quint64 n) { rested = n; });
  }
  template <typename Done>
  void wait(const Done& done) const {
    while (!done()) {
      QCoreApplication::processEvents();
      QThread::usleep(200);
    }
  }

  QObject here;
  std::shared_ptr<const Painted> last;
  std::uint64_t pictures = 0, rested = 0;
};

// Processor seconds of all threads so far.
double processor_seconds() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Pictures at one step, drawn one after the other as the camera turns.
void draw_at(const Wanted& start, std::uint32_t step) {
  const Cancellation never;
  Painter painter(never);
  Wanted wanted = start;
  painter.paint(wanted, step);
  constexpr int kPictures = 30;
  const double begin = seconds_now(), processor = processor_seconds();
  for (int k = 0; k < kPictures; ++k) {
    wanted.scene.camera = orbited(wanted.scene.camera, 2, 0.5);
    painter.paint(wanted, step);
  }
  std::printf(
      "every %u. pixel of every %u. row: %.1f pictures a second, %.1f ms of processors each\n",
      step, step, kPictures / (seconds_now() - begin),
      1000 * (processor_seconds() - processor) / kPictures);
}

// Turns for some seconds, with a hundred movements of the mouse a second, as a hand makes them.
void turn(Drawing& drawing, Reports& reports, Wanted& wanted) {
  constexpr double kSeconds = 5, kMovements = 100;
  const std::uint64_t before = reports.pictures;
  const double begin = seconds_now();
  double next = begin;
  std::uint64_t number = 0;
  while (seconds_now() < begin + kSeconds) {
    reports.wait([&] { return seconds_now() >= next; });
    next += 1 / kMovements;
    wanted.scene.camera = orbited(wanted.scene.camera, 0.5, 0.2);
    number = drawing.show(wanted);
  }
  const double rate = static_cast<double>(reports.pictures - before) / (seconds_now() - begin);
  const std::uint32_t step = reports.last->step;
  const double rest = seconds_now();
  reports.wait(
      [&] { return reports.last->step == 1 && reports.last->wanted->scene == wanted.scene; });
  std::printf("turning: %.1f pictures a second, of %u x %u pixels\n", rate,
              (wanted.scene.image.width + step - 1) / step,
              (wanted.scene.image.height + step - 1) / step);
  std::printf("whole picture %.2f s after the mouse rests\n", seconds_now() - rest);
  reports.wait([&] { return reports.rested == number; });
}

void stop(Drawing& drawing, Reports& reports, Wanted& wanted) {
  constexpr int kStops = 200;
  std::vector<double> waits;
  for (int k = 0; static_cast<int>(waits.size()) < kStops && k < 10 * kStops; ++k) {
    wanted.scene.camera = orbited(wanted.scene.camera, 2, 0.5);
    std::uint64_t before = reports.pictures;
    drawing.show(wanted);
    reports.wait([&] { return reports.pictures > before; });
    QThread::msleep(static_cast<unsigned long>(7 * k % 60));  // into the refinement
    before = reports.pictures;
    drawing.show(wanted);
    reports.wait([&] { return reports.pictures > before; });
    if (drawing.last_stop_seconds() >= 0) waits.push_back(drawing.last_stop_seconds());
  }
  std::ranges::sort(waits);
  if (waits.empty()) return;
  std::printf("stopped within %.1f ms (95th percentile of %zu; the longest %.1f ms)\n",
              1000 * waits[waits.size() * 95 / 100], waits.size(), 1000 * waits.back());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "window_frames MESH.zoo [WIDTH HEIGHT [VIEW.toml]]\n");
    return 2;
  }
  const QCoreApplication application(argc, argv);
  auto mesh = std::make_shared<const ZooMesh>(read_zoo_file(argv[1]).mesh);
  Scene scene =
      argc > 4 ? with_field_ranges(read_scene(argv[4]), *mesh).scene : starter_view(*mesh);
  scene.image = {800, 600};
  if (argc > 3)
    scene.image = {static_cast<std::uint32_t>(std::atoi(argv[2])),
                   static_cast<std::uint32_t>(std::atoi(argv[3]))};
  std::printf("%zu cells, %u x %u pixels, %u threads\n", mesh->cell_count(), scene.image.width,
              scene.image.height, thread_count());
  Wanted wanted{mesh, scene, {}, 1};
  for (const std::uint32_t step : {1U, 2U, 4U}) draw_at(wanted, step);
  Drawing drawing;
  Reports reports(drawing);
  const std::uint64_t number = drawing.show(wanted);
  reports.wait([&] { return reports.rested == number; });
  turn(drawing, reports, wanted);
  stop(drawing, reports, wanted);
}

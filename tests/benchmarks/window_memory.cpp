// The memory that the window takes beside that of hiac-render, for the same picture.
//   window_memory MESH VIEW.toml
#include <QApplication>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/view/open_window.hpp"

namespace {

using namespace hiac;
using namespace hiac::view;

constexpr double kMegabyte = 1e6;  // bytes

// The largest resident memory of hiac-render, megabytes; negative if it fails. To be called while
// this process is small: a child's largest includes what its parent has as it is started.
double memory_of_render(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {HIAC_RENDER, "-q"});
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawn(&child, HIAC_RENDER, nullptr, nullptr, pointers.data(), environ) != 0) return -1;
  int status = 0;
  struct rusage usage {};
  if (wait4(child, &status, 0, &usage) < 0 || status != 0) return -1;
  return static_cast<double>(usage.ru_maxrss) * 1024 / kMegabyte;
}

// A line of /proc/self/status, megabytes.
double memory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":"))
      return std::stod(line.substr(name.size() + 1)) * 1024 / kMegabyte;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "window_memory MESH VIEW.toml\n");
    return 2;
  }
  const std::string mesh = argv[1], view = argv[2];
  const hiac::test::ScratchFolder folder;
  const std::vector<std::string> picture{mesh, "--view", view, "-o", folder.file("picture.exr")};
  std::vector<std::string> bounded = picture;
  bounded.insert(bounded.end(), {"--channels", "error"});
  const double render = memory_of_render(picture), with_error = memory_of_render(bounded);
  if (render < 0 || with_error < 0) {
    std::fprintf(stderr, "window_memory: hiac-render failed\n");
    return 1;
  }
  int count = 1;
  const QApplication application(count, argv);
  view::test::OpenWindow window;
  QCoreApplication::processEvents();
  const double empty = memory("VmRSS");
  if (!window.open(mesh, view)) {
    std::fprintf(stderr, "window_memory: there is no picture\n");
    return 1;
  }
  const ImageSize size = window->picture()->wanted->scene.image;
  std::printf("%u x %u pixels; hiac-render %.1f MB, with the channel error %.1f MB\n", size.width,
              size.height, render, with_error);
  std::printf("window %.1f MB empty, %.1f MB at rest, %.1f MB at most\n", empty, memory("VmRSS"),
              memory("VmHWM"));
}

// Prints how fast text files of two million tetrahedra are read. Usage: format_table FOLDER
// [CUBES]; the files stay in the folder, to be read by others for comparison.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "formats/registry.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/base/seconds.hpp"

namespace hiac {
namespace {

/// A cube of n^3 little cubes, six tetrahedra each.
struct Grid {
  std::size_t n;
  [[nodiscard]] std::size_t nodes() const { return (n + 1) * (n + 1) * (n + 1); }
  [[nodiscard]] std::size_t cells() const { return 6 * n * n * n; }

  void each_node(const std::function<void(double, double, double)>& visit) const {
    const double h = 1.0 / static_cast<double>(n);
    for (std::size_t k = 0; k <= n; ++k)
      for (std::size_t j = 0; j <= n; ++j)
        for (std::size_t i = 0; i <= n; ++i)
          visit(h * static_cast<double>(i), h * static_cast<double>(j), h * static_cast<double>(k));
  }
  /// Nodes are numbered from 1.
  void each_cell(
      const std::function<void(std::size_t, std::size_t, std::size_t, std::size_t)>& visit) const {
    static constexpr std::size_t kCut[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                               {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    const std::size_t row = n + 1;
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
          const std::size_t c = 1 + i + row * (j + row * k);
          const std::size_t up = row * row;
          const std::size_t corners[8] = {c,      c + 1,      c + row + 1,      c + row,
                                          c + up, c + up + 1, c + up + row + 1, c + up + row};
          for (const auto& cut : kCut)
            visit(corners[cut[0]], corners[cut[1]], corners[cut[2]], corners[cut[3]]);
        }
  }
};

class Text {
 public:
  explicit Text(const std::string& path) : file_(path, std::ios::binary) {}
  ~Text() { file_ << text_; }
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;
  template <typename... T>
  void add(fmt::format_string<T...> pattern, T&&... values) {
    fmt::format_to(std::back_inserter(text_), pattern, std::forward<T>(values)...);
    if (text_.size() < (1U << 20)) return;
    file_ << text_;
    text_.clear();
  }

 private:
  std::ofstream file_;
  std::string text_;
};

void write_msh(const std::string& path, const Grid& grid) {
  Text text(path);
  text.add("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {} 1 {}\n3 1 0 {}\n", grid.nodes(),
           grid.nodes(), grid.nodes());
  for (std::size_t i = 1; i <= grid.nodes(); ++i) text.add("{}\n", i);
  grid.each_node(
      [&](double x, double y, double z) { text.add("{:.16g} {:.16g} {:.16g}\n", x, y, z); });
  text.add("$EndNodes\n$Elements\n1 {} 1 {}\n3 1 4 {}\n", grid.cells(), grid.cells(), grid.cells());
  std::size_t number = 0;
  grid.each_cell([&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    text.add("{} {} {} {} {}\n", ++number, a, b, c, d);
  });
  text.add("$EndElements\n");
}

void write_inp(const std::string& path, const Grid& grid) {
  Text text(path);
  text.add("*NODE\n");
  std::size_t number = 0;
  grid.each_node([&](double x, double y, double z) {
    text.add("{}, {:.12e}, {:.12e}, {:.12e}\n", ++number, x, y, z);
  });
  text.add("*ELEMENT, TYPE=C3D4, ELSET=ALL\n");
  number = 0;
  grid.each_cell([&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    text.add("{}, {}, {}, {}, {}\n", ++number, a, b, c, d);
  });
}

void measure(const std::string& path) {
  const ThreadLimit one_thread(1);
  double best = 1e300;
  std::size_t cells = 0;
  for (int round = 0; round < 3; ++round) {
    const double start = seconds_now();
    cells = formats::format_to_read(path).read(path, {}).mesh.cell_count();
    best = std::min(best, seconds_now() - start);
  }
  const double megabytes = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
  std::printf("%s: %zu cells, %.0f MB, %.2f s, %.0f MB/s\n", path.c_str(), cells, megabytes, best,
              megabytes / best);
}

}  // namespace
}  // namespace hiac

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::string folder = argv[1];
  const hiac::Grid grid{argc > 2 ? std::stoul(argv[2]) : 70};
  hiac::write_msh(folder + "/cube.msh", grid);
  hiac::write_inp(folder + "/cube.inp", grid);
  const std::string binary = folder + "/cube-binary.msh";
  const auto mesh =
      hiac::formats::format_to_read(folder + "/cube.msh").read(folder + "/cube.msh", {});
  hiac::formats::format_to_write(binary).write(binary, mesh.mesh);
  for (const char* name : {"/cube.msh", "/cube.inp", "/cube-binary.msh"})
    hiac::measure(folder + name);
  return 0;
}

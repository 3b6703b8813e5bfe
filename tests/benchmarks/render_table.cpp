// Table 3 of P. Williams, N. Max, C. Stein, "A High Accuracy Volume Renderer for Unstructured
// Data", 1998, section 8, on random Delaunay tetrahedra of the unit cube: seconds of the engine by
// method of integration, pixels and cells; and how they grow with pixels and with cells.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "hiac/base/parallel.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/render/engine.hpp"
#include "tests/benchmarks/cube_scene.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

struct Method {
  std::string name;
  Integration integration;
  CellOrder order = CellOrder::linear;
};

const std::vector<Method>& methods() {
  static const std::vector<Method> kMethods{{"approximate", Integration::approximate},
                                            {"exact", Integration::exact},
                                            {"gauss5", Integration::gauss5}};
  return kMethods;
}

// The paper's third row: quadratic cells, here integrated to the tolerance.
const Method& quadratic_cells() {
  static const Method kQuadratic{"quadratic", Integration::exact, CellOrder::quadratic};
  return kQuadratic;
}

// A row of Table 3: minutes on one R10000 of an SGI Power Onyx with 13,000 and with 600,000 cells.
struct PaperRow {
  std::string method;
  std::uint32_t side;
  std::array<double, 2> minutes;
};

const std::vector<PaperRow>& paper_rows() {
  static const std::vector<PaperRow> kRows{
      {"approximate", 316, {0.17, 2.0}}, {"approximate", 1000, {0.77, 7.6}},
      {"exact", 316, {0.24, 2.9}},       {"exact", 1000, {1.7, 16.3}},
      {"quadratic", 316, {0.27, 3.5}},   {"quadratic", 1000, {2.0, 22.8}}};
  return kRows;
}

// Points that give about 13,000, 190,000, 600,000, 1,000,000 and 4,000,000 tetrahedra.
constexpr std::array<std::size_t, 5> kPoints{1490, 25350, 82700, 139600, 562000};
constexpr std::size_t kLargeOfTable3 = 2;  // the first is its other mesh
// Of square images: 0.1, 1, 4 and 16 million pixels.
constexpr std::array<std::uint32_t, 4> kSides{316, 1000, 2000, 4000};

struct Measured {
  double seconds = 0;  // of processor time, of all threads: other work of the machine shows little
  double megasegments = 0;
};

/// One mesh with its order, and what was measured on it, by method and side of the image.
class Bench {
 public:
  Bench(std::size_t points, double limit) : limit_(limit) {
    set_up(linear_, test::random_delaunay(points, 1));
    fmt::print(stderr, "{} cells\n", cells());
  }

  [[nodiscard]] std::size_t cells() const { return linear_.mesh.cell_count(); }

  /// None where growth with pixels from the next smaller image may pass the limit.
  std::optional<Measured> measure(const Method& method, std::uint32_t side) {
    const auto known = done_.find({method.name, side});
    if (known != done_.end()) return known->second;
    const auto next = done_.lower_bound({method.name, side});
    if (next != done_.begin() && std::prev(next)->first.first == method.name) {
      const auto& [smaller, measured] = *std::prev(next);
      const double ratio = static_cast<double>(side) / smaller.second;
      if (measured.seconds * ratio * ratio > limit_) return std::nullopt;
    }
    const bool quadratic = method.order == CellOrder::quadratic;
    if (quadratic && quadratic_.mesh.cell_count() == 0)
      set_up(quadratic_, test::of_order(linear_.mesh, CellOrder::quadratic));
    const Ordered& drawn = quadratic ? quadratic_ : linear_;
    Scene scene = cube_scene(side);
    scene.render.integration = method.integration;
    const std::clock_t start = std::clock();
    const RenderResult result = render(drawn.mesh, drawn.order, scene, false);
    const Measured measured{static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC,
                            static_cast<double>(result.statistics.segments) / 1e6};
    return done_[{method.name, side}] = measured;
  }

 private:
  struct Ordered {
    ZooMesh mesh;
    VisibilityOrder order;
  };

  static void set_up(Ordered& ordered, ZooMesh mesh) {
    ordered.mesh = std::move(mesh);
    test::add_node_field(ordered.mesh, "f", test::smooth_field);
    ordered.mesh.adjacency = build_face_adjacency(ordered.mesh);
    ordered.order = order_of(ordered.mesh, cube_scene(1)).order;
  }

  Ordered linear_, quadratic_;
  double limit_;
  std::map<std::pair<std::string, std::uint32_t>, Measured> done_;
};

std::string pixels_text(std::uint32_t side) {
  return fmt::format("{:.1f} million", static_cast<double>(side) * side / 1e6);
}

void print_line(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) fmt::print("{:>22}", text);
  fmt::print("\n");
  std::fflush(stdout);
}

std::string seconds_text(const std::optional<Measured>& measured) {
  return measured ? fmt::format("{:.2f}", measured->seconds) : "-";
}

void print_table_3(Bench& small, Bench& large) {
  fmt::print("\nTable 3: seconds; in brackets minutes of the paper and how many times faster\n");
  print_line({"integration", "pixels", fmt::format("{} cells", small.cells()),
              fmt::format("{} cells", large.cells())});
  std::vector<Method> rows = methods();
  rows.push_back(quadratic_cells());
  for (const Method& method : rows)
    for (const std::uint32_t side : {316U, 1000U}) {
      const auto paper = std::find_if(
          paper_rows().begin(), paper_rows().end(),
          [&](const PaperRow& row) { return row.method == method.name && row.side == side; });
      std::vector<std::string> texts{method.name, pixels_text(side)};
      for (std::size_t i = 0; i < 2; ++i) {
        const auto measured = (i == 0 ? small : large).measure(method, side);
        std::string text = seconds_text(measured);
        if (measured && paper != paper_rows().end())
          text += fmt::format(" ({:.2f}, {:.0f}x)", paper->minutes[i],
                              60 * paper->minutes[i] / measured->seconds);
        texts.push_back(text);
      }
      print_line(texts);
    }
}

std::string growth_text(const std::optional<Measured>& measured,
                        const std::optional<Measured>& first, double by) {
  if (!measured) return "-";
  std::string text = fmt::format("{:.2f}", measured->seconds);
  if (first && by != 1)
    text += fmt::format(" (~{:.2f})", std::log(measured->seconds / first->seconds) / std::log(by));
  return text;
}

void print_growth_with_pixels(Bench& bench) {
  fmt::print(
      "\nGrowth with pixels, {} cells: seconds; in brackets the power of the pixels that\n"
      "they grow with from the first row on\n",
      bench.cells());
  print_line({"pixels", "approximate", "exact", "gauss5", "million segments"});
  for (const std::uint32_t side : kSides) {
    const double ratio = static_cast<double>(side) / kSides[0];
    std::vector<std::string> texts{pixels_text(side)};
    std::optional<Measured> last;
    for (const Method& method : methods()) {
      const auto first = bench.measure(method, kSides[0]);
      const auto measured = bench.measure(method, side);
      texts.push_back(growth_text(measured, first, ratio * ratio));
      if (measured) last = measured;
    }
    texts.push_back(last ? fmt::format("{:.0f}", last->megasegments) : "-");
    print_line(texts);
  }
}

/// What is kept of a mesh for the table of growth with cells.
struct CellsRow {
  std::size_t cells = 0;
  std::vector<std::optional<Measured>> by_method;
};

CellsRow cells_row(Bench& bench) {
  CellsRow row{bench.cells(), {}};
  for (const Method& method : methods()) row.by_method.push_back(bench.measure(method, 1000));
  return row;
}

void print_growth_with_cells(const std::vector<CellsRow>& rows) {
  fmt::print(
      "\nGrowth with cells, a million pixels: seconds; in brackets the power of the cells that\n"
      "they grow with from the first row on\n");
  print_line({"cells", "approximate", "exact", "gauss5", "million segments"});
  for (const CellsRow& row : rows) {
    const double ratio = static_cast<double>(row.cells) / static_cast<double>(rows[0].cells);
    std::vector<std::string> texts{fmt::format("{}", row.cells)};
    std::optional<Measured> last;
    for (std::size_t m = 0; m < row.by_method.size(); ++m) {
      texts.push_back(growth_text(row.by_method[m], rows[0].by_method[m], ratio));
      if (row.by_method[m]) last = row.by_method[m];
    }
    texts.push_back(last ? fmt::format("{:.0f}", last->megasegments) : "-");
    print_line(texts);
  }
}

struct Options {
  unsigned threads = 1;
  double limit = 60;
  std::size_t sizes = kPoints.size();
};

void print_tables(const Options& options) {
  fmt::print("Seconds of processor time of the engine, {} thread(s); the order is made before\n",
             options.threads);
  Bench small(kPoints[0], options.limit);
  std::vector<CellsRow> rows{cells_row(small)};
  for (std::size_t i = 1; i < options.sizes; ++i) {
    Bench bench(kPoints[i], options.limit);
    if (i == kLargeOfTable3) {
      print_table_3(small, bench);
      print_growth_with_pixels(small);
      print_growth_with_pixels(bench);
    }
    rows.push_back(cells_row(bench));
  }
  print_growth_with_cells(rows);
  fmt::print(
      "\nA dash: not measured, because growth with the pixels may pass the limit of {:g} s.\n",
      options.limit);
}

}  // namespace
}  // namespace hiac

int main(int count, char** arguments) {
  hiac::Options options;
  CLI::App app{"The paper's table of rendering times, measured"};
  app.add_option("--threads", options.threads, "threads; 0: one for every core")
      ->capture_default_str();
  app.add_option("--limit", options.limit, "leave out pictures that may take longer, in seconds")
      ->capture_default_str();
  app.add_option("--sizes", options.sizes,
                 "how many of the five meshes, smallest first; Table 3 needs three")
      ->capture_default_str()
      ->check(CLI::Range(hiac::kLargeOfTable3 + 1, hiac::kPoints.size()));
  CLI11_PARSE(app, count, arguments);
  const hiac::ThreadLimit limit(options.threads);
  hiac::print_tables(options);
  return 0;
}

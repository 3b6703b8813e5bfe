// Tables 1 and 2 of P. Williams, N. Max, C. Stein, "A High Accuracy Volume Renderer for
// Unstructured Data", 1998, section 6.2, on random Delaunay tetrahedra of the unit cube: seconds of
// the sort with one tile (stein) and with more (multitiled), and how many times faster those are.

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "hiac/base/parallel.hpp"
#include "hiac/order/published/multitiled.hpp"
#include "hiac/order/published/stein.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

constexpr double kPlanarity = 1e-10;
constexpr std::size_t kSizes = 4;
using Figures = std::array<double, kSizes>;

// Points that give about 13,000, 190,000, 600,000 and 1,000,000 tetrahedra.
constexpr std::array<std::size_t, kSizes> kPoints{1490, 25350, 82700, 139600};

// A row: how the window is divided, and the paper's minutes (on one R10000 of an SGI Power Onyx).
struct Row {
  std::string tiles;
  std::optional<TilingOptions> tiling;  // none: stein_order
  std::optional<Figures> paper;
};

const std::vector<Row>& rows() {
  static const std::vector<Row> kRows{
      {"1 (stein)", std::nullopt, Figures{0.23, 48.0, 490, 909}},
      {"2 x 1", TilingOptions{2, 1, false}, Figures{0.17, 19.1, 245, 403}},
      {"2 x 2", TilingOptions{2, 2, false}, Figures{0.15, 9.2, 87, 161}},
      {"4 x 2", TilingOptions{4, 2, false}, Figures{0.14, 6.1, 41, 62}},
      {"4 x 4", TilingOptions{4, 4, false}, Figures{0.14, 4.3, 19, 33}},
      {"8 x 4", TilingOptions{8, 4, false}, Figures{0.15, 3.4, 11, 19}},
      {"n^1/6 x n^1/6", TilingOptions{0, 0, false}, std::nullopt},
      {"the same, balanced", TilingOptions{0, 0, true}, Figures{0.12, 2.7, 9.5, 15.0}},
      {"32 x 32", TilingOptions{32, 32, false}, std::nullopt},
      {"64 x 64, balanced", TilingOptions{64, 64, true}, std::nullopt}};
  return kRows;
}

// Of processor time, of all threads together: other work of the machine hardly shows in it.
double seconds_of(const ZooMesh& mesh, const View& view, const Row& row) {
  const std::clock_t start = std::clock();
  const VisibilityOrder order = row.tiling ? multitiled_order(mesh, view, kPlanarity, *row.tiling)
                                           : stein_order(mesh, view, kPlanarity);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// What a table has in one place. Not measured: what would have taken longer than the limit.
struct Entry {
  double seconds = 0;
  bool measured = false;
};

std::string text_of(const Entry& entry, const Entry& one_tile) {
  if (!entry.measured) return fmt::format("(~{:.0f})", entry.seconds);
  if (!one_tile.measured) return fmt::format("{:.2f}", entry.seconds);
  return fmt::format("{:.2f} ({:.1f}x)", entry.seconds, one_tile.seconds / entry.seconds);
}

void print_line(const std::string& first, const std::vector<std::string>& texts) {
  fmt::print("{:<20}", first);
  for (const std::string& text : texts) fmt::print("{:>18}", text);
  fmt::print("\n");
  std::fflush(stdout);
}

void print_paper() {
  fmt::print("\nThe paper, minutes on one R10000 (Table 1; balanced: Table 2)\n");
  print_line("tiles", {"13,000", "190,000", "600,000", "1,000,000"});
  const Figures& one = *rows().front().paper;
  for (const Row& row : rows()) {
    if (!row.paper) continue;
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < kSizes; ++i)
      texts.push_back(fmt::format("{:.2f} ({:.1f}x)", (*row.paper)[i], one[i] / (*row.paper)[i]));
    print_line(row.tiles, texts);
  }
}

struct Options {
  unsigned threads = 1;
  double limit = 60;
  std::size_t sizes = kSizes;
  bool parallel_view = false;
};

void print_measured(const Options& options) {
  const View view =
      options.parallel_view ? View{false, {}, {-2.6, -1.8, -2.2}} : View{true, {3.1, 2.3, 2.7}, {}};
  std::vector<std::vector<Entry>> table(rows().size());
  std::vector<std::string> sizes;
  std::vector<double> cells;
  for (std::size_t i = 0; i < options.sizes; ++i) {
    const ZooMesh mesh = test::random_delaunay(kPoints[i], 1);
    cells.push_back(static_cast<double>(mesh.cell_count()));
    sizes.push_back(fmt::format("{}", mesh.cell_count()));
    for (std::size_t r = 0; r < rows().size(); ++r) {
      Entry entry;
      // O(n^2) from the size before: what the time would be at worst
      if (i > 0)
        entry.seconds =
            table[r].back().seconds * (cells[i] / cells[i - 1]) * (cells[i] / cells[i - 1]);
      entry.measured = i == 0 || entry.seconds <= options.limit;
      if (entry.measured) entry.seconds = seconds_of(mesh, view, rows()[r]);
      table[r].push_back(entry);
      fmt::print(stderr, "{} cells, {}: {:.2f} s{}\n", mesh.cell_count(), rows()[r].tiles,
                 entry.seconds, entry.measured ? "" : " (estimated)");
    }
  }
  fmt::print("Measured, seconds of processor time, {} thread(s)\n", options.threads);
  print_line("tiles", sizes);
  for (std::size_t r = 0; r < rows().size(); ++r) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < options.sizes; ++i)
      texts.push_back(text_of(table[r][i], table[0][i]));
    print_line(rows()[r].tiles, texts);
  }
  fmt::print(
      "In brackets after seconds: how many times faster than with one tile. Seconds in brackets:\n"
      "not measured, because growth by the square of the cells from the size before may pass the\n"
      "limit of {:g} s.\n",
      options.limit);
}

}  // namespace
}  // namespace hiac

int main(int count, char** arguments) {
  hiac::Options options;
  CLI::App app{"The paper's tables of sorting times, measured"};
  app.add_option("--threads", options.threads, "threads; 0: one for every core")
      ->capture_default_str();
  app.add_option("--limit", options.limit, "leave out sorts that may take longer, in seconds")
      ->capture_default_str();
  app.add_option("--sizes", options.sizes, "how many of the four sizes, smallest first")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, hiac::kSizes));
  app.add_flag("--orthographic", options.parallel_view, "a parallel view");
  CLI11_PARSE(app, count, arguments);
  const hiac::ThreadLimit limit(options.threads);
  hiac::print_measured(options);
  hiac::print_paper();
  return 0;
}

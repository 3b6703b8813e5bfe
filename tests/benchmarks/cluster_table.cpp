// The work and the traffic of every process of a mesh in the partitioner's parts, for
// docs/cluster.md: the processes run one after another in one thread. `segments`, `balance` and
// `work` are the largest over the mean: of ray segments, of the seconds of drawing, and of all
// seconds.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "hiac/base/parallel.hpp"
#include "hiac/cluster/run_message.hpp"
#include "hiac/cluster/tile_rounds.hpp"
#include "hiac/frame/tiles/finished_tile.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/parted/split_mesh.hpp"
#include "hiac/partition/partition.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/render/runs/part_engine.hpp"
#include "tests/benchmarks/cube_scene.hpp"
#include "tests/support/meshes.hpp"

namespace {

using namespace hiac;

// Of the processor: the machine may have other work.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// A value of every part.
struct Column {
  std::vector<double> values;

  explicit Column(std::uint32_t parts) : values(parts) {}
  [[nodiscard]] double sum() const { return std::accumulate(values.begin(), values.end(), 0.0); }
  [[nodiscard]] double most() const { return *std::ranges::max_element(values); }
  [[nodiscard]] double balance() const {
    return most() / (sum() / static_cast<double>(values.size()));
  }
};

// What the processes take, each with a part, and the picture that they make.
struct Work {
  Column order_seconds, prepare_seconds, draw_seconds, merge_seconds, bytes, segments;
  std::uint64_t runs = 0;
  Image image;

  Work(std::uint32_t parts, const ImageSize& size)
      : order_seconds(parts),
        prepare_seconds(parts),
        draw_seconds(parts),
        merge_seconds(parts),
        bytes(parts),
        segments(parts),
        image(size.width, size.height, rgba_channels()) {}

  // The seconds of all that the process of part `k` does.
  [[nodiscard]] double seconds(std::uint32_t k) const {
    return order_seconds.values[k] + prepare_seconds.values[k] + draw_seconds.values[k] +
           merge_seconds.values[k];
  }
};

using Messages = std::vector<std::vector<Bytes>>;  // by tile

// Orders and draws part `k` and adds what it sends.
MergeConstants draw_part(MeshPart part, const Scene& scene, const MeshExtremes& extremes,
                         std::uint32_t k, Work& work, Messages& sent) {
  part.mesh.adjacency = build_face_adjacency(part.mesh);
  double start = cpu_seconds();
  const OrderResult order = order_of(part.mesh, scene);
  work.order_seconds.values[k] = cpu_seconds() - start;
  start = cpu_seconds();
  PartEngine engine(part.mesh, scene, {});
  engine.set_whole(extremes);
  const TileBins bins = engine.bins(order.order, whole_picture(scene.image));
  work.prepare_seconds.values[k] = cpu_seconds() - start;
  const std::vector<TileRect> tiles = tiles_of(scene.image, whole_picture(scene.image));
  start = cpu_seconds();
  for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
    if (bins.cells_of(tile).empty()) continue;
    const TileRuns drawn = engine.draw(order.order, tiles[tile], bins.cells_of(tile));
    work.runs += drawn.runs.size();
    work.segments.values[k] += static_cast<double>(drawn.counts.segments);
    ByteWriter message(sent[tile].emplace_back());
    put_runs(message, drawn);
    work.bytes.values[k] += static_cast<double>(sent[tile].back().size());
  }
  work.draw_seconds.values[k] = cpu_seconds() - start;
  return engine.constants();
}

// The owners merge the tiles of each round.
void merge_tiles(const MergeConstants& constants, const Scene& scene, const Messages& sent,
                 Work& work) {
  const std::vector<TileRect> tiles = tiles_of(scene.image, whole_picture(scene.image));
  const Projector projector(scene.camera, scene.image);
  const PictureParts wanted{whole_picture(scene.image), false};
  std::vector<double>& seconds = work.merge_seconds.values;
  for (TileRounds rounds(tiles.size()); !rounds.at_end();) {
    const std::vector<std::uint32_t> round = rounds.next();
    for (std::size_t place = 0; place < round.size(); ++place) {
      const double start = cpu_seconds();
      std::vector<TileRuns> received;
      for (const Bytes& message : sent[round[place]]) {
        ByteReader from(message);
        received.push_back(get_runs(from));
      }
      MergedTile merged(constants, received);
      write_tile(merged, tiles[round[place]], projector, scene, wanted, work.image);
      seconds[place % seconds.size()] += cpu_seconds() - start;
    }
    rounds.note_bytes(1);
  }
}

// Does the work of all parts in turn, `passes` times. The seconds of each part are the least of all
// passes, which lie far apart, as the machine's speed changes from second to second.
Work least_work(const ZooMesh& mesh, const Scene& scene, const MeshExtremes& extremes,
                std::span<const std::uint32_t> part_of_cell, std::uint32_t parts,
                std::uint32_t passes) {
  MeshSplitter splitter(mesh, part_of_cell, parts);
  const std::size_t tiles = tiles_of(scene.image, whole_picture(scene.image)).size();
  std::optional<Work> least;
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    Work work(parts, scene.image);
    Messages sent(tiles);
    MergeConstants constants{};
    for (std::uint32_t k = 0; k < parts; ++k)
      constants = draw_part(splitter.part(k), scene, extremes, k, work, sent);
    merge_tiles(constants, scene, sent, work);
    if (least)
      for (Column Work::*column : {&Work::order_seconds, &Work::prepare_seconds,
                                   &Work::draw_seconds, &Work::merge_seconds})
        std::ranges::transform((work.*column).values, ((*least).*column).values,
                               (work.*column).values.begin(),
                               [](double a, double b) { return std::min(a, b); });
    least = std::move(work);
  }
  return *std::move(least);
}

// One line of the table; the picture of the parts is compared with `whole`.
void print_line(const Work& least, std::uint32_t parts, const Scene& scene, const Image& whole) {
  Column work(parts);
  for (std::uint32_t k = 0; k < parts; ++k) work.values[k] = least.seconds(k);
  double off = 0;
  for (std::size_t k = 0; k < least.image.values().size(); ++k)
    off = std::max(off, std::abs(least.image.values()[k] - whole.values()[k]));
  const auto pixels = static_cast<double>(scene.image.width) * scene.image.height;
  fmt::print(
      "{:5} {:8.2f} {:8.2f} {:8.2f} {:8.2f} {:8.3f} {:8.2f} {:8.2f} {:7.2f} {:8.2f} {:8.2f} "
      "{:8.1f} {:8.1f} {:9.1e}\n",
      parts, least.order_seconds.sum(), least.order_seconds.most(), least.prepare_seconds.most(),
      least.draw_seconds.sum(), least.draw_seconds.most(), least.segments.balance(),
      least.draw_seconds.balance(), least.merge_seconds.sum(), work.balance(),
      static_cast<double>(least.runs) / pixels, least.bytes.sum() / pixels,
      least.bytes.most() / pixels, off);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Work and traffic of the processes of a mesh in parts");
  std::size_t size = 46;
  std::uint32_t side = 1024;
  std::vector<std::uint32_t> counts{1, 2, 4, 8, 16, 32, 64};
  app.add_option("--size", size, "cubes along an edge, six tetrahedra each");
  app.add_option("--side", side, "pixels along an edge of the picture");
  app.add_option("--parts", counts, "numbers of parts");
  std::uint32_t random = 8;
  app.add_option("--random", random, "parts of cells taken at random; 0: none");
  std::uint32_t passes = 3;
  app.add_option("--passes", passes, "passes over all parts; the least seconds of each count")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  const ThreadLimit one(1);
  ZooMesh mesh = test::structured(size, test::Cut::tetrahedra);
  test::add_node_field(mesh, "f", test::smooth_field);
  const Scene scene = cube_scene(side);
  double start = cpu_seconds();
  mesh.adjacency = build_face_adjacency(mesh);
  const double adjacency_seconds = cpu_seconds() - start;
  start = cpu_seconds();
  const OrderResult order = order_of(mesh, scene);
  const double order_seconds = cpu_seconds() - start;
  start = cpu_seconds();
  const RenderResult whole = render(mesh, order.order, scene, false);
  const double render_seconds = cpu_seconds() - start;
  const Projector projector(scene.camera, scene.image);
  const MeshExtremes extremes = PartEngine(mesh, scene, {}).extremes();
  fmt::print("{} cells, {} pixels; whole: adjacency {:.2f} s, order {:.2f} s, render {:.2f} s\n",
             mesh.cell_count(), std::uint64_t{side} * side, adjacency_seconds, order_seconds,
             render_seconds);
  fmt::print(
      "{:>5} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>7} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9}\n",
      "parts", "order", "most", "prepare", "draw", "most", "segments", "balance", "merge", "work",
      "runs/px", "B/px", "most", "off");
  const auto measure = [&](std::span<const std::uint32_t> part_of_cell, std::uint32_t parts) {
    print_line(least_work(mesh, scene, extremes, part_of_cell, parts, passes), parts, scene,
               whole.image);
  };
  for (const std::uint32_t parts : counts) measure(partition_cells(mesh, parts, "cube"), parts);
  if (random == 0) return 0;
  std::vector<std::uint32_t> part_of_cell(mesh.cell_count());
  std::mt19937_64 numbers(1);  // the worst parts
  for (std::uint32_t& part : part_of_cell) part = static_cast<std::uint32_t>(numbers() % random);
  measure(part_of_cell, random);
}

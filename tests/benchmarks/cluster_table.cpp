// The work and the traffic of every process of a mesh in the partitioner's parts, for
// docs/cluster.md: the processes run one after another in one thread. The last two balances are the
// largest over the mean of drawing, and of all that a process does.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <numeric>
#include <random>
#include <span>
#include <string>
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

struct Column {
  std::vector<double> values;

  void add(double value) { values.push_back(value); }
  [[nodiscard]] double sum() const { return std::accumulate(values.begin(), values.end(), 0.0); }
  [[nodiscard]] double most() const { return *std::ranges::max_element(values); }
  [[nodiscard]] double balance() const {
    return most() / (sum() / static_cast<double>(values.size()));
  }
};

// One line of the table; the picture of the parts is compared with `whole`.
void measure(const ZooMesh& mesh, const Scene& scene, const MeshExtremes& extremes,
             std::span<const std::uint32_t> part_of_cell, std::uint32_t parts, const Image& whole) {
  MeshSplitter splitter(mesh, part_of_cell, parts);
  const std::vector<TileRect> tiles = tiles_of(scene.image, whole_picture(scene.image));
  std::vector<std::vector<Bytes>> sent(tiles.size());
  Column order_seconds, prepare_seconds, draw_seconds, bytes;
  std::uint64_t runs = 0;
  MergeConstants constants{};
  for (std::uint32_t k = 0; k < parts; ++k) {
    MeshPart part = splitter.part(k);
    part.mesh.adjacency = build_face_adjacency(part.mesh);
    double start = cpu_seconds();
    const OrderResult order = order_of(part.mesh, scene);
    order_seconds.add(cpu_seconds() - start);
    start = cpu_seconds();
    PartEngine engine(part.mesh, scene, {});
    engine.set_whole(extremes);
    const TileBins bins = engine.bins(order.order, whole_picture(scene.image));
    prepare_seconds.add(cpu_seconds() - start);
    start = cpu_seconds();
    std::size_t size = 0;
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
      if (bins.cells_of(tile).empty()) continue;
      const TileRuns drawn = engine.draw(order.order, tiles[tile], bins.cells_of(tile));
      runs += drawn.runs.size();
      ByteWriter message(sent[tile].emplace_back());
      put_runs(message, drawn);
      size += sent[tile].back().size();
    }
    draw_seconds.add(cpu_seconds() - start);
    bytes.add(static_cast<double>(size));
    constants = engine.constants();
  }
  const Projector projector(scene.camera, scene.image);
  const PictureParts wanted{whole_picture(scene.image), false};
  Image image(scene.image.width, scene.image.height, rgba_channels());
  Column merge_seconds;
  merge_seconds.values.resize(parts);
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
      write_tile(merged, tiles[round[place]], projector, scene, wanted, image);
      merge_seconds.values[place % parts] += cpu_seconds() - start;
    }
    rounds.note_bytes(1);
  }
  Column work;
  for (std::uint32_t k = 0; k < parts; ++k)
    work.add(order_seconds.values[k] + prepare_seconds.values[k] + draw_seconds.values[k] +
             merge_seconds.values[k]);
  double off = 0;
  for (std::size_t k = 0; k < image.values().size(); ++k)
    off = std::max(off, std::abs(image.values()[k] - whole.values()[k]));
  const auto pixels = static_cast<double>(scene.image.width) * scene.image.height;
  fmt::print(
      "{:5} {:8.2f} {:8.2f} {:8.2f} {:8.2f} {:8.3f} {:8.2f} {:7.2f} {:8.2f} {:8.2f} {:8.1f} "
      "{:8.1f} {:9.1e}\n",
      parts, order_seconds.sum(), order_seconds.most(), prepare_seconds.most(), draw_seconds.sum(),
      draw_seconds.most(), draw_seconds.balance(), merge_seconds.sum(), work.balance(),
      static_cast<double>(runs) / pixels, bytes.sum() / pixels, bytes.most() / pixels, off);
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
  fmt::print("{:>5} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>7} {:>8} {:>8} {:>8} {:>8} {:>9}\n",
             "parts", "order", "most", "prepare", "draw", "most", "balance", "merge", "work",
             "runs/px", "B/px", "most", "off");
  for (const std::uint32_t parts : counts)
    measure(mesh, scene, extremes, partition_cells(mesh, parts, "cube"), parts, whole.image);
  if (random == 0) return 0;
  std::vector<std::uint32_t> part_of_cell(mesh.cell_count());
  std::mt19937_64 numbers(1);  // the worst parts
  for (std::uint32_t& part : part_of_cell) part = static_cast<std::uint32_t>(numbers() % random);
  measure(mesh, scene, extremes, part_of_cell, random, whole.image);
}

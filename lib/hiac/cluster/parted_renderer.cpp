#include "hiac/cluster/parted_renderer.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/cluster/edged_tiles.hpp"
#include "hiac/cluster/parted_round.hpp"
#include "hiac/cluster/run_message.hpp"
#include "hiac/cluster/tile_rounds.hpp"
#include "hiac/cluster/whole_facts.hpp"
#include "hiac/frame/tiles/finished_tile.hpp"
#include "hiac/render/runs/part_engine.hpp"
#include "hiac/render/runs/runs_by_depth.hpp"

namespace hiac {
namespace {

// Parts are drawn in so many layers, one behind the other, where that pays.
constexpr std::uint32_t kMostLayers = 4;
// It pays where at least this share of the segments of the first round lies in parts behind the
// ends of their tiles.
constexpr double kHiddenShare = 0.1;
// The rounds of a picture in layers, at least: as many are on their way as there are layers.
constexpr std::size_t kLayeredRounds = 16;

}  // namespace

struct PartedRenderer::State {
  Communicator& all;
  std::vector<DrawnPart> parts;
  const Scene& scene;
  std::vector<Channel> channels;
  Projector projector;
  std::vector<std::unique_ptr<PartEngine>> engines;
  MergeConstants constants;
  PartedWork work;
  double prepare_seconds = 0;
  std::uint32_t layers = 1;
  std::vector<std::uint32_t> layer_of;                   // of each part
  std::uint64_t hidden_segments = 0, seen_segments = 0;  // of tiles that this process has merged

  State(Communicator& of, std::span<const DrawnPart> own, const Scene& what,
        std::span<const Channel> wanted)
      : all(of),
        parts(own.begin(), own.end()),
        scene(what),
        channels(wanted.begin(), wanted.end()),
        projector(scene.camera, scene.image) {
    const double start = seconds_now();
    require_parted_scene(scene, channels);
    std::vector<NumberedEngine> numbered;
    for (const DrawnPart& part : parts) {
      engines.push_back(std::make_unique<PartEngine>(part.mesh, scene, channels));
      numbered.push_back({*engines.back(), part.number, part.global_nodes});
    }
    constants = share_whole_facts(all, numbered, scene);
    layer_of.resize(parts.size(), 0);
    prepare_seconds = seconds_now() - start;
  }

  [[nodiscard]] std::vector<TileBins> bins_of(const PixelRect& rect) const {
    std::vector<TileBins> bins;
    for (std::size_t k = 0; k < parts.size(); ++k)
      bins.push_back(engines[k]->bins(parts[k].order, rect));
    return bins;
  }

  // A part's share in a tile of a round.
  struct Task {
    const PartedRound* round;
    std::size_t place, part;
  };

  // What there is to draw: of each round the parts of its layer.
  [[nodiscard]] std::vector<Task> tasks_of(std::span<const PartedRound> rounds,
                                           std::span<const TileBins> bins,
                                           const EdgedTiles& edged) const {
    std::vector<Task> tasks;
    for (const PartedRound& round : rounds)
      for (std::size_t place = 0; place < round.tiles.size(); ++place)
        for (std::size_t k = 0; k < parts.size(); ++k) {
          const std::uint32_t tile = round.tiles[place];
          if (layer_of[k] == round.layer && (!bins[k].cells_of(tile).empty() || edged.has(k, tile)))
            tasks.push_back({&round, place, k});
        }
    return tasks;
  }

  // Whether a task's part lies behind the end of the tile.
  [[nodiscard]] bool is_hidden(const Task& task, std::span<const std::uint32_t> cells) const {
    const double end = task.round->ends[task.place];
    if (end == std::numeric_limits<double>::infinity()) return false;
    return engines[task.part]->nearest(parts[task.part].order, cells) > end;
  }

  // The runs of this process's parts in the tiles of these rounds, as messages to the tiles'
  // owners.
  std::vector<Bytes> draw(std::span<const PartedRound> rounds, std::span<const TileRect> tiles,
                          std::span<const TileBins> bins, const EdgedTiles& edged) {
    const double start = seconds_now();
    const std::vector<Task> tasks = tasks_of(rounds, bins, edged);
    std::vector<Bytes> drawn(tasks.size());
    std::vector<std::pair<std::size_t, std::size_t>> counts(tasks.size());  // runs and segments
    parallel_for(tasks.size(), 1, [&](IndexRange range) {
      const auto& [round, place, k] = tasks[range.begin];
      const std::uint32_t tile = round->tiles[place];
      const auto cells = bins[k].cells_of(tile);
      if (is_hidden(tasks[range.begin], cells)) return;
      const TileRuns runs = engines[k]->draw(parts[k].order, tiles[tile], cells, edged.mask(tile));
      counts[range.begin] = {runs.runs.size(), runs.counts.segments};
      ByteWriter message(drawn[range.begin]);
      message.put(static_cast<std::uint32_t>(round - rounds.data()));
      message.put(static_cast<std::uint32_t>(place));
      message.put(parts[k].number);
      put_runs(message, runs);
    });
    std::vector<Bytes> to(all.size());
    std::uint64_t bytes = 0;
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      const std::uint32_t owner = PartedRound::owner(tasks[t].place, all);
      to[owner].insert(to[owner].end(), drawn[t].begin(), drawn[t].end());
      work.runs += counts[t].first;
      work.segments += counts[t].second;
      bytes += drawn[t].size();
      if (owner != all.rank()) work.sent_bytes += drawn[t].size();
      drawn[t] = {};
    }
    work.most_round_bytes = std::max(work.most_round_bytes, bytes);
    work.draw_seconds += seconds_now() - start;
    return to;
  }

  // Takes what has come in for this process's tiles of these rounds, each of which has one more
  // layer then.
  static void take(const std::vector<Bytes>& received, std::span<PartedRound> rounds) {
    for (const Bytes& bytes : received)
      for (ByteReader message(bytes); !message.at_end();) {
        const auto round = message.get<std::uint32_t>(), place = message.get<std::uint32_t>();
        const auto part = message.get<std::uint32_t>();
        rounds[round].received[place].add(part, get_runs(message));
      }
    for (PartedRound& round : rounds) ++round.layer;
  }

  // The end of a tile, as far as it is drawn. Pixels with edges do not end: their segments are no
  // runs.
  [[nodiscard]] double end_of(const TileRect& tile, const PartedTile& drawn) const {
    return end_of_tile(tile, drawn.runs, constants.least_transparency);
  }

  // The owners tell the ends of the tiles of these rounds, which have further layers.
  void share_ends(std::span<PartedRound> rounds, std::span<const TileRect> tiles) {
    const double start = seconds_now();
    Bytes mine;
    ByteWriter message(mine);
    for (PartedRound& round : rounds) {
      const std::vector<std::size_t> own = round.own_places(all);
      parallel_for(own.size(), 1, [&](IndexRange range) {
        const std::size_t place = own[range.begin];
        round.ends[place] = end_of(tiles[round.tiles[place]], round.received[place]);
      });
      for (const std::size_t place : own) message.put(round.ends[place]);
    }
    work.merge_seconds += seconds_now() - start;
    std::vector<Bytes> told = all_gather(all, mine);
    std::vector<ByteReader> from(told.begin(), told.end());
    for (PartedRound& round : rounds)
      for (std::size_t place = 0; place < round.tiles.size(); ++place)
        round.ends[place] = from[PartedRound::owner(place, all)].get<double>();
  }

  // Merges this process's tiles of a round; returns them as a message to rank 0. Parts that are
  // not seen count for nothing, as if they had not been drawn.
  Bytes merge(PartedRound& round, std::span<const TileRect> tiles, const PictureParts& wanted) {
    const double start = seconds_now();
    const std::vector<std::size_t> own = round.own_places(all);
    std::vector<Bytes> finished(own.size());
    std::vector<std::pair<std::uint64_t, std::uint64_t>> counts(own.size());  // hidden, and seen
    parallel_for(own.size(), 1, [&](IndexRange range) {
      PartedTile& of_tile = round.received[own[range.begin]];
      const std::uint32_t number = round.tiles[own[range.begin]];
      const TileRect& tile = tiles[number];
      const std::uint64_t hidden = of_tile.drop_behind(end_of(tile, of_tile));
      const auto edges =
          scene.edges ? std::optional(EdgedView{*scene.edges, projector, tile}) : std::nullopt;
      const auto merged =
          std::make_unique<MergedTile>(constants, of_tile.runs, edges ? &*edges : nullptr);
      counts[range.begin] = {hidden, merged->counts().segments};
      ByteWriter message(finished[range.begin]);
      message.put(number);
      put_finished(message, finish_tile(*merged, tile, projector, scene, wanted));
    });
    Bytes result;
    for (const Bytes& tile : finished) result.insert(result.end(), tile.begin(), tile.end());
    for (const auto& [hidden, seen] : counts) {
      hidden_segments += hidden;
      seen_segments += seen;
    }
    ++work.rounds;
    work.merge_seconds += seconds_now() - start;
    return result;
  }

  // Lays the parts in layers where the rounds so far say that it pays.
  void choose_layers(std::span<const TileBins> bins) {
    const std::array<std::uint64_t, 3> own{parts.size(), hidden_segments, seen_segments};
    const std::vector<std::uint64_t> sums = sum_of_all(all, own);
    const auto hidden = static_cast<double>(sums[1]), seen = static_cast<double>(sums[2]);
    if (!(hidden > kHiddenShare * (hidden + seen))) return;
    std::vector<PartDepth> depths;
    for (std::size_t k = 0; k < parts.size(); ++k)
      depths.push_back({parts[k].number, engines[k]->nearest(parts[k].order, bins[k].ranks)});
    layers = static_cast<std::uint32_t>(std::min<std::uint64_t>(sums[0], kMostLayers));
    layer_of = layers_of(all, depths, layers);
  }

  // Puts the tiles that the owners have finished into the picture; ranks other than 0 get none.
  static std::size_t put(const std::vector<Bytes>& received, std::span<const TileRect> tiles,
                         const PixelRect& part, std::span<TileSummary> summaries, Image& image) {
    std::size_t count = 0;
    for (const Bytes& bytes : received)
      for (ByteReader message(bytes); !message.at_end(); ++count) {
        const auto tile = message.get<std::uint32_t>();
        const FinishedTile finished = get_finished(message);
        summaries[tile] = finished.summary;
        put_tile(finished, tiles[tile], part, image);
      }
    return count;
  }

  // The statistics that rank 0 has, for all.
  RenderStatistics share(const RenderStatistics& own) {
    std::array<std::uint64_t, 1> splatted{};
    for (const auto& engine : engines) splatted[0] += engine->splatted_cells();
    Bytes mine;
    ByteWriter message(mine);
    for (const std::uint64_t count :
         {own.segments, own.violations, own.covered_pixels, own.depth_pixels})
      message.put(count);
    for (const double depth : {own.mean_optical_depth, own.largest_optical_depth})
      message.put(depth);
    const Bytes of_first = broadcast(all, mine);
    ByteReader from(of_first);
    RenderStatistics result;
    result.segments = from.get<std::uint64_t>();
    result.violations = from.get<std::uint64_t>();
    result.covered_pixels = from.get<std::uint64_t>();
    result.depth_pixels = from.get<std::uint64_t>();
    result.mean_optical_depth = from.get<double>();
    result.largest_optical_depth = from.get<double>();
    result.splatted_cells = sum_of_all(all, splatted)[0];
    return result;
  }
};

PartedRenderer::PartedRenderer(Communicator& all, std::span<const DrawnPart> own,
                               const Scene& scene, std::span<const Channel> channels)
    : state_(std::make_unique<State>(all, own, scene, channels)) {}

PartedRenderer::~PartedRenderer() = default;

const PartedWork& PartedRenderer::work() const { return state_->work; }

RenderResult PartedRenderer::render(const PixelRect& part, bool with_background,
                                    Progress* progress) {
  State& s = *state_;
  require_inside(part, s.scene.image);
  double start = seconds_now();
  const std::vector<TileRect> tiles = tiles_of(s.scene.image, part);
  const std::vector<TileBins> bins = s.bins_of(part);
  const EdgedTiles edged(s.all, s.engines, s.scene.edges.has_value(), tiles);
  const bool has_picture = s.all.rank() == 0;
  Image image = has_picture ? Image(part.width, part.height, image_channels(s.channels)) : Image();
  std::vector<TileSummary> summaries(has_picture ? tiles.size() : 0);
  const double prepared = seconds_now() - start + std::exchange(s.prepare_seconds, 0.0);
  start = seconds_now();
  if (progress != nullptr) progress->begin("tiles", tiles.size());
  const PictureParts wanted{part, with_background, s.channels};
  TileRounds rounds(tiles.size());
  bool is_first = true;
  for (std::vector<PartedRound> begun; !rounds.at_end() || !begun.empty();) {
    check_cancelled();
    if (!rounds.at_end()) begun.emplace_back(rounds.next());
    std::vector<Bytes> messages = s.draw(begun, tiles, bins, edged);
    const std::uint64_t bytes = total_size(messages);
    const std::vector<Bytes> received = s.all.exchange(std::move(messages));
    // the layers of a round are held until the last one has come
    rounds.note_bytes(most_of_all(s.all, std::max(bytes, s.layers * total_size(received))));
    State::take(received, begun);
    Bytes own;
    if (begun.front().layer == s.layers) {  // the first to begin is the first to end
      own = s.merge(begun.front(), tiles, wanted);
      begun.erase(begun.begin());
    }
    const std::vector<Bytes> finished = gather(s.all, std::move(own));
    const std::size_t count = State::put(finished, tiles, part, summaries, image);
    if (progress != nullptr) progress->advance(count);
    if (!begun.empty()) s.share_ends(begun, tiles);
    if (is_first && s.layers == 1) s.choose_layers(bins);
    if (s.layers > 1) rounds.limit(tiles.size() / kLayeredRounds + 1);
    is_first = false;
  }
  RenderStatistics statistics = s.share(statistics_of(summaries));
  statistics.prepare_seconds = prepared;
  statistics.tile_seconds = seconds_now() - start;
  return {std::move(image), statistics};
}

}  // namespace hiac

#include "hiac/cluster/parted_renderer.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/cluster/run_message.hpp"
#include "hiac/cluster/tile_rounds.hpp"
#include "hiac/cluster/whole_facts.hpp"
#include "hiac/frame/tiles/finished_tile.hpp"
#include "hiac/render/runs/part_engine.hpp"

namespace hiac {
namespace {

// The runs of one part in one tile.
struct PartRuns {
  std::uint32_t tile, part;  // the tile's number among those of the picture
  TileRuns runs;
};

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
    prepare_seconds = seconds_now() - start;
  }

  [[nodiscard]] std::vector<TileBins> bins_of(const PixelRect& rect) const {
    std::vector<TileBins> bins;
    for (std::size_t k = 0; k < parts.size(); ++k)
      bins.push_back(engines[k]->bins(parts[k].order, rect));
    return bins;
  }

  // The pixels of every tile through which edges of any part pass; which of this process's parts
  // have some in a tile.
  struct EdgedTiles {
    std::vector<PixelMask> masks;                    // empty where no edges are drawn
    std::vector<std::vector<std::uint8_t>> has_own;  // by part and tile

    [[nodiscard]] const PixelMask* mask(std::uint32_t tile) const {
      return masks.empty() ? nullptr : &masks[tile];
    }
    [[nodiscard]] bool has(std::size_t part, std::uint32_t tile) const {
      return !masks.empty() && has_own[part][tile] != 0;
    }
  };
  [[nodiscard]] EdgedTiles edged_tiles(std::span<const TileRect> tiles) const {
    EdgedTiles edged;
    if (!scene.edges) return edged;
    edged.masks.resize(tiles.size());
    edged.has_own.assign(parts.size(), std::vector<std::uint8_t>(tiles.size()));
    parallel_for(tiles.size(), 1, [&](IndexRange range) {
      for (std::size_t k = 0; k < parts.size(); ++k)
        edged.has_own[k][range.begin] =
            engines[k]->mark_edges(tiles[range.begin], edged.masks[range.begin]) ? 1 : 0;
    });
    Bytes mine;
    ByteWriter message(mine);
    for (const PixelMask& mask : edged.masks)
      message.put_all(std::span<const std::uint64_t>(mask.rows()));
    for (const Bytes& received : all_gather(all, mine)) {
      ByteReader from(received);
      for (PixelMask& mask : edged.masks) mask.add_rows(from.get_all<std::uint64_t>(kTileHeight));
    }
    return edged;
  }

  // The runs of this process's parts in the tiles of a round, as messages to the tiles' owners.
  std::vector<Bytes> draw(std::span<const TileRect> tiles, std::span<const std::uint32_t> round,
                          std::span<const TileBins> bins, const EdgedTiles& edged) {
    const double start = seconds_now();
    std::vector<std::pair<std::uint32_t, std::size_t>> tasks;  // the tile's place, and the part's
    for (std::uint32_t place = 0; place < round.size(); ++place)
      for (std::size_t k = 0; k < parts.size(); ++k)
        if (!bins[k].cells_of(round[place]).empty() || edged.has(k, round[place]))
          tasks.emplace_back(place, k);
    std::vector<Bytes> drawn(tasks.size());
    std::vector<std::pair<std::size_t, std::size_t>> counts(tasks.size());  // runs and segments
    parallel_for(tasks.size(), 1, [&](IndexRange range) {
      const auto [place, k] = tasks[range.begin];
      const std::uint32_t tile = round[place];
      const TileRuns runs =
          engines[k]->draw(parts[k].order, tiles[tile], bins[k].cells_of(tile), edged.mask(tile));
      counts[range.begin] = {runs.runs.size(), runs.counts.segments};
      ByteWriter message(drawn[range.begin]);
      message.put(tile);
      message.put(parts[k].number);
      put_runs(message, runs);
    });
    std::vector<Bytes> to(all.size());
    std::uint64_t bytes = 0;
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      const std::uint32_t owner = tasks[t].first % all.size();
      to[owner].insert(to[owner].end(), drawn[t].begin(), drawn[t].end());
      work.runs += counts[t].first;
      work.segments += counts[t].second;
      bytes += drawn[t].size();
      if (owner != all.rank()) work.sent_bytes += drawn[t].size();
      drawn[t] = {};
    }
    ++work.rounds;
    work.most_round_bytes = std::max(work.most_round_bytes, bytes);
    work.draw_seconds += seconds_now() - start;
    return to;
  }

  // Merges this process's tiles of a round; returns them as a message to rank 0.
  Bytes merge(std::span<const TileRect> tiles, std::span<const std::uint32_t> round,
              const std::vector<Bytes>& received, const PictureParts& wanted) {
    const double start = seconds_now();
    std::vector<PartRuns> runs;
    for (const Bytes& bytes : received)
      for (ByteReader message(bytes); !message.at_end();) {
        const auto tile = message.get<std::uint32_t>(), part = message.get<std::uint32_t>();
        runs.push_back({tile, part, get_runs(message)});
      }
    std::ranges::sort(runs, {}, [](const PartRuns& r) { return std::pair(r.tile, r.part); });
    std::vector<std::uint32_t> own;
    for (std::uint32_t place = all.rank(); place < round.size(); place += all.size())
      own.push_back(round[place]);
    std::vector<Bytes> finished(own.size());
    parallel_for(own.size(), 1, [&](IndexRange range) {
      const std::uint32_t tile = own[range.begin];
      std::vector<TileRuns> of_tile;
      for (PartRuns& r : std::ranges::equal_range(runs, tile, {}, &PartRuns::tile))
        of_tile.push_back(std::move(r.runs));
      const auto edges = scene.edges
                             ? std::optional(EdgedView{*scene.edges, projector, tiles[tile]})
                             : std::nullopt;
      const auto merged =
          std::make_unique<MergedTile>(constants, of_tile, edges ? &*edges : nullptr);
      ByteWriter message(finished[range.begin]);
      message.put(tile);
      put_finished(message, finish_tile(*merged, tiles[tile], projector, scene, wanted));
    });
    Bytes result;
    for (const Bytes& tile : finished) result.insert(result.end(), tile.begin(), tile.end());
    work.merge_seconds += seconds_now() - start;
    return result;
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
    Bytes mine;
    ByteWriter message(mine);
    std::uint64_t splatted = 0;
    for (const auto& engine : engines) splatted += engine->splatted_cells();
    message.put(splatted);
    std::uint64_t all_splatted = 0;
    for (const Bytes& received : all_gather(all, mine))
      all_splatted += ByteReader(received).get<std::uint64_t>();
    mine.clear();
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
    result.splatted_cells = all_splatted;
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
  const State::EdgedTiles edged = s.edged_tiles(tiles);
  const bool has_picture = s.all.rank() == 0;
  Image image = has_picture ? Image(part.width, part.height, image_channels(s.channels)) : Image();
  std::vector<TileSummary> summaries(has_picture ? tiles.size() : 0);
  const double prepared = seconds_now() - start + std::exchange(s.prepare_seconds, 0.0);
  start = seconds_now();
  if (progress != nullptr) progress->begin("tiles", tiles.size());
  const PictureParts wanted{part, with_background, s.channels};
  for (TileRounds rounds(tiles.size()); !rounds.at_end();) {
    check_cancelled();
    const std::vector<std::uint32_t> round = rounds.next();
    std::vector<Bytes> messages = s.draw(tiles, round, bins, edged);
    const std::uint64_t bytes = total_size(messages);
    const std::vector<Bytes> received = s.all.exchange(std::move(messages));
    rounds.note_bytes(most_of_all(s.all, std::max(bytes, total_size(received))));
    const std::vector<Bytes> finished = gather(s.all, s.merge(tiles, round, received, wanted));
    const std::size_t count = State::put(finished, tiles, part, summaries, image);
    if (progress != nullptr) progress->advance(count);
  }
  RenderStatistics statistics = s.share(statistics_of(summaries));
  statistics.prepare_seconds = prepared;
  statistics.tile_seconds = seconds_now() - start;
  return {std::move(image), statistics};
}

}  // namespace hiac

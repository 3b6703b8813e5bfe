#include "hiac/frame/tiles/picture.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// An engine of its own: what a pixel holds tells its column, its row and how many cells its tile
// was given. Every third column is not covered, and in every fifth no bound is known.
class TellingTile : public DrawnTile {
 public:
  // `surfaces`: the transparency of skin and edges.
  TellingTile(const TileRect& tile, std::size_t cells, double surfaces)
      : tile_(tile), surfaces_(surfaces), pixels_(std::make_unique<TilePixels>()) {
    counts_ = {.segments = cells, .violations = 1};
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const std::size_t at = tile.index(x, y);
        pixels_->red[at] = x;
        pixels_->green[at] = y;
        pixels_->blue[at] = static_cast<double>(cells);
        pixels_->transparency[at] = 0.25;
        pixels_->last[at] = x % 3 == 0 ? -kInfinity : 1.0;
      }
  }

  [[nodiscard]] const TilePixels& pixels() const override { return *pixels_; }
  [[nodiscard]] const TileCounts& counts() const override { return counts_; }
  [[nodiscard]] const PixelFacts& facts(std::size_t at) const override {
    facts_ = {.first = 2.0 + tile_.column(at),
              .weight = tile_.row(at) % 2 == 0 ? 0.5 : 0,
              .weighted_depth = 1.5,
              .cells = 7,
              .violations = 3};
    return facts_;
  }
  [[nodiscard]] double error(std::size_t at, double background) override {
    return tile_.column(at) % 5 == 0 ? std::nan("") : 10 * background + tile_.row(at);
  }
  [[nodiscard]] double surface_transparency(std::size_t /*at*/) const override { return surfaces_; }

 private:
  TileRect tile_;
  double surfaces_;
  std::unique_ptr<TilePixels> pixels_;
  TileCounts counts_;
  mutable PixelFacts facts_;
};

class PictureTest : public testing::Test {
 protected:
  static constexpr double kBehind = 0.5;

  PictureTest() : mesh_(test::structured(3, test::Cut::tetrahedra)) {
    test::add_node_field(mesh_, "f", test::smooth_field);
    scene_.image = {150, 80};  // three by three tiles
    scene_.camera.projection = Projection::orthographic;
    scene_.camera.eye = {0.5, 0.5, 4};
    scene_.camera.look_at = {0.5, 0.5, 0.5};
    scene_.camera.up = {0, 1, 0};
    scene_.camera.height = 1.2;
    scene_.background.color = {kBehind, 0.25, 0};
    scene_.volume.extinction = ExtinctionTransfer{"f", {{0.0, {0.0}}, {1.0, {1.0}}}};
    projector_.emplace(scene_.camera, scene_.image);
    frame_.emplace(mesh_, scene_, *projector_);
    std::vector<CellId> ids(mesh_.cell_count());
    std::iota(ids.begin(), ids.end(), CellId{0});
    order_.cells = std::move(ids);
  }

  RenderResult draw(const PictureParts& wanted) {
    const TileBins bins = bin_cells(*frame_, order_, scene_.image, wanted.part);
    return draw_picture(
        *frame_, scene_, bins, wanted,
        [&](const TileRect& tile, std::span<const std::uint32_t> ranks, const TakeTile& take) {
          TellingTile drawn(tile, ranks.size(), surfaces_);
          take(drawn);
        },
        nullptr);
  }

  ZooMesh mesh_;
  Scene scene_;
  std::optional<Projector> projector_;
  std::optional<Frame> frame_;
  VisibilityOrder order_;
  double surfaces_ = 1;
};

TEST_F(PictureTest, IsWhatTheEngineDraws) {
  const PixelRect whole = whole_picture(scene_.image);
  const TileBins bins = bin_cells(*frame_, order_, scene_.image, whole);
  ASSERT_EQ(bins.tiles.size(), 9U);
  for (const bool with_background : {false, true}) {
    const RenderResult result = draw({whole, with_background});
    for (std::uint32_t y = 0; y < 80; ++y)
      for (std::uint32_t x = 0; x < 150; ++x) {
        const auto pixel = result.image.pixel(x, y);
        const std::size_t tile = y / kTileHeight * 3 + x / kTileWidth;
        ASSERT_EQ(pixel[0], x + (with_background ? 0.25 * kBehind : 0));
        ASSERT_EQ(pixel[1], y + (with_background ? 0.25 * 0.25 : 0));
        ASSERT_EQ(pixel[2], static_cast<double>(bins.cells_of(tile).size()));
        ASSERT_EQ(pixel[3], 0.75);
      }
  }
}

TEST_F(PictureTest, HasTheChannelsOfItsPixels) {
  const std::vector<Channel> channels{Channel::error, Channel::depth,   Channel::mean_depth,
                                      Channel::cells, Channel::witness, Channel::transparency};
  const PixelRect part{60, 30, 20, 10};  // of four tiles
  const RenderResult result = draw({part, true, channels});
  ASSERT_EQ(result.image.channel_count(), 10U);
  EXPECT_EQ(result.image.channel_index("depth"), 5U);
  for (std::uint32_t y = 0; y < part.height; ++y)
    for (std::uint32_t x = 0; x < part.width; ++x) {
      const auto pixel = result.image.pixel(x, y);
      const std::uint32_t column = part.x + x, row = part.y + y;
      ASSERT_EQ(pixel[0], column + 0.25 * kBehind);
      ASSERT_EQ(pixel[4], column % 5 == 0 ? kInfinity : 10 * kBehind + row);
      ASSERT_EQ(pixel[5], projector_->distance(2.0 + column));
      ASSERT_EQ(pixel[6], row % 2 == 0 ? projector_->distance(3) : kInfinity);
      ASSERT_EQ(pixel[7], 7);
      ASSERT_EQ(pixel[8], 3);
      ASSERT_EQ(pixel[9], 0.25);
    }
}

TEST_F(PictureTest, CountsTilesAndCoveredPixels) {
  const PixelRect part{60, 30, 20, 10};
  const TileBins bins = bin_cells(*frame_, order_, scene_.image, part);
  const RenderStatistics met = draw({part, false}).statistics;
  EXPECT_EQ(bins.tiles.size(), 4U);
  EXPECT_EQ(met.segments, bins.ranks.size());
  EXPECT_EQ(met.violations, 4U);
  EXPECT_EQ(met.covered_pixels, 130U);  // thirteen of the columns 60 to 79
  EXPECT_NEAR(met.mean_optical_depth, std::log(4.0), 1e-14);
  EXPECT_EQ(met.largest_optical_depth, -std::log(0.25));
}

TEST_F(PictureTest, TellsTheDepthOfTheMediumWithoutSkinAndEdges) {
  surfaces_ = 0.5;
  const RenderStatistics seen = draw({whole_picture(scene_.image), false}).statistics;
  EXPECT_NEAR(seen.mean_optical_depth, std::log(2.0), 1e-12);
  EXPECT_EQ(seen.depth_pixels, seen.covered_pixels);
  surfaces_ = 1e-4;  // hides the medium
  EXPECT_EQ(draw({whole_picture(scene_.image), false}).statistics.depth_pixels, 0U);
}

}  // namespace
}  // namespace hiac

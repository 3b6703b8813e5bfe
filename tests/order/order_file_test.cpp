#include "hiac/order/order_file.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

class OrderFile : public testing::Test {
 protected:
  OrderFile() { std::filesystem::create_directories(folder_); }
  ~OrderFile() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                  ("hiac_order_file." + std::to_string(getpid()) + "." +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

OrderRecord some_record() {
  OrderRecord record{std::string(32, 'a'), std::string(32, 'b'), {}};
  record.order.cells = std::vector<CellId>{3, 1, 6, 0, 2, 5, 4};
  record.order.groups = std::vector<CellGroup>{{1, 2}, {4, 3}};
  record.order.algorithm = "exact";
  return record;
}

Bytes payload_of(const OrderRecord& record) {
  const ExtraChunk chunk = encode_order(record);
  return {chunk.payload.begin(), chunk.payload.end()};
}

OrderRecord decoded(Bytes payload) {
  return decode_order({kOrderChunk, std::move(payload)}, "x.order");
}

void expect_equal(const OrderRecord& a, const OrderRecord& b) {
  EXPECT_EQ(a.mesh_hash, b.mesh_hash);
  EXPECT_EQ(a.view_hash, b.view_hash);
  EXPECT_EQ(a.order.algorithm, b.order.algorithm);
  EXPECT_TRUE(std::ranges::equal(a.order.cells, b.order.cells));
  EXPECT_TRUE(std::ranges::equal(a.order.groups, b.order.groups));
}

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

template <typename T>
Bytes with(Bytes payload, std::size_t offset, T value) {
  std::memcpy(payload.data() + offset, &value, sizeof value);
  return payload;
}

TEST_F(OrderFile, RoundTrip) {
  OrderRecord empty = some_record();
  empty.order.cells = std::vector<CellId>{};
  empty.order.groups = std::vector<CellGroup>{};
  OrderRecord even = some_record();  // cells that fill their part of the chunk to its last byte
  std::vector<CellId> cells(16);
  for (CellId cell = 0; cell < 16; ++cell) cells[cell] = 15 - cell;
  even.order.cells = std::move(cells);
  for (const OrderRecord& record : {some_record(), empty, even}) {
    expect_equal(decoded(payload_of(record)), record);
    write_order_file(path("a.order"), record);
    expect_equal(read_order_file(path("a.order")), record);
  }
}

// Orders of several views, told apart by their heads.
TEST_F(OrderFile, OfSeveralViews) {
  const std::string views[] = {std::string(32, 'b'), std::string(32, 'c'), std::string(32, 'd')};
  std::size_t written = 0;
  write_order_file(path("a.order"), [&]() -> std::optional<OrderRecord> {
    if (written == 3) return std::nullopt;
    OrderRecord record = some_record();
    record.view_hash = views[written++];
    return record;
  });
  const std::vector<ExtraChunk> chunks = read_order_chunks(path("a.order"));
  ASSERT_EQ(chunks.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const OrderHead head = decode_order_head(chunks[i], "x.order");
    EXPECT_EQ(head.view_hash, views[i]);
    EXPECT_EQ(head.mesh_hash, some_record().mesh_hash);
    EXPECT_EQ(head.algorithm, "exact");
    EXPECT_EQ(head.cell_count, 7U);
    EXPECT_EQ(head.group_count, 2U);
    EXPECT_EQ(decode_order(chunks[i], "x.order").view_hash, views[i]);
  }
  EXPECT_THAT(error_of([&] { read_order_file(path("a.order")); }),
              HasSubstr("several views (one expected, 3 found)"));
}

TEST_F(OrderFile, AFailureWhileItIsWrittenLeavesNothing) {
  const auto fail = [&, first = true]() mutable -> std::optional<OrderRecord> {
    if (!std::exchange(first, false)) throw InputError("second order", "is missing");
    return some_record();
  };
  EXPECT_THAT(error_of([&] { write_order_file(path("a.order"), fail); }), HasSubstr("second"));
  EXPECT_TRUE(std::filesystem::is_empty(std::filesystem::path(path("a.order")).parent_path()));
}

TEST_F(OrderFile, BehindAMesh) {
  ZooFile file{structured(1, Cut::tetrahedra), {encode_order(some_record())}};
  write_zoo_file(path("mesh.zoo"), file);
  expect_equal(read_order_file(path("mesh.zoo")), some_record());
  file.extras.clear();
  write_zoo_file(path("mesh.zoo"), file);
  EXPECT_THAT(error_of([&] { read_order_file(path("mesh.zoo")); }),
              HasSubstr("no visibility order"));
}

TEST_F(OrderFile, EveryTruncationIsRefused) {
  write_order_file(path("a.order"), some_record());
  std::ifstream in(path("a.order"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    std::ofstream(path("b.order"), std::ios::binary) << bytes.substr(0, size);
    ASSERT_NE(error_of([&] { read_order_file(path("b.order")); }), "no error") << size;
  }
}

TEST_F(OrderFile, EveryFlippedBitIsRefused) {
  write_order_file(path("a.order"), some_record());
  std::ifstream in(path("a.order"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += 11) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    std::ofstream(path("b.order"), std::ios::binary) << flipped;
    ASSERT_NE(error_of([&] { read_order_file(path("b.order")); }), "no error") << bit;
  }
}

TEST_F(OrderFile, NoSuchFile) {
  EXPECT_THAT(error_of([&] { read_order_file(path("none.order")); }), HasSubstr("none.order"));
}

// A payload whose checksum is right and whose content is not.
TEST_F(OrderFile, TruncatedPayloads) {
  const Bytes payload = payload_of(some_record());
  for (std::size_t size = 0; size < payload.size(); ++size)
    ASSERT_THROW(decoded({payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(size)}),
                 InputError)
        << size;
  Bytes longer = payload;
  longer.push_back(0);
  EXPECT_THROW(decoded(longer), InputError);
}

TEST_F(OrderFile, ImpossibleContent) {
  const Bytes good = payload_of(some_record());
  constexpr std::size_t kCells = 128, kGroups = 128 + 64;
  const auto message = [](const Bytes& payload) { return error_of([&] { decoded(payload); }); };
  EXPECT_THAT(message(with(good, 0, std::uint32_t{2})), HasSubstr("version"));
  for (const std::uint64_t count :
       {std::uint64_t{6}, std::uint64_t{17}, ~std::uint64_t{0}, std::uint64_t{1} << 62}) {
    EXPECT_THAT(message(with(good, 8, count)), HasSubstr("x.order")) << count;
    EXPECT_THAT(message(with(good, 16, count)), HasSubstr("wrong size")) << count;
  }
  EXPECT_THAT(message(with(good, kCells, CellId{7})), HasSubstr("unknown"));
  EXPECT_THAT(message(with(good, kCells, kNoCell)), HasSubstr("unknown"));
  EXPECT_THAT(message(with(good, kCells, CellId{1})), HasSubstr("twice"));
  for (const CellGroup group : {CellGroup{1, 0}, {1, 1}, {1, 4}, {1, ~0U}, {~0U, 2}, {~0U, ~0U}})
    EXPECT_THAT(message(with(good, kGroups, group)), HasSubstr("impossible group")) << group.first;
  EXPECT_THAT(message(with(good, kGroups + sizeof(CellGroup), CellGroup{5, 3})),
              HasSubstr("impossible group"));
}

TEST_F(OrderFile, MessagesSayWhatIsExpected) {
  const Bytes good = payload_of(some_record());
  const auto message = [](const Bytes& payload) { return error_of([&] { decoded(payload); }); };
  EXPECT_EQ(message(Bytes(127)),
            "x.order: chunk ORDER is too short (at least 128 bytes expected, 127 found)");
  EXPECT_EQ(message(Bytes(128)), "x.order: unknown version of chunk ORDER (1 expected, 0 found)");
  EXPECT_EQ(message(with(Bytes(128), 0, std::uint32_t{1})), "no error");  // of no cell
  EXPECT_EQ(message(with(good, 8, std::uint64_t{17})),
            "x.order: chunk ORDER has a wrong size for 17 cells and 2 groups (208 bytes found)");
  EXPECT_EQ(message(with(good, 16, std::uint64_t{1})),
            "x.order: chunk ORDER has a wrong size for 7 cells and 1 groups (208 bytes found)");
  EXPECT_EQ(message(with(good, 128, CellId{7})), "x.order: not an order: cell 7 of 7 is unknown");
  EXPECT_EQ(message(with(good, 132, CellId{3})),
            "x.order: not an order: cell 3 of 7 is there twice");
  EXPECT_EQ(message(with(good, 192, CellGroup{2, 3})),
            "x.order: not an order: impossible group (3 cells from 4)");
  EXPECT_EQ(message(with(good, 192, CellGroup{2, 2})), "no error");
  EXPECT_EQ(message(with(good, 192, CellGroup{1, 1})),
            "x.order: not an order: impossible group (1 cells from 1)");
  EXPECT_EQ(message(with(good, 200, CellGroup{5, 3})),
            "x.order: not an order: impossible group (3 cells from 5)");
}

TEST_F(OrderFile, NamesOfAlgorithmsHave40Letters) {
  OrderRecord record = some_record();
  record.order.algorithm = std::string(40, 'x');
  EXPECT_EQ(decoded(payload_of(record)).order.algorithm, std::string(40, 'x'));
  record.order.algorithm = std::string(41, 'x');
  EXPECT_EQ(decoded(payload_of(record)).order.algorithm, std::string(40, 'x'));
}

// Any change of the payload gives an error or an order of cells that is one.
TEST_F(OrderFile, RandomChanges) {
  const Bytes good = payload_of(some_record());
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    Bytes changed = good;
    for (std::uint64_t k = 1 + random() % 4; k > 0; --k)
      changed[random() % changed.size()] = static_cast<std::uint8_t>(random());
    try {
      const OrderRecord record = decoded(changed);
      std::vector<CellId> cells(record.order.cells.begin(), record.order.cells.end());
      std::ranges::sort(cells);
      for (CellId cell = 0; cell < cells.size(); ++cell) ASSERT_EQ(cells[cell], cell);
      for (const CellGroup& group : record.order.groups)
        ASSERT_LE(std::uint64_t{group.first} + group.count, cells.size());
    } catch (const InputError& error) {
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace hiac::test

// Binary files of solvers and their viewers, written here byte by byte after the formats' guides.
#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Numbers one after the other.
class Bytes {
 public:
  explicit Bytes(bool swapped = false) : swapped_(swapped) {}
  template <typename Number>
  Bytes& put(Number value) {
    char raw[sizeof(Number)];
    std::memcpy(raw, &value, sizeof value);
    if (swapped_) std::reverse(std::begin(raw), std::end(raw));
    text_.append(raw, sizeof raw);
    return *this;
  }
  Bytes& whole(std::int32_t value) { return put(value); }
  Bytes& wholes(std::initializer_list<std::int32_t> values) {
    for (const std::int32_t value : values) put(value);
    return *this;
  }
  Bytes& real(double value) { return put(value); }
  Bytes& mark(float value) { return put(value); }
  Bytes& raw(const std::string& text) {
    text_ += text;
    return *this;
  }
  /// Tecplot's texts: an integer a character.
  Bytes& text(const std::string& text) {
    for (const char c : text) whole(c);
    return whole(0);
  }
  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  bool swapped_;
  std::string text_;
};

// ---- Tecplot

struct TecplotOptions {
  int version = 112;
  bool swapped = false;
  bool by_points = false;
};

/// A brick zone of two bricks, x y z p on nodes and c on cells, and a second zone at a later time
/// that shares the coordinates and the elements.
std::string tecplot_bricks(const TecplotOptions& options) {
  Bytes out(options.swapped);
  out.raw(fmt::format("#!TDV{}", options.version)).whole(1);
  if (options.version > 108) out.whole(0);
  out.text("two bricks").whole(5);
  for (const char* name : {"X", "Y", "Z", "p", "c"}) out.text(name);
  for (const double time : {1.0, 2.5}) {
    out.mark(299).text(time == 1.0 ? "early" : "late").wholes({-1, 1}).real(time).wholes({-1, 5});
    if (options.version < 112) out.whole(options.by_points ? 1 : 0);
    if (options.by_points)
      out.whole(0);
    else
      out.wholes({1, 0, 0, 0, 0, 1});
    out.wholes({0, 0, 12, 2, 0, 0, 0});
    out.whole(1).text("note").whole(0).text("auxiliary").whole(0);
  }
  out.mark(799).text("key").whole(0).text("value").mark(357);
  const auto coordinate = [](int c, int node) {
    return c == 0 ? node % 3 : c == 1 ? node / 3 % 2 : node / 6;
  };
  for (const int zone : {0, 1}) {
    out.mark(299).wholes({2, 1, 2, 1, 2}).whole(0);
    const bool shares = zone == 1 && !options.by_points;
    out.whole(shares ? 1 : 0);
    if (shares) out.wholes({0, 0, 0, -1, -1});
    out.whole(shares ? 0 : -1);
    for (int v = shares ? 3 : 0; v < 5; ++v) out.real(0).real(1);
    const auto value = [&](int v, int i) {
      if (v < 3) return static_cast<double>(coordinate(v, i));
      return v == 3 ? 10.0 * zone + i : 100.0 * zone + i;
    };
    const auto put = [&](int v, int i) {
      if (v == 1 || v == 3)
        out.mark(static_cast<float>(value(v, i)));
      else
        out.real(value(v, i));
    };
    if (options.by_points)
      for (int node = 0; node < 12; ++node)
        for (int v = 0; v < 5; ++v) put(v, node);
    for (int v = shares ? 3 : 0; v < 5 && !options.by_points; ++v)
      for (int i = 0; i < (v == 4 ? 2 : 12); ++i) put(v, i);
    if (!shares)
      for (const int first : {0, 1})
        for (const int step : {0, 1, 4, 3, 6, 7, 10, 9}) out.whole(first + step);
  }
  return out.str();
}

TEST(TecplotBinary, BricksOfTwoTimesAreRead) {
  const ScratchFolder folder;
  for (const bool swapped : {false, true})
    for (const int version : {108, 111, 112}) {
      const std::string path = folder.write("b.plt", tecplot_bricks({version, swapped, false}));
      const ZooMesh late = read_any(path).mesh;
      ASSERT_EQ(late.cell_count(), 2U);
      EXPECT_EQ(late.node_count(), 12U);
      ASSERT_EQ(late.fields.size(), 2U);
      EXPECT_EQ(late.fields[0].values[11], 10 + 11);
      EXPECT_THAT(late.fields[1].values.view(), ElementsAre(100, 101));
      EXPECT_EQ(late.position(late.cell_nodes(1)[6])[0], 2);
      ReadOptions options;
      options.time = 1;
      EXPECT_THAT(read_any(path, options).mesh.fields[1].values.view(), ElementsAre(0, 1));
    }
}

TEST(TecplotBinary, OldFilesMayBePackedPointByPoint) {
  const ScratchFolder folder;
  const std::string path = folder.write("p.plt", tecplot_bricks({108, false, true}));
  const ZooMesh mesh = read_any(path).mesh;
  EXPECT_EQ(mesh.cell_count(), 2U);
  EXPECT_EQ(mesh.fields[0].values[3], 13);
}

TEST(TecplotBinary, CellValuesOfOrderedZonesArePadded) {
  Bytes out;
  out.raw("#!TDV112").wholes({1, 0}).text("t").whole(4);
  for (const char* name : {"X", "Y", "Z", "c"}) out.text(name);
  out.mark(299).text("z").wholes({-1, -1}).real(0).wholes({-1, 0, 1, 0, 0, 0, 1, 0, 0, 3, 3, 2, 0});
  out.mark(357).mark(299).wholes({2, 2, 2, 3, 0, 0, -1});
  for (int i = 0; i < 8; ++i) out.real(0);
  for (const int c : {0, 1, 2})
    for (int n = 0; n < 18; ++n) out.real(c == 0 ? n % 3 : c == 1 ? n / 3 % 3 : n / 9);
  for (int n = 0; n < 9; ++n) out.whole(n);  // the cells at i = 2 and j = 2 are not there
  const ScratchFolder folder;
  const ZooMesh mesh = read_any(folder.write("o.plt", out.str())).mesh;
  EXPECT_EQ(mesh.cell_count(), 4U);
  EXPECT_THAT(mesh.fields.at(0).values.view(), ElementsAre(0, 1, 3, 4));
}

TEST(TecplotBinary, DamagedFilesAreRefused) {
  const ScratchFolder folder;
  const std::string whole = tecplot_bricks({});
  for (std::size_t length = 8; length < whole.size(); length += 41)
    EXPECT_NE(refusal(folder.write("cut.plt", whole.substr(0, length))), "") << length;
  EXPECT_THAT(refusal(folder.write("v.plt", "#!TDV075" + whole.substr(8))),
              HasSubstr("a version from 107 to 112 expected"));
  for (std::size_t at = 8; at < whole.size(); at += 36) {
    std::string changed = whole;
    changed[at + 3] = '\x7f';
    static_cast<void>(refusal(folder.write("d.plt", changed)));  // refused or read, not more
  }
}

}  // namespace
}  // namespace hiac::formats

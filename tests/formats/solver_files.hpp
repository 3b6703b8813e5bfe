#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace hiac::formats {

// Binary files of Tecplot and LS-DYNA, byte by byte after the formats' guides.

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
inline std::string tecplot_bricks(const TecplotOptions& options) {
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
  out.mark(799).text("key").whole(0).text("value");
  out.mark(599).whole(2).text("inlet").text("outlet").mark(699).text("a user's record");
  out.mark(899).whole(3).text("key").whole(0).text("value").mark(357);
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

/// Two zones of two tetrahedra over one face, the second with the first one's faces and nodes, and
/// a zone of a polygon.
inline std::string tecplot_polyhedra(bool swapped) {
  Bytes out(swapped);
  out.raw("#!TDV112").wholes({1, 0}).text("polyhedra").whole(4);
  for (const char* name : {"X", "Y", "Z", "c"}) out.text(name);
  const auto head = [&](const char* name, std::initializer_list<std::int32_t> sizes) {
    out.mark(299).text(name).wholes({-1, -1}).real(0).whole(-1).wholes(sizes);
  };
  for (const char* name : {"p", "q"})
    head(name, {7, 1, 0, 0, 0, 1, 0, 0, 5, 7, 21, 2, 1, 2, 0, 0, 0, 0});
  head("flat", {6, 1, 0, 0, 0, 1, 0, 0, 3, 3, 6, 0, 0, 1, 0, 0, 0, 0});
  out.mark(357);
  const auto reals = [&](const std::vector<double>& numbers) {
    for (const double x : numbers) out.real(x);
  };
  out.mark(299).wholes({2, 2, 2, 2, 0, 0, -1});
  reals({0, 1, 0, 1, 0, 1, 7, 8});
  reals({0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1, 7, 8});
  out.wholes({0, 3, 6, 9, 12, 15, 18, 21});
  out.wholes({0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 1, 2, 4, 2, 3, 4, 1, 4, 3});
  out.wholes({0, 0, 0, 0, 1, 1, 1}).wholes({-1, -1, 1, -1, -1, -2, -1});
  out.wholes({0, 0, 1, 0, 0});
  out.mark(299).wholes({2, 2, 2, 2, 0, 1, 0, 0, 0, -1, 0});
  reals({17, 18, 17, 18});
  out.mark(299).wholes({2, 2, 2, 2, 0, 0, -1});
  reals({0, 1, 0, 1, 0, 0, 9, 9, 0, 1, 0, 0, 0, 1, 0, 0, 0, 9});
  out.wholes({0, 1, 1, 2, 2, 0}).wholes({0, 0, 0}).wholes({-1, -1, -1});
  return out.str();
}

// ---- LS-DYNA

/// Numbers as words of 4 or 8 bytes.
class WordsOut {
 public:
  WordsOut(bool wide, bool swapped) : wide_(wide), out_(swapped) {}
  void integer(std::int64_t value) {
    if (wide_)
      out_.put(value);
    else
      out_.put(static_cast<std::int32_t>(value));
  }
  void real(double value) {
    if (wide_)
      out_.put(value);
    else
      out_.put(static_cast<float>(value));
  }
  void text(const std::string& text) { out_.raw(text); }
  [[nodiscard]] const std::string& str() const { return out_.str(); }

 private:
  bool wide_;
  Bytes out_;
};

struct Model {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 8>> solids;
  std::vector<std::array<int, 8>> thick_shells;
  std::vector<std::array<int, 2>> more;  ///< of tetrahedra of ten nodes
  bool shell = true;                     ///< a shell beside the solids, with values of its own
  bool numbers = true;                   ///< users' numbers of nodes and elements
};

/// A unit brick, a prism, a pyramid and a tetrahedron upon and beside it.
inline Model linear_model() {
  Model model;
  model.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},     {0, 0, 1}, {1, 0, 1},
                  {1, 1, 1}, {0, 1, 1}, {2, 0, 0}, {0.5, 0.5, 2}, {2, 1, 0}, {3, 0.5, 0.5}};
  // a prism's edge over its quadrilateral 1 2 3 4 is 5 7, each twice
  model.solids = {{1, 2, 3, 4, 5, 6, 7, 8},
                  {2, 6, 7, 3, 9, 9, 11, 11},
                  {5, 6, 7, 8, 10, 10, 10, 10},
                  {9, 11, 12, 7, 7, 7, 7, 7}};
  return model;
}

inline std::string d3plot_geometry(const Model& model, bool wide, bool swapped) {
  WordsOut out(wide, swapped);
  out.text(std::string(10 * (wide ? 8 : 4), ' '));
  std::array<std::int64_t, 64> control{};
  const bool ten = !model.more.empty();
  const auto solids = static_cast<std::int64_t>(model.solids.size());
  control[11] = 1;
  control[15] = 4;
  control[16] = static_cast<std::int64_t>(model.points.size());
  control[18] = 2;
  control[19] = 1;
  control[20] = control[21] = 1;
  control[23] = ten ? -solids : solids;
  control[24] = 1;
  control[27] = 8;
  control[31] = model.shell ? 1 : 0;
  control[32] = model.shell ? 1 : 0;
  control[33] = model.shell ? 3 : 0;
  control[34] = 1;  // of the values of a solid, those beyond stress and plastic strain
  control[36] = -10001;
  const std::int64_t shells = model.shell ? 1 : 0;
  const auto thick_shells = static_cast<std::int64_t>(model.thick_shells.size());
  const std::int64_t numbered = control[16] + solids + shells + thick_shells;
  control[39] = model.numbers ? 10 + numbered : 0;
  control[40] = thick_shells;
  control[41] = model.thick_shells.empty() ? 0 : 1;
  control[42] = model.thick_shells.empty() ? 0 : 7;
  for (std::size_t w = 10; w < 64; ++w) {
    if (w == 14)
      out.real(971);  // the version, which alone of these is no integer
    else
      out.integer(control[w]);
  }
  for (const auto& point : model.points)
    for (const double x : point) out.real(x);
  for (const auto& solid : model.solids) {
    for (const int node : solid) out.integer(node);
    out.integer(1);
  }
  for (const auto& brick : model.thick_shells) {
    for (const int node : brick) out.integer(node);
    out.integer(3);
  }
  if (model.shell)
    for (const int word : {1, 2, 3, 4, 2}) out.integer(word);
  // users' numbers: where the parts begin in memory, how many there are, and they
  if (model.numbers) {
    for (const std::int64_t word :
         {0L, 0L, 0L, 0L, 0L, control[16], solids, 0L, shells, thick_shells})
      out.integer(word);
    for (std::int64_t n = 0; n < numbered; ++n) out.integer(100 + n);
  }
  for (const auto& more : model.more)
    for (const int node : more) out.integer(node);
  out.real(-999999);
  out.integer(90001);
  out.integer(1);
  out.integer(7);
  out.text(std::string(72, 'p'));
  out.real(-999999);
  return out.str();
}

/// A state at `time`: temperature x + time, coordinates moved by time along z, velocity 3 x.
inline std::string d3plot_state(const Model& model, double time, bool wide, bool swapped) {
  WordsOut out(wide, swapped);
  for (const double word : {time, 0.0, 0.0}) out.real(word);
  for (const auto& p : model.points)
    for (const double x : {p[0], p[1], p[2] + time}) out.real(x);
  for (const auto& p : model.points) out.real(p[0] + time);
  for (const auto& p : model.points)
    for (const double x : p) out.real(3 * x);
  for (std::size_t s = 0; s < model.solids.size(); ++s)
    for (int v = 0; v < 8; ++v) out.real(10.0 * static_cast<double>(s) + v + time);
  for (std::size_t v = 0; v < 7 * model.thick_shells.size(); ++v) out.real(-2);
  for (int v = 0; v < 3 && model.shell; ++v) out.real(-1);
  // the last solid is deleted from time 2 on
  for (std::size_t s = 0; s < model.solids.size(); ++s)
    out.real(time >= 2 && s + 1 == model.solids.size() ? 0 : 1);
  for (std::size_t s = 0; s < model.thick_shells.size(); ++s) out.real(time >= 3 ? 0 : 3);
  if (model.shell) out.real(2);
  return out.str();
}

inline std::string end_of_states(bool wide, bool swapped) {
  WordsOut out(wide, swapped);
  out.real(-999999);
  for (int n = 0; n < 20; ++n) out.real(0);
  return out.str();
}

}  // namespace hiac::formats

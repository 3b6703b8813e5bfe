// PLOT3D in every dialect: the same two blocks written in each of them are read as the same mesh.
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

struct Dialect {
  bool text;
  bool marks;
  bool big;
  bool wide;  ///< double precision
  bool several;
  bool blanked;
  bool planes;
};

/// Writes numbers in a dialect, in records.
class Writer {
 public:
  explicit Writer(const Dialect& dialect) : dialect_(dialect) {}

  void whole(std::int32_t value) {
    if (dialect_.text)
      text_ += fmt::format("{} ", value);
    else
      put(value);
  }
  void real(double value) {
    if (dialect_.text)
      text_ += fmt::format("{} ", value);
    else if (dialect_.wide)
      put(value);
    else
      put(static_cast<float>(value));
  }
  void end_record() {
    if (dialect_.text) {
      text_ += record_ + "\n";
    } else if (dialect_.marks) {
      const std::string data = std::exchange(record_, {});
      put(static_cast<std::int32_t>(data.size()));
      const std::string mark = std::exchange(record_, {});
      text_ += mark + data + mark;
    } else {
      text_ += record_;
    }
    record_.clear();
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  template <typename T>
  void put(T value) {
    std::array<char, sizeof value> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    if (dialect_.big) std::reverse(bytes.begin(), bytes.end());
    record_.append(bytes.data(), bytes.size());
  }

  Dialect dialect_;
  std::string record_;
  std::string text_;
};

constexpr std::array<std::array<int, 3>, 2> kBlocks{{{3, 4, 2}, {2, 3, 3}}};

double coordinate(int axis, int block, int i, int j, int k) {
  return axis == 0 ? 10 * block + i : axis == 1 ? 2 * j : 3 * k;
}

/// A function of the place, and so of the point however it is stored.
double variable(int v, int block, int i, int j, int k) {
  return v + 8 * i + 64 * j + 512 * (k + block);
}

void write_header(Writer& out, const Dialect& dialect, int further) {
  const int blocks = dialect.several ? 2 : 1;
  if (dialect.several) {
    out.whole(blocks);
    out.end_record();
  }
  for (int b = 0; b < blocks; ++b) {
    for (const int extent : kBlocks[std::size_t(b)]) out.whole(extent);
    if (further > 0) out.whole(further);
  }
  out.end_record();
}

/// Columns of reals, and IBLANK where `blank` says so, whole or plane by plane.
template <typename Value>
void write_data(Writer& out, const Dialect& dialect, int block, int columns, bool blank,
                const Value& value) {
  const auto [ni, nj, nk] = kBlocks[std::size_t(block)];
  for (int first = 0; first < nk; first += dialect.planes ? 1 : nk) {
    const int last = dialect.planes ? first + 1 : nk;
    for (int c = 0; c < columns + (blank ? 1 : 0); ++c)
      for (int k = first; k < last; ++k)
        for (int j = 0; j < nj; ++j)
          for (int i = 0; i < ni; ++i) {
            if (c < columns)
              out.real(value(c, i, j, k));
            else
              out.whole(i == 0 && j == 0 && k == 0 && block == 0 ? 0 : 1);
          }
    out.end_record();
  }
}

void write_files(const ScratchFolder& folder, const Dialect& dialect) {
  Writer grid(dialect);
  Writer q(dialect);
  Writer function(dialect);
  write_header(grid, dialect, 0);
  write_header(q, dialect, 0);
  write_header(function, dialect, 2);
  for (int b = 0; b < (dialect.several ? 2 : 1); ++b) {
    write_data(grid, dialect, b, 3, dialect.blanked,
               [b](int c, int i, int j, int k) { return coordinate(c, b, i, j, k); });
    for (int n = 0; n < 4; ++n) q.real(n);
    q.end_record();
    const auto values = [b](int c, int i, int j, int k) { return variable(c, b, i, j, k); };
    write_data(q, dialect, b, 5, false, values);
    write_data(function, dialect, b, 2, false, values);
  }
  (void)folder.write("grid.x", grid.text());
  (void)folder.write("grid.q", q.text());
  (void)folder.write("grid.f", function.text());
}

void expect_mesh(const ZooMesh& mesh, const Dialect& dialect) {
  const std::size_t hidden = dialect.blanked ? 1 : 0;
  ASSERT_EQ(mesh.cell_count(), (dialect.several ? 6U + 4U : 6U) - hidden);
  const Field momentum = scalar_field(mesh, "Momentum:y");
  const Field second = scalar_field(mesh, "Function1");
  for (NodeId node = 0; node < mesh.node_count(); ++node) {
    const auto p = mesh.position(node);
    const int block = p[0] >= 10 ? 1 : 0;
    const int i = static_cast<int>(p[0]) % 10;
    const int j = static_cast<int>(p[1]) / 2;
    const int k = static_cast<int>(p[2]) / 3;
    EXPECT_EQ(momentum.values[node], variable(2, block, i, j, k));
    EXPECT_EQ(second.values[node], variable(1, block, i, j, k));
  }
}

TEST(Plot3d, EveryDialectIsTheSameMesh) {
  const ScratchFolder folder;
  std::size_t tried = 0;
  for (unsigned bits = 0; bits < 128; ++bits) {
    const auto bit = [bits](unsigned b) { return (bits >> b & 1U) != 0; };
    const Dialect dialect{bit(0), bit(1), bit(2), bit(3), bit(4), bit(5), bit(6)};
    // a text has neither bytes nor records, and planes cannot be told without records
    if (dialect.text && (dialect.marks || dialect.big || dialect.wide)) continue;
    if (dialect.planes && !dialect.marks) continue;
    SCOPED_TRACE(bits);
    write_files(folder, dialect);
    ASSERT_EQ(format_to_read(folder.file("grid.x")).name, "plot3d");
    expect_mesh(read_any(folder.file("grid.x")).mesh, dialect);
    ++tried;
  }
  EXPECT_EQ(tried, 4U + 16U + 32U);
}

TEST(Plot3d, FilesNamedByWhatTheyHoldLieBesideTheGrid) {
  const ScratchFolder folder;
  const Dialect dialect{false, true, false, false, true, false, false};
  write_files(folder, dialect);
  for (const auto& [from, to] :
       {std::pair("grid.x", "wing_xyz.bin"), std::pair("grid.q", "wing_q.bin"),
        std::pair("grid.f", "wing_f.bin")})
    std::filesystem::rename(folder.file(from), folder.file(to));
  expect_mesh(read_any(folder.file("wing_xyz.bin")).mesh, dialect);
}

TEST(Plot3d, TruncatedFilesAreRefused) {
  const ScratchFolder folder;
  for (const bool marks : {false, true}) {
    write_files(folder, {false, marks, false, false, true, false, false});
    for (const std::string name : {"grid.x", "grid.q", "grid.f"}) {
      const std::string text = text_of(folder.file(name));
      for (std::size_t length = 0; length < text.size(); length += 29) {
        (void)folder.write(name, text.substr(0, length));
        EXPECT_FALSE(refusal(folder.file("grid.x")).empty()) << name << " cut to " << length;
      }
      (void)folder.write(name, text);
    }
  }
}

TEST(Plot3d, NumbersHaveOneSign) {
  const ScratchFolder folder;
  const auto refused = [&](const std::string& last) {
    return !refusal(folder.write(
                        "cube.x",
                        "2 2 2\n0 1 0 1 0 1 0 1\n0 0 1 1 0 0 1 1\n0 0 0 0 1 1 1 " + last + "\n"))
                .empty();
  };
  EXPECT_FALSE(refused("+1"));
  EXPECT_TRUE(refused("+-1"));
}

TEST(Plot3d, RepeatedValuesOfFortransListsAreRead) {
  const ScratchFolder folder;
  const std::string grid =
      folder.write("cube.x", "2 2 2\n0 1 0 1 0 1 0 1\n2*0. 2*1.D0 2*0 2*1\n4*0 4*1\n");
  const ZooMesh mesh = read_any(grid).mesh;
  ASSERT_EQ(mesh.cell_count(), 1U);
  EXPECT_EQ(mesh.position(6)[1], 1);
}

}  // namespace
}  // namespace hiac::formats

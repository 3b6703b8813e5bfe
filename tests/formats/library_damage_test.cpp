// Files cut off and files with changed bytes: a refusal of one line or a correct mesh, whatever the
// libraries make of them.
#include <random>

#include "hiac/base/error.hpp"
#include "tests/formats/files.hpp"
#ifdef HIAC_WITH_NETCDF
#  include "formats/exodus/classic_layout.hpp"
#endif

namespace hiac::formats {
namespace {

const std::vector<std::string> kFiles{
    "exodus/mixed/four-p.e",        "exodus/elements/read_exodus_HEX8.e",
    "med/xxModalMechanics001a.med", "cgns/cgnslib_vers-3210.cgns",
    "cgns/sqnz_s.adf.cgns",         "vtkhdf/can-vtu.hdf",
    "plot3d/tiny/tiny.xyz",         "mfem/tinyzoo-3d.mesh",
    "mfem/escher-p3.mesh",          "mfem/amr-hex.mesh"};

/// Reads; anything but a mesh, an InputError of one line or a UsageError fails the test.
void expect_refused_or_read(const std::string& path) {
  try {
    EXPECT_EQ(refusal(path).find('\n'), std::string::npos);
  } catch (const UsageError&) {
  }
}

TEST(LibraryDamage, TruncatedFilesAreRefusedOrRead) {
  const ScratchFolder folder;
  for (const std::string& name : kFiles) {
    const std::string path = data_dir() + "/" + name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const std::string text = text_of(path);
    const std::string extension = std::filesystem::path(path).extension().string();
    for (std::size_t part = 0; part < 6; ++part)
      expect_refused_or_read(
          folder.write("cut" + extension, text.substr(0, text.size() * part / 6)));
  }
}

TEST(LibraryDamage, ChangedBytesAreSurvived) {
  const ScratchFolder folder;
  const char* asked = std::getenv("HIAC_DAMAGE_FACTOR");
  const int trials = 8 * (asked == nullptr ? 1 : std::atoi(asked));
  std::mt19937 random(20240101);  // NOLINT(cert-msc51-cpp): the same files every time
  for (const std::string& name : kFiles) {
    const std::string path = data_dir() + "/" + name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const std::string text = text_of(path);
    const std::string extension = std::filesystem::path(path).extension().string();
    for (int trial = 0; trial < trials; ++trial) {
      std::string changed = text;
      for (std::size_t left = 1 + random() % 4; left > 0; --left) {
        // headers most of the time
        const std::size_t reach =
            random() % 3 == 0 ? changed.size() : std::min<std::size_t>(changed.size(), 8192);
        changed[random() % reach] = static_cast<char>(random() % 3 == 0 ? 255 : random() % 256);
      }
      expect_refused_or_read(folder.write("changed" + extension, changed));
    }
  }
}

#ifdef HIAC_WITH_NETCDF
// A header whose one variable, of no dimensions, lies behind the file's end.
TEST(LibraryDamage, NamesWithLineEndsAreShownInOneLine) {
  using namespace std::string_literals;
  const std::string header = "CDF\1"s + "\0\0\0\0"s + "\0\0\0\0\0\0\0\0"s + "\0\0\0\0\0\0\0\0"s +
                             "\0\0\0\x0b\0\0\0\1"s + "\0\0\0\3a\nb\0"s + "\0\0\0\0"s +
                             "\0\0\0\0\0\0\0\0"s + "\0\0\0\6\0\0\0\x08\0\0\x10\0"s;
  try {
    exodus::check_classic_layout(header, "x.e");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'a b'"));
  }
}
#endif

}  // namespace
}  // namespace hiac::formats

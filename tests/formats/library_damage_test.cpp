// Files cut off and files with changed bytes: a refusal of one line or a correct mesh, whatever the
// libraries make of them.
#include "hiac/base/error.hpp"
#include "tests/formats/damage.hpp"
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

/// Small sound files of the formats whose libraries' tests write none: two PLOT3D blocks, MFEM's
/// cells of several kinds, a refined brick, a VTKHDF file.
std::vector<std::string> own_files(const ScratchFolder& folder) {
  std::vector<std::string> files{
      folder.write("grid.x",
                   "2\n2 2 2\n3 2 2\n0 1 0 1 0 1 0 1\n0 0 1 1 0 0 1 1\n0 0 0 0 1 1 1 1\n"
                   "2 3 4 2 3 4 2 3 4 2 3 4\n0 0 0 1 1 1 0 0 0 1 1 1\n"
                   "0 0 0 0 0 0 1 1 1 1 1 1\n"),
      folder.write("kinds.mesh",
                   "MFEM mesh v1.0\n\ndimension\n3\n\nelements\n4\n7 5 0 1 2 3 4 5 6 7\n"
                   "2 7 4 5 6 7 8\n7 6 1 9 2 5 10 6\n2 4 9 11 2 10\n\nboundary\n0\n\nvertices\n"
                   "12\n3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n.5 .5 2\n"
                   "2 0 0\n2 0 1\n2 1 0\n"),
      folder.write("curved.mesh",
                   "MFEM mesh v1.0\n\ndimension\n3\n\nelements\n1\n1 4 0 1 2 3\n\nboundary\n0\n\n"
                   "vertices\n4\n\nnodes\nFiniteElementSpace\nFiniteElementCollection: Quadratic\n"
                   "VDim: 3\nOrdering: 1\n\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n.5 0 .1\n0 .5 .1\n0 0 .5\n"
                   ".5 .5 0\n.5 0 .5\n0 .5 .5\n"),
      folder.write("refined.mesh",
                   "MFEM NC mesh v1.0\n\ndimension\n3\n\nelements\n3\n0 4 5 1 1 2\n"
                   "0 4 5 0 0 8 9 3 4 10 11 7\n0 6 5 0 8 1 2 9 10 5 6 11\n\nboundary\n0\n\n"
                   "vertex_parents\n4\n8 0 1\n9 2 3\n10 4 5\n11 6 7\n\ncoordinates\n8\n3\n0 0 0\n"
                   "2 0 0\n2 1 0\n0 1 0\n0 0 1\n2 0 1\n2 1 1\n0 1 1\n")};
  for (const Format& format : all_formats())
    if (format.name == "vtkhdf") {
      files.push_back(folder.file("a.vtkhdf"));
      static_cast<void>(format.write(files.back(), read_any(files[1]).mesh));
    }
  return files;
}

/// Those, and what is there of the data folder.
std::vector<std::string> all_files(const ScratchFolder& folder) {
  std::vector<std::string> files = own_files(folder);
  for (const std::string& name : kFiles)
    if (std::filesystem::exists(data_dir() + "/" + name)) files.push_back(data_dir() + "/" + name);
  return files;
}

TEST(LibraryDamage, TheFilesAreSound) {
  const ScratchFolder folder;
  for (const std::string& path : own_files(folder)) EXPECT_EQ(refusal(path), "") << path;
}

TEST(LibraryDamage, TruncatedFilesAreRefusedOrRead) {
  const ScratchFolder folder;
  for (const std::string& path : all_files(folder))
    EXPECT_GE(expect_cuts_survived(path, 6), 3U) << path;
}

TEST(LibraryDamage, ChangedBytesAreSurvived) {
  const ScratchFolder folder;
  for (const std::string& path : all_files(folder)) expect_changes_survived(path, 8);
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

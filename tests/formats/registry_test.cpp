#include "formats/registry.hpp"

#include "tests/formats/complaints.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;

TEST(Registry, ContentDecidesBeforeTheName) {
  const ScratchFolder folder;
  const std::string legacy = folder.write("a.dat", "# vtk DataFile Version 3.0\n");
  EXPECT_EQ(format_to_read(legacy).name, "vtk");
  const std::string xml =
      folder.write("b.vtk",
                   "<?xml version='1.0'?>\n<!-- c -->\n<VTKFile header_type=\"UInt64\" "
                   "type=\"ImageData\">");
  EXPECT_EQ(format_to_read(xml).name, "vti");
}

TEST(Registry, UnknownContentIsRefused) {
  const ScratchFolder folder;
  const auto message = [](const std::string& path) {
    try {
      format_to_read(path);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(folder.write("a.vtu", "no XML")), HasSubstr("is not a vtu file"));
  EXPECT_THAT(message(folder.write("a.unheard", "nothing")), HasSubstr("unknown file format"));
  EXPECT_THAT(message(folder.write("empty.vtk", "")), HasSubstr("is empty"));
  EXPECT_THAT(message(folder.file("missing.vtk")), HasSubstr("cannot be opened"));
  EXPECT_THAT(message("/"), HasSubstr("is a directory"));
}

TEST(Registry, RefusalsTellWhatTheNameSays) {
  const std::string what =
      " file, although its name says so (neither this nor any other known format found in its "
      "first bytes)";
  expect_complaints("a.vtu",
                    {{"", ": is empty (a mesh expected)"}, {"x", ": is not a vtu" + what}});
  expect_complaints("a.NEU",
                    {{"", ": is empty (a mesh expected)"}, {"\n", ": is not a gambit" + what}});
  expect_complaints("a.stl", {{"x",
                               ": is the file of a surface (a mesh of cells with a volume "
                               "expected)"}});
  // b"nothing" by gzip
  const std::string packed(
      "\x1f\x8b\x08\0\0\0\0\0\2\3\xcb\xcb\x2f\xc9\xc8\xcc\x4b\7\0\xd7"
      "\x8e\x29\x22\7\0\0\0",
      27);
  for (const std::string name : {"a.vtu", "a.vtu.gz", "a.neu.gz", "a.gz"})
    expect_complaints(name,
                      {{packed, ": is packed by gzip, and what it holds is of no known format"}});
}

TEST(Registry, RefusalsOfUnknownNamesListTheFormats) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.unheard", "x");
  const std::string message = refusal(path);
  EXPECT_THAT(message, testing::StartsWith(path + ": unknown file format (one of zoo, "));
  EXPECT_THAT(message, testing::EndsWith(" expected)"));
  EXPECT_THAT(message, HasSubstr(", vtu, "));
  EXPECT_THAT(message, testing::Not(HasSubstr("stl")));
  try {
    format_to_write("a.vts");
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(),
                testing::StartsWith("a.vts: no format with the extension '.vts' can be written "
                                    "(expected one of zoo, "));
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("gambit")));
  }
  try {
    format_named("vtuu");
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("format vtuu: there is no such format (expected "
                                                  "one of zoo, "));
    EXPECT_THAT(error.what(), HasSubstr(", stl"));
  }
}

TEST(Registry, NamesAreChecked) {
  EXPECT_EQ(format_named("vtu").name, "vtu");
  EXPECT_THROW(format_named("vtuu"), UsageError);
  EXPECT_EQ(format_to_write("x.VTU").name, "vtu");
  EXPECT_THROW(format_to_write("x.vts"), UsageError);
  EXPECT_THROW(format_to_write("x"), UsageError);
}

}  // namespace
}  // namespace hiac::formats

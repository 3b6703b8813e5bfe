#include "formats/registry.hpp"

#include "tests/formats/files.hpp"

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

TEST(Registry, NamesAreChecked) {
  EXPECT_EQ(format_named("vtu").name, "vtu");
  EXPECT_THROW(format_named("vtuu"), UsageError);
  EXPECT_EQ(format_to_write("x.VTU").name, "vtu");
  EXPECT_THROW(format_to_write("x.vts"), UsageError);
  EXPECT_THROW(format_to_write("x"), UsageError);
}

}  // namespace
}  // namespace hiac::formats

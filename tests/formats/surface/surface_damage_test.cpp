// Damaged surfaces end in an InputError of one line, and never in this process.
#include <string>

#include <gmock/gmock.h>

#include "formats/surface/surface_file.hpp"
#include "hiac/base/error.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(SurfaceDamage, APlyHeaderWithoutElementsIsRefused) {
  const ScratchFolder folder;
  for (const char* header :
       {"ply\nformat ascii 1.0\nproperty float x\nend_header\n0 0 0\n",
        "ply\nformat ascii 1.0\nelemenT vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n",
        "ply\nformat binary_little_endian 1.0\nend_header\n"})
    EXPECT_THAT([&] { read_surface(folder.write("a.ply", header)); },
                ThrowsMessage<InputError>(HasSubstr("a.ply: ")));
}

void expect_refused(const std::string& path) {
  EXPECT_THAT([&] { read_surface(path); }, ThrowsMessage<InputError>(HasSubstr(path + ": ")));
}

TEST(SurfaceDamage, CountsThatAreOnlyAnnouncedTakeNoMemory) {
  const ScratchFolder folder;
  for (const auto& [name, text] :
       {std::pair<const char*, std::string>{"a.off", "OFF\n2000000000 4 0\n0 0 0\n"},
        {"b.off", "OFF\n3 2000000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n"},
        {"a.ply",
         "ply\nformat ascii 1.0\nelement vertex 2000000000\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n"},
        {"a.stl", std::string(80, ' ') + "\xff\xff\xff\x7f" + std::string(50, 'x')}})
    expect_refused(folder.write(name, text));
}

TEST(SurfaceDamage, NothingIsPrintedByTheLibrary) {
  const ScratchFolder folder;
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_THROW(read_surface(folder.write("a.off", "OFF\nx y z\n")), InputError);
  EXPECT_THROW(read_surface(folder.write("a.stl", "solid\nfacet\n")), InputError);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

std::string surface_complaint(const std::string& path) {
  try {
    read_surface(path);
  } catch (const InputError& error) {
    return std::string(error.what()).substr(path.size() + 2);
  }
  return "none";
}

TEST(SurfaceDamage, PolygonsHaveCornersThatThereAre) {
  const ScratchFolder folder;
  const auto said = [&](const std::string& faces) {
    return surface_complaint(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + faces));
  };
  EXPECT_EQ(said("f 1 2 3\n"), "none");
  EXPECT_EQ(said("f 1 2 4\n"), "none");
  EXPECT_EQ(said("f 1 2\n"), "a polygon of 2 corners (3 or more expected)");
  EXPECT_EQ(said("f 1 2 3\nf 4\n"), "a polygon of 1 corners (3 or more expected)");
  EXPECT_EQ(said("f 1 2 5\n"), "a polygon has corner 4 (less than 4 expected)");
  EXPECT_EQ(said(""), "is malformed (a surface of polygons expected)");
}

TEST(SurfaceDamage, CoordinatesAreFinite) {
  const ScratchFolder folder;
  const std::string one("\0\0\x80\x3f", 4);
  const std::string zero(4, '\0');
  const auto said = [&](const std::string& last) {
    return surface_complaint(folder.write(
        "a.stl", std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(12, '\0') + zero +
                     zero + zero + one + zero + zero + zero + one + last + std::string(2, '\0')));
  };
  EXPECT_EQ(said(one), "none");
  EXPECT_EQ(said(std::string("\0\0\xc0\x7f", 4)), "a coordinate of point 2 is not finite");
  EXPECT_EQ(said(std::string("\0\0\x80\xff", 4)), "a coordinate of point 2 is not finite");
}

TEST(SurfaceDamage, KindsOfFilesThatHoldSurfaces) {
  const ScratchFolder folder;
  EXPECT_EQ(
      surface_complaint(folder.write("a.step", "")),
      "unknown kind of surface (.stl, .ply, .obj, .off, .vtp, .vtu, .poly or .smesh expected)");
  for (const char* name : {"a.STL", "a.ply", "a.Obj", "a.off", "a.vtp", "a.poly", "a.smesh"}) {
    EXPECT_TRUE(is_surface_file(name)) << name;
    EXPECT_TRUE(may_hold_surface(name)) << name;
  }
  EXPECT_FALSE(is_surface_file("a.vtu"));
  EXPECT_TRUE(may_hold_surface("a.vtu"));
  EXPECT_FALSE(may_hold_surface("a.vtk"));
}

TEST(SurfaceDamage, BlocksOfBlocksAreReadToADepth) {
  const ScratchFolder folder;
  const auto nested = [](int depth) {
    std::string text =
        "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">"
        "<vtkMultiBlockDataSet>";
    for (int i = 0; i < depth; ++i) text += "<Block name=\"b\">";
    text += "<DataSet file=\"a.vtu\"/>";
    for (int i = 0; i < depth; ++i) text += "</Block>";
    return text + "</vtkMultiBlockDataSet></VTKFile>";
  };
  const auto read = [](const std::string& path) { return format_to_read(path).read(path, {}); };
  const std::string deep = folder.write("deep.vtm", nested(40'000));
  EXPECT_THAT([&] { read(deep); }, ThrowsMessage<InputError>(HasSubstr("nested too deeply")));
  const std::string shallow = folder.write("shallow.vtm", nested(50));
  EXPECT_THAT([&] { read(shallow); },
              ThrowsMessage<InputError>(HasSubstr("a.vtu: cannot be opened")));
}

}  // namespace
}  // namespace hiac::formats

// The boundary of a mesh, written to surface formats and read back.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include "formats/surface/surface_file.hpp"
#include "hiac/mesh/boundary_surface.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Position = std::array<double, 3>;
using Corners = std::multiset<std::array<Position, 3>>;

/// A tetrahedron's surface with a field of every sort; coordinates that need double precision.
BoundarySurface sample() {
  BoundarySurface surface;
  surface.xyz = {0, 0, 0, 2, 0, 0, 0, 3.1, 0, 0, 0, 4.5};
  surface.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const auto add = [&](const char* name, FieldLocation location, std::uint32_t components) {
    std::vector<double> values;
    for (std::uint32_t i = 0; i < 4 * components; ++i)
      values.push_back(std::sqrt(static_cast<double>(i + surface.fields.size())));
    surface.fields.push_back({name, "", location, components, std::move(values)});
  };
  add("heat flow", FieldLocation::node, 3);
  add("x", FieldLocation::node, 1);
  add("heat_flow_y", FieldLocation::node, 1);
  add("stress", FieldLocation::cell, 6);
  surface.averaged = {"x"};
  return surface;
}

template <typename At>
Corners corners_of(std::size_t count, const At& at) {
  Corners all;
  for (std::size_t t = 0; t < count; ++t) {
    std::array<Position, 3> triangle{at(t, 0), at(t, 1), at(t, 2)};
    std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
    all.insert(triangle);
  }
  return all;
}

Corners corners_of(const BoundarySurface& surface, bool single) {
  return corners_of(surface.triangles.size(), [&](std::size_t t, std::size_t k) {
    Position p{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = surface.xyz[3 * surface.triangles[t][k] + c];
      p[c] = single ? static_cast<double>(static_cast<float>(x)) : x;
    }
    return p;
  });
}

Corners corners_read(const std::string& path) {
  const Surface surface = read_surface(path).surface;
  return corners_of(surface.facets.size(), [&](std::size_t t, std::size_t k) {
    return surface.points[surface.facets[t].polygons[0][k]];
  });
}

TEST(BoundaryWriting, TrianglesAreReadBack) {
  const ScratchFolder folder;
  const BoundarySurface surface = sample();
  for (const char* extension : {".stl", ".ply", ".vtp"}) {
    SCOPED_TRACE(extension);
    const std::string path = folder.file(std::string("a") + extension);
    const Format& format = format_to_write(path);
    const std::vector<std::string> notes = format.write_boundary(path, surface);
    const bool single = extension == std::string(".stl");
    EXPECT_EQ(corners_read(path), corners_of(surface, single));
    EXPECT_THAT(notes, Contains(HasSubstr("cell corners of x became means")));
    if (!single) {
      EXPECT_EQ(notes.size(), 1U);
      continue;
    }
    EXPECT_EQ(text_of(path).size(), 84U + 4 * 50);
    EXPECT_THAT(notes, Contains(HasSubstr("moved by at most 9.5e-08")));
    EXPECT_THAT(notes, Contains(HasSubstr("no place for fields")));
  }
}

TEST(BoundaryWriting, StlHasNormalsAndRefusesWhatIsTooLarge) {
  const ScratchFolder folder;
  BoundarySurface surface = sample();
  surface.fields.clear();
  surface.xyz[7] = 3;
  const std::string path = folder.file("a.stl");
  EXPECT_THAT(format_to_write(path).write_boundary(path, surface), IsEmpty());
  const std::string bytes = text_of(path);
  const double length = std::sqrt(27.0 * 27 + 18 * 18 + 12 * 12);
  const std::array<std::array<double, 3>, 4> expected{
      {{0, 0, -1}, {0, -1, 0}, {27 / length, 18 / length, 12 / length}, {-1, 0, 0}}};
  for (std::size_t t = 0; t < expected.size(); ++t) {
    std::array<float, 3> normal{};
    std::memcpy(normal.data(), bytes.data() + 84 + 50 * t, sizeof normal);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(normal[c], expected[t][c], 1e-6);
  }
  surface.xyz[0] = 1e39;
  EXPECT_THROW(format_to_write(path).write_boundary(path, surface), InputError);
}

TEST(BoundaryWriting, PlyNamesThePropertiesOfItsFields) {
  const ScratchFolder folder;
  const BoundarySurface surface = sample();
  const std::string path = folder.file("a.ply");
  format_to_write(path).write_boundary(path, surface);
  const std::string text = text_of(path);
  const std::size_t data = text.find("end_header\n") + 11;
  EXPECT_EQ(text.substr(0, data),
            "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\n"
            "property double y\nproperty double z\nproperty double heat_flow_x\n"
            "property double heat_flow_y\nproperty double heat_flow_z\nproperty double x_2\n"
            "property double heat_flow_y_2\nelement face 4\n"
            "property list uchar int vertex_indices\nproperty double stress_0\n"
            "property double stress_1\nproperty double stress_2\nproperty double stress_3\n"
            "property double stress_4\nproperty double stress_5\nend_header\n");
  const auto number = [&](std::size_t at) {
    double value = 0;
    std::memcpy(&value, text.data() + data + at, sizeof value);
    return value;
  };
  constexpr std::size_t kVertex = 8 * 8, kFace = 1 + 3 * 4 + 6 * 8;
  ASSERT_EQ(text.size(), data + 4 * kVertex + 4 * kFace);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(number(i * kVertex + 8 * c), surface.xyz[3 * i + c]);
      EXPECT_EQ(number(i * kVertex + 24 + 8 * c), surface.fields[0].values[3 * i + c]);
    }
    EXPECT_EQ(number(i * kVertex + 48), surface.fields[1].values[i]);
    EXPECT_EQ(number(i * kVertex + 56), surface.fields[2].values[i]);
    for (std::size_t c = 0; c < 6; ++c)
      EXPECT_EQ(number(4 * kVertex + i * kFace + 13 + 8 * c), surface.fields[3].values[6 * i + c]);
  }
}

TEST(BoundaryWriting, VtkReadsTheFields) {
  const ScratchFolder folder;
  const BoundarySurface surface = sample();
  const std::string path = folder.file("a.vtp");
  format_to_write(path).write_boundary(path, surface);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData& data = *reader->GetOutput();
  EXPECT_EQ(data.GetNumberOfPoints(), 4);
  ASSERT_EQ(data.GetNumberOfPolys(), 4);
  EXPECT_EQ(data.GetNumberOfCells(), 4);
  for (const Field& field : surface.fields) {
    vtkDataSetAttributes* attributes = field.location == FieldLocation::node
                                           ? static_cast<vtkDataSetAttributes*>(data.GetPointData())
                                           : data.GetCellData();
    vtkDataArray* array = attributes->GetArray(field.name.c_str());
    ASSERT_NE(array, nullptr) << field.name;
    ASSERT_EQ(array->GetNumberOfValues(), static_cast<vtkIdType>(field.values.size()));
    for (std::size_t i = 0; i < field.values.size(); ++i)
      EXPECT_EQ(array->GetComponent(static_cast<vtkIdType>(i / field.components),
                                    static_cast<int>(i % field.components)),
                field.values[i]);
  }
}

TEST(BoundaryWriting, SurfacesAreNotReadAsMeshes) {
  const ScratchFolder folder;
  for (const char* name : {"a.stl", "a.ply", "a.vtp"}) {
    const std::string path = folder.file(name);
    format_to_write(path).write_boundary(path, sample());
    EXPECT_THAT([&] { format_to_read(path); },
                testing::ThrowsMessage<InputError>(HasSubstr("is the file of a surface")));
  }
}

}  // namespace
}  // namespace hiac::formats

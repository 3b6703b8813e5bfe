// What drivers make of the shaders' text and llvmpipe, which tests draw by, does not show.
#include "hiac/preview/exact_shaders.hpp"

#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/preview/preview_support.hpp"

namespace hiac {
namespace {

using preview::DrawnScene;
using preview::ExactVariant;

Scene with_surfaces() {
  Scene scene = test::benchmark_scene(Projection::perspective, 8, 8);
  scene.volume.color->field = "g";
  scene.isosurfaces.push_back({"g", 0.4, {}});
  scene.isosurfaces.push_back({"f", 0.6, {}});
  return scene;
}

// Lines that declare an array of doubles of the shader's own; buffers and uniforms are memory.
std::vector<std::string> arrays_of_doubles(const std::string& source) {
  static const std::regex array(R"(\b(double|dvec[234]|real4?)\s+(\w+\s*,\s*)*\w+\s*\[)");
  std::vector<std::string> found;
  std::istringstream lines(source);
  for (std::string line; std::getline(lines, line);)
    if (std::regex_search(line, array) && line.find("buffer") == std::string::npos &&
        line.find("uniform") == std::string::npos)
      found.push_back(line);
  return found;
}

TEST(ExactShaders, AnArrayOfDoublesIsFound) {
  EXPECT_EQ(arrays_of_doubles("  dvec3 plane[4];\nuint id[4];\n real v, w[4];\n").size(), 2U);
  EXPECT_TRUE(arrays_of_doubles("buffer Values { double values[]; };\ndvec3 at(int k);\n").empty());
}

// NVIDIA's compiler (driver 580) keeps them in single precision where it does not know an index:
// pixels beside faces seen edge-on were wrong by 0.3.
TEST(ExactShaders, HaveNoArraysOfDoubles) {
  const ZooMesh mesh = test::lattice_with_fields(1);
  for (const bool surfaces : {false, true}) {
    const DrawnScene scene = preview::drawn_scene(
        mesh, surfaces ? with_surfaces() : test::benchmark_scene(Projection::perspective, 8, 8));
    for (const bool fine : {false, true}) {
      ExactVariant variant;
      variant.perspective = variant.near = variant.clipped = true;
      variant.fine = fine || surfaces;
      variant.fields = scene.fields.size();
      variant.surface_fields = scene.surface_fields.size();
      for (const std::string& source :
           {exact_setup_source(variant, scene), exact_vertex_source(variant),
            exact_fragment_source(variant, scene)})
        EXPECT_EQ(arrays_of_doubles(source), std::vector<std::string>()) << surfaces << fine;
    }
  }
}

}  // namespace
}  // namespace hiac

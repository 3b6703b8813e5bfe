// docs/image-specification.md names every key that the parser knows.

#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "hiac/scene/annotation_keys.hpp"
#include "hiac/scene/camera_keys.hpp"
#include "hiac/scene/color_source.hpp"
#include "hiac/scene/colormaps/built_in_colormaps.hpp"
#include "hiac/scene/extinction_source.hpp"
#include "hiac/scene/scene_keys.hpp"

namespace hiac {
namespace {

/// The table of the page whose first line begins with `| `[name]``, or all of the text behind it
/// that is indented.
std::string section(const std::string& page, const std::string& name) {
  const std::size_t begin = page.find("| `" + name + "`");
  if (begin == std::string::npos) return "";
  return page.substr(begin, page.find("\n\n", begin) - begin);
}

template <typename T>
void expect_keys(const std::string& text, std::span<const SpecKey<T>> keys,
                 const std::string& table) {
  ASSERT_FALSE(text.empty()) << table;
  for (const SpecKey<T>& key : keys) {
    if (key.meaning.empty()) continue;  // a table, which has its own
    const std::string name(key.name);
    const bool named = text.find("`" + name + "`") != std::string::npos ||
                       text.find("\n    " + name + " ") != std::string::npos;
    EXPECT_TRUE(named) << table << " does not name " << name;
  }
}

TEST(SpecificationPage, NamesEveryKey) {
  std::ifstream file(HIAC_SPECIFICATION_PAGE);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  const std::string page = bytes.str();
  expect_keys(section(page, "[image]"), image_keys(), "[image]");
  expect_keys(section(page, "[camera]"), camera_keys(), "[camera]");
  expect_keys(section(page, "[volume]"), volume_keys(), "[volume]");
  expect_keys(section(page, "[volume.color]"), color_keys(), "[volume.color]");
  expect_keys(section(page, "[volume.extinction]"), extinction_keys(), "[volume.extinction]");
  expect_keys(section(page, "[[isosurface]]"), isosurface_keys(), "[[isosurface]]");
  expect_keys(section(page, "[skin]"), skin_keys(), "[skin]");
  expect_keys(section(page, "[edges]"), edge_keys(), "[edges]");
  expect_keys(section(page, "[[light]]"), light_keys(), "[[light]]");
  expect_keys(section(page, "[background]"), background_keys(), "[background]");
  expect_keys(section(page, "[render]"), render_keys(), "[render]");
  expect_keys(section(page, "[annotation]"), annotation_keys(), "[annotation]");
  expect_keys(section(page, "[annotation.title]"), title_keys(), "[annotation.title]");
  expect_keys(section(page, "[annotation.time]"), time_keys(), "[annotation.time]");
  expect_keys(section(page, "[annotation.axes]"), axes_keys(), "[annotation.axes]");
  expect_keys(section(page, "[annotation.scale]"), length_keys(), "[annotation.scale]");
  expect_keys(section(page, "[annotation.colorbar]"), color_bar_keys(), "[annotation.colorbar]");
  const std::string animation = page.substr(page.find("## Animation"));
  expect_keys(animation, turntable_keys(), "[turntable]");
  expect_keys(animation, camera_path_keys(), "[camera_path]");
  for (const SpecKey<Scene>& table : scene_keys())
    EXPECT_NE(page.find("[" + std::string(table.name)), std::string::npos) << table.name;
  for (const std::string& map : built_in_colormap_names())
    EXPECT_NE(page.find("`" + map + "`"), std::string::npos) << map;
}

}  // namespace
}  // namespace hiac

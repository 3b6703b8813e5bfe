#include "hiac/scene/scene_keys.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "hiac/scene/annotation_keys.hpp"
#include "hiac/scene/camera_keys.hpp"
#include "hiac/scene/color_source.hpp"
#include "hiac/scene/extinction_source.hpp"

namespace hiac {
namespace {

using Text = std::optional<std::string>;

constexpr std::pair<std::string_view, Glow> kGlows[] = {{"chromaticity", Glow::chromaticity},
                                                        {"emission", Glow::emission}};
constexpr std::pair<std::string_view, BackgroundPattern> kPatterns[] = {
    {"solid", BackgroundPattern::solid},
    {"checker", BackgroundPattern::checker},
    {"grid", BackgroundPattern::grid},
    {"gradient", BackgroundPattern::gradient}};
constexpr std::pair<std::string_view, EdgeChoice> kEdgeChoices[] = {
    {"feature", EdgeChoice::feature}, {"boundary", EdgeChoice::boundary}, {"all", EdgeChoice::all}};
/// Wider lines are surfaces: pixels.
constexpr double kWidestEdge = 1000;
constexpr std::pair<std::string_view, Integration> kIntegrations[] = {
    {"exact", Integration::exact},
    {"gauss5", Integration::gauss5},
    {"approximate", Integration::approximate},
    {"approximate-unsliced", Integration::approximate_unsliced}};
constexpr std::pair<std::string_view, Interpolation> kInterpolations[] = {
    {"isoparametric", Interpolation::isoparametric}, {"polynomial", Interpolation::polynomial}};

/// Far below the precision of any number of a picture.
constexpr double kLeastTolerance = 1e-30;

void read_tolerance(const SpecValue& value, RenderSettings& render) {
  render.tolerance = value.positive();
  if (render.tolerance < kLeastTolerance)
    value.fail(fmt::format("too small (expected at least {}, found {})", kLeastTolerance,
                           render.tolerance));
}

/// Returns whether a pattern consists of square fields.
bool has_fields(BackgroundPattern pattern) {
  return pattern == BackgroundPattern::checker || pattern == BackgroundPattern::grid;
}

void read_light_direction(const SpecValue& value, Light& light) {
  light.direction = value.triple();
  if (*light.direction == std::array<double, 3>{}) value.fail("a direction cannot be zero");
}

constexpr SpecKey<ImageSize> kImageKeys[] = {
    {"width", "pixels", true,
     [](const SpecValue& v, ImageSize& i) { i.width = v.whole(1, kMaxImageSide); },
     [](const ImageSize& i) -> Text { return std::to_string(i.width); }},
    {"height", "pixels", true,
     [](const SpecValue& v, ImageSize& i) { i.height = v.whole(1, kMaxImageSide); },
     [](const ImageSize& i) -> Text { return std::to_string(i.height); }},
};

constexpr SpecKey<Volume> kVolumeKeys[] = {
    {"glow", "\"chromaticity\" (Williams-Max) or \"emission\" (Wilhelms-Van Gelder)", false,
     [](const SpecValue& v, Volume& volume) { volume.glow = v.name_of<Glow>(kGlows); },
     [](const Volume& volume) -> Text { return name_text<Glow>(kGlows, volume.glow); }},
    {"color", "", false,
     [](const SpecValue& v, Volume& volume) {
       volume.color = read_color_transfer(v, v.context().color, v.context().bar_is_logarithmic);
     },
     nullptr},
    {"extinction", "", false,
     [](const SpecValue& v, Volume& volume) { volume.extinction = read_extinction_transfer(v); },
     nullptr},
};

constexpr SpecKey<Isosurface> kIsosurfaceKeys[] = {
    {"field", "a field of the mesh", true,
     [](const SpecValue& v, Isosurface& s) { s.field = v.text(); },
     [](const Isosurface& s) -> Text { return toml_text(s.field); }},
    {"value", "of the field, on the surface", true,
     [](const SpecValue& v, Isosurface& s) { s.value = v.number(); },
     [](const Isosurface& s) -> Text { return toml_text(s.value); }},
    {"color", "red, green, blue", false,
     [](const SpecValue& v, Isosurface& s) { s.color = v.color(); },
     [](const Isosurface& s) -> Text { return toml_text(s.color); }},
    {"opacity", "seen face-on, 0 to 1", false,
     [](const SpecValue& v, Isosurface& s) { s.opacity = v.inside(0, 1); },
     [](const Isosurface& s) -> Text { return toml_text(s.opacity); }},
    {"ambient", "share of ambient light reflected", false,
     [](const SpecValue& v, Isosurface& s) { s.ambient = v.at_least(0); },
     [](const Isosurface& s) -> Text { return toml_text(s.ambient); }},
    {"diffuse", "share reflected in every direction", false,
     [](const SpecValue& v, Isosurface& s) { s.diffuse = v.at_least(0); },
     [](const Isosurface& s) -> Text { return toml_text(s.diffuse); }},
    {"specular", "share reflected in the highlight", false,
     [](const SpecValue& v, Isosurface& s) { s.specular = v.at_least(0); },
     [](const Isosurface& s) -> Text { return toml_text(s.specular); }},
    {"shininess", "the highlight's exponent", false,
     [](const SpecValue& v, Isosurface& s) { s.shininess = v.at_least(0); },
     [](const Isosurface& s) -> Text { return toml_text(s.shininess); }},
};

void read_skin_color(const SpecValue& value, Skin& skin) {
  if (!value.is_table()) {
    skin.color = value.color();
    return;
  }
  bool is_logarithmic = false;  // matters to the colour bar, which is the volume's
  skin.color_by = read_color_transfer(value, value.context().skin_color, is_logarithmic);
}

constexpr SpecKey<Skin> kSkinKeys[] = {
    {"color", "red, green, blue; or a table, [skin.color], with the keys of [volume.color]", false,
     read_skin_color,
     [](const Skin& s) -> Text {
       if (s.color_by) return std::nullopt;
       return toml_text(s.color);
     }},
    {"opacity", "seen face-on, 0 to 1", false,
     [](const SpecValue& v, Skin& s) { s.opacity = v.inside(0, 1); },
     [](const Skin& s) -> Text { return toml_text(s.opacity); }},
    {"ambient", "share of ambient light reflected", false,
     [](const SpecValue& v, Skin& s) { s.ambient = v.at_least(0); },
     [](const Skin& s) -> Text { return toml_text(s.ambient); }},
    {"diffuse", "share reflected in every direction", false,
     [](const SpecValue& v, Skin& s) { s.diffuse = v.at_least(0); },
     [](const Skin& s) -> Text { return toml_text(s.diffuse); }},
    {"specular", "share reflected in the highlight", false,
     [](const SpecValue& v, Skin& s) { s.specular = v.at_least(0); },
     [](const Skin& s) -> Text { return toml_text(s.specular); }},
    {"shininess", "the highlight's exponent", false,
     [](const SpecValue& v, Skin& s) { s.shininess = v.at_least(0); },
     [](const Skin& s) -> Text { return toml_text(s.shininess); }},
};

constexpr SpecKey<Edges> kEdgeKeys[] = {
    {"show", "\"feature\" (where the boundary bends), \"boundary\" or \"all\"", false,
     [](const SpecValue& v, Edges& e) { e.show = v.name_of<EdgeChoice>(kEdgeChoices); },
     [](const Edges& e) -> Text { return name_text<EdgeChoice>(kEdgeChoices, e.show); }},
    {"angle", "feature: degrees between two faces, above which their edge shows; without it 30",
     false, [](const SpecValue& v, Edges& e) { e.angle = v.inside(0, 180); },
     [](const Edges& e) -> Text {
       // the default is left out, so that `show` can be changed alone
       if (e.show != EdgeChoice::feature || e.angle == Edges{}.angle) return std::nullopt;
       return toml_text(e.angle);
     }},
    {"width", "pixels", false,
     [](const SpecValue& v, Edges& e) {
       e.width = v.positive();
       if (e.width > kWidestEdge)
         v.fail(fmt::format("too large (expected at most {}, found {})", kWidestEdge, e.width));
     },
     [](const Edges& e) -> Text { return toml_text(e.width); }},
    {"color", "red, green, blue", false, [](const SpecValue& v, Edges& e) { e.color = v.color(); },
     [](const Edges& e) -> Text { return toml_text(e.color); }},
    {"opacity", "0 to 1", false, [](const SpecValue& v, Edges& e) { e.opacity = v.inside(0, 1); },
     [](const Edges& e) -> Text { return toml_text(e.opacity); }},
};

void read_edges(const SpecValue& table, Scene& scene) {
  read_keys(table, edge_keys(), scene.edges.emplace());
  if (scene.edges->show != EdgeChoice::feature && table.has("angle"))
    table.fail_at("angle", "has no meaning for edges other than \"feature\"");
}

constexpr SpecKey<Light> kLightKeys[] = {
    {"direction", "towards the light; without it a headlight", false, read_light_direction,
     [](const Light& l) -> Text {
       if (!l.direction) return std::nullopt;
       return toml_text(*l.direction);
     }},
    {"color", "red, green, blue", false, [](const SpecValue& v, Light& l) { l.color = v.color(); },
     [](const Light& l) -> Text { return toml_text(l.color); }},
};

constexpr SpecKey<Background> kBackgroundKeys[] = {
    {"pattern", "\"solid\", \"checker\", \"grid\" or \"gradient\" (top to bottom)", false,
     [](const SpecValue& v, Background& b) { b.pattern = v.name_of<BackgroundPattern>(kPatterns); },
     [](const Background& b) -> Text {
       return name_text<BackgroundPattern>(kPatterns, b.pattern);
     }},
    {"color", "red, green, blue", false,
     [](const SpecValue& v, Background& b) { b.color = v.color(); },
     [](const Background& b) -> Text { return toml_text(b.color); }},
    {"color2", "the pattern's other colour", false,
     [](const SpecValue& v, Background& b) { b.color2 = v.color(); },
     [](const Background& b) -> Text {
       if (b.pattern == BackgroundPattern::solid) return std::nullopt;
       return toml_text(b.color2);
     }},
    {"size", "checker and grid: pixels along a field's side", false,
     [](const SpecValue& v, Background& b) { b.size = v.positive(); },
     [](const Background& b) -> Text {
       if (!has_fields(b.pattern)) return std::nullopt;
       return toml_text(b.size);
     }},
};

constexpr SpecKey<RenderSettings> kRenderKeys[] = {
    {"integration", "\"exact\", \"gauss5\", \"approximate\" or \"approximate-unsliced\"", false,
     [](const SpecValue& v, RenderSettings& r) {
       r.integration = v.name_of<Integration>(kIntegrations);
     },
     [](const RenderSettings& r) -> Text {
       return name_text<Integration>(kIntegrations, r.integration);
     }},
    {"interpolation", "\"isoparametric\" or \"polynomial\"", false,
     [](const SpecValue& v, RenderSettings& r) {
       r.interpolation = v.name_of<Interpolation>(kInterpolations);
     },
     [](const RenderSettings& r) -> Text {
       return name_text<Interpolation>(kInterpolations, r.interpolation);
     }},
    {"tolerance", "absolute error allowed per pixel and channel", false, read_tolerance,
     [](const RenderSettings& r) -> Text { return toml_text(r.tolerance); }},
    {"splat_below", "cells covering fewer pixel centres are splatted; 0: none", false,
     [](const SpecValue& v, RenderSettings& r) { r.splat_below = v.whole(0, 1u << 30); },
     [](const RenderSettings& r) -> Text { return std::to_string(r.splat_below); }},
    {"planarity", "deviation relative to its size below which a quadrilateral face is planar",
     false, [](const SpecValue& v, RenderSettings& r) { r.planarity = v.inside(0, 1); },
     [](const RenderSettings& r) -> Text { return toml_text(r.planarity); }},
};

// Conditions on several keys ---------------------------------------------------------------------

void read_image(const SpecValue& table, Scene& scene) {
  read_keys(table, image_keys(), scene.image);
  const std::uint64_t pixels = std::uint64_t{scene.image.width} * scene.image.height;
  if (pixels > kMaxImagePixels)
    table.fail_at("height", fmt::format("the image is too large (expected at most {} pixels, "
                                        "found {} x {})",
                                        kMaxImagePixels, scene.image.width, scene.image.height));
}

void read_background(const SpecValue& table, Scene& scene) {
  read_keys(table, background_keys(), scene.background);
  const BackgroundPattern pattern = scene.background.pattern;
  const bool solid = pattern == BackgroundPattern::solid;
  if (solid && table.has("color2")) table.fail_at("color2", "has no meaning without a pattern");
  if (!solid && !table.has("color2")) table.fail_at("color2", "is missing (the pattern needs it)");
  if (!has_fields(pattern) && table.has("size"))
    table.fail_at("size", "has no meaning without the pattern \"checker\" or \"grid\"");
}

constexpr SpecKey<Scene> kSceneKeys[] = {
    {"image", "", true, read_image, nullptr},
    {"camera", "", true, read_cameras, nullptr},
    {"camera_path", "", false, read_camera_path, nullptr},
    {"turntable", "", false, read_turntable, nullptr},
    {"volume", "", false,
     [](const SpecValue& v, Scene& s) { read_keys(v, volume_keys(), s.volume); }, nullptr},
    {"isosurface", "", false,
     [](const SpecValue& v, Scene& s) {
       for (const SpecValue& table : v.tables())
         read_keys(table, isosurface_keys(), s.isosurfaces.emplace_back());
     },
     nullptr},
    {"skin", "", false,
     [](const SpecValue& v, Scene& s) { read_keys(v, skin_keys(), s.skin.emplace()); }, nullptr},
    {"edges", "", false, read_edges, nullptr},
    {"light", "", false,
     [](const SpecValue& v, Scene& s) {
       s.lights.clear();
       for (const SpecValue& table : v.tables())
         read_keys(table, light_keys(), s.lights.emplace_back());
     },
     nullptr},
    {"background", "", false, read_background, nullptr},
    {"render", "", false,
     [](const SpecValue& v, Scene& s) { read_keys(v, render_keys(), s.render); }, nullptr},
    // behind [volume], whose scale a colour bar has
    {"annotation", "", false,
     [](const SpecValue& v, Scene&) { v.context().annotation = read_annotation(v); }, nullptr},
};

}  // namespace

std::span<const SpecKey<ImageSize>> image_keys() { return kImageKeys; }
std::span<const SpecKey<Volume>> volume_keys() { return kVolumeKeys; }
std::span<const SpecKey<Isosurface>> isosurface_keys() { return kIsosurfaceKeys; }
std::span<const SpecKey<Skin>> skin_keys() { return kSkinKeys; }
std::span<const SpecKey<Edges>> edge_keys() { return kEdgeKeys; }
std::span<const SpecKey<Light>> light_keys() { return kLightKeys; }
std::span<const SpecKey<Background>> background_keys() { return kBackgroundKeys; }
std::span<const SpecKey<RenderSettings>> render_keys() { return kRenderKeys; }
std::span<const SpecKey<Scene>> scene_keys() { return kSceneKeys; }

}  // namespace hiac

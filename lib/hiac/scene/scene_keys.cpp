#include "hiac/scene/scene_keys.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "hiac/scene/color_source.hpp"
#include "hiac/scene/transfer_points.hpp"

namespace hiac {
namespace {

using Text = std::optional<std::string>;

template <typename E>
using Names = std::span<const std::pair<std::string_view, E>>;

constexpr std::pair<std::string_view, Projection> kProjections[] = {
    {"perspective", Projection::perspective}, {"orthographic", Projection::orthographic}};
constexpr std::pair<std::string_view, Glow> kGlows[] = {{"chromaticity", Glow::chromaticity},
                                                        {"emission", Glow::emission}};
constexpr std::pair<std::string_view, BackgroundPattern> kPatterns[] = {
    {"solid", BackgroundPattern::solid},
    {"checker", BackgroundPattern::checker},
    {"grid", BackgroundPattern::grid},
    {"gradient", BackgroundPattern::gradient}};
constexpr std::pair<std::string_view, Integration> kIntegrations[] = {
    {"exact", Integration::exact},
    {"gauss5", Integration::gauss5},
    {"approximate", Integration::approximate},
    {"approximate-unsliced", Integration::approximate_unsliced}};
constexpr std::pair<std::string_view, Interpolation> kInterpolations[] = {
    {"isoparametric", Interpolation::isoparametric}, {"polynomial", Interpolation::polynomial}};

template <typename E>
std::string name_text(Names<E> names, E value) {
  for (const auto& [name, entry] : names)
    if (entry == value) return toml_text(name);
  return toml_text("");
}

/// True for the patterns that are made of square fields.
bool has_fields(BackgroundPattern pattern) {
  return pattern == BackgroundPattern::checker || pattern == BackgroundPattern::grid;
}

void read_clip(const SpecValue& value, Camera& camera) {
  const std::vector<SpecValue> planes = value.list(2);
  const std::array<double, 2> clip{planes[0].number(), planes[1].number_or_infinity()};
  if (!(clip[0] < clip[1]))
    value.fail(fmt::format("near must be below far (found near {}, far {})", clip[0], clip[1]));
  camera.clip = clip;
}

void read_fov(const SpecValue& value, Camera& camera) {
  camera.fov = value.number();
  if (!(camera.fov > 0 && camera.fov < 180))
    value.fail(
        fmt::format("an angle between 0 and 180 degrees, both excluded, is expected "
                    "(found {})",
                    camera.fov));
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

constexpr SpecKey<Camera> kCameraKeys[] = {
    {"projection", "\"perspective\" or \"orthographic\"", false,
     [](const SpecValue& v, Camera& c) { c.projection = v.name_of<Projection>(kProjections); },
     [](const Camera& c) -> Text { return name_text<Projection>(kProjections, c.projection); }},
    {"eye", "world units", true, [](const SpecValue& v, Camera& c) { c.eye = v.triple(); },
     [](const Camera& c) -> Text { return toml_text(c.eye); }},
    {"look_at", "seen at the image's centre", true,
     [](const SpecValue& v, Camera& c) { c.look_at = v.triple(); },
     [](const Camera& c) -> Text { return toml_text(c.look_at); }},
    {"up", "points up in the image", true, [](const SpecValue& v, Camera& c) { c.up = v.triple(); },
     [](const Camera& c) -> Text { return toml_text(c.up); }},
    {"fov", "perspective: the image's vertical angle, degrees", false, read_fov,
     [](const Camera& c) -> Text {
       if (c.projection != Projection::perspective) return std::nullopt;
       return toml_text(c.fov);
     }},
    {"height", "orthographic: the image's vertical extent, world units", false,
     [](const SpecValue& v, Camera& c) { c.height = v.positive(); },
     [](const Camera& c) -> Text {
       if (c.projection != Projection::orthographic) return std::nullopt;
       return toml_text(c.height);
     }},
    {"clip", "[near, far]: distances from the eye plane along the view direction", false, read_clip,
     [](const Camera& c) -> Text {
       if (!c.clip) return std::nullopt;
       return toml_text(*c.clip);
     }},
};

constexpr SpecKey<ExtinctionTransfer> kExtinctionKeys[] = {
    {"field", "a field of the mesh, the same or another one", true,
     [](const SpecValue& v, ExtinctionTransfer& e) { e.field = v.text(); },
     [](const ExtinctionTransfer& e) -> Text { return toml_text(e.field); }},
    {"points", "scalar, extinction coefficient per world unit of length", true,
     [](const SpecValue& v, ExtinctionTransfer& e) { read_points<1>(v, e.points); },
     [](const ExtinctionTransfer& e) -> Text { return points_text<1>(e.points); }},
};

constexpr SpecKey<Volume> kVolumeKeys[] = {
    {"glow", "\"chromaticity\" (Williams-Max) or \"emission\" (Wilhelms-Van Gelder)", false,
     [](const SpecValue& v, Volume& volume) { volume.glow = v.name_of<Glow>(kGlows); },
     [](const Volume& volume) -> Text { return name_text<Glow>(kGlows, volume.glow); }},
    {"color", "", false,
     [](const SpecValue& v, Volume& volume) { volume.color = read_color_transfer(v); }, nullptr},
    {"extinction", "", false,
     [](const SpecValue& v, Volume& volume) {
       read_keys(v, extinction_keys(), volume.extinction.emplace());
     },
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
    {"tolerance", "absolute error allowed per pixel and channel", false,
     [](const SpecValue& v, RenderSettings& r) { r.tolerance = v.positive(); },
     [](const RenderSettings& r) -> Text { return toml_text(r.tolerance); }},
    {"splat_below", "cells covering fewer pixel centres are splatted; 0: none", false,
     [](const SpecValue& v, RenderSettings& r) { r.splat_below = v.whole(0, 1u << 30); },
     [](const RenderSettings& r) -> Text { return std::to_string(r.splat_below); }},
    {"planarity", "deviation relative to its size below which a quadrilateral face is planar",
     false, [](const SpecValue& v, RenderSettings& r) { r.planarity = v.inside(0, 1); },
     [](const RenderSettings& r) -> Text { return toml_text(r.planarity); }},
};

// What no key alone can tell ------------------------------------------------------------------

void read_image(const SpecValue& table, Scene& scene) {
  read_keys(table, image_keys(), scene.image);
  const std::uint64_t pixels = std::uint64_t{scene.image.width} * scene.image.height;
  if (pixels > kMaxImagePixels)
    table.fail_at("height", fmt::format("the image is too large (expected at most {} pixels, "
                                        "found {} x {})",
                                        kMaxImagePixels, scene.image.width, scene.image.height));
}

/// The vector with its largest component made 1 or -1, so that products neither over- nor
/// underflow.
std::array<double, 3> scaled(std::array<double, 3> v) {
  const double largest = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  for (double& component : v) component /= largest;
  return v;
}

double length(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }

void check_orientation(const SpecValue& table, const Camera& camera) {
  const std::array<double, 3> towards = view_direction(camera);
  if (towards == std::array<double, 3>{}) table.fail_at("look_at", "the same point as `eye`");
  for (const double component : towards)
    if (!std::isfinite(component)) table.fail_at("look_at", "too far from `eye`");
  if (camera.up == std::array<double, 3>{}) table.fail_at("up", "a direction cannot be zero");
  // below this sine the image's right has lost all but four of its digits
  constexpr double kSmallestSine = 1e-12;
  const auto d = scaled(towards);
  const auto u = scaled(camera.up);
  const std::array<double, 3> right{d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2],
                                    d[0] * u[1] - d[1] * u[0]};
  if (length(right) <= kSmallestSine * length(d) * length(u))
    table.fail_at("up", "parallel to the view direction from `eye` to `look_at`");
}

void read_camera(const SpecValue& table, Scene& scene) {
  Camera& camera = scene.camera;
  read_keys(table, camera_keys(), camera);
  const bool perspective = camera.projection == Projection::perspective;
  const char* needed = perspective ? "fov" : "height";
  const char* useless = perspective ? "height" : "fov";
  const std::string_view projection = perspective ? "perspective" : "orthographic";
  if (!table.has(needed))
    table.fail_at(needed,
                  fmt::format("is missing (a camera of {} projection needs it)", projection));
  if (table.has(useless))
    table.fail_at(useless, fmt::format("has no meaning in {} projection (remove it)", projection));
  check_orientation(table, camera);
  if (perspective && camera.clip && (*camera.clip)[0] < 0)
    table.fail_at("clip", fmt::format("near is behind the eye (expected at least 0, found {})",
                                      (*camera.clip)[0]));
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
    {"camera", "", true, read_camera, nullptr},
    {"volume", "", false,
     [](const SpecValue& v, Scene& s) { read_keys(v, volume_keys(), s.volume); }, nullptr},
    {"isosurface", "", false,
     [](const SpecValue& v, Scene& s) {
       for (const SpecValue& table : v.tables())
         read_keys(table, isosurface_keys(), s.isosurfaces.emplace_back());
     },
     nullptr},
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
};

}  // namespace

std::span<const SpecKey<ImageSize>> image_keys() { return kImageKeys; }
std::span<const SpecKey<Camera>> camera_keys() { return kCameraKeys; }
std::span<const SpecKey<ExtinctionTransfer>> extinction_keys() { return kExtinctionKeys; }
std::span<const SpecKey<Volume>> volume_keys() { return kVolumeKeys; }
std::span<const SpecKey<Isosurface>> isosurface_keys() { return kIsosurfaceKeys; }
std::span<const SpecKey<Light>> light_keys() { return kLightKeys; }
std::span<const SpecKey<Background>> background_keys() { return kBackgroundKeys; }
std::span<const SpecKey<RenderSettings>> render_keys() { return kRenderKeys; }
std::span<const SpecKey<Scene>> scene_keys() { return kSceneKeys; }

}  // namespace hiac

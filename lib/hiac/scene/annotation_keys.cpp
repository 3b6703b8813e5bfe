#include "hiac/scene/annotation_keys.hpp"

#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace hiac {
namespace {

using Text = std::optional<std::string>;
using Place = AnnotationPlace;

constexpr std::pair<std::string_view, Place> kPlaces[] = {
    {"top-left", Place::top_left},   {"top", Place::top},
    {"top-right", Place::top_right}, {"left", Place::left},
    {"right", Place::right},         {"bottom-left", Place::bottom_left},
    {"bottom", Place::bottom},       {"bottom-right", Place::bottom_right}};
constexpr std::pair<std::string_view, Place> kSides[] = {
    {"left", Place::left}, {"right", Place::right}, {"top", Place::top}, {"bottom", Place::bottom}};
constexpr std::pair<std::string_view, bool> kBarScales[] = {{"linear", false}, {"log", true}};
constexpr std::pair<std::string_view, bool> kFormats[] = {{"integer", false}, {"all", true}};

/// A share up to 1 as a number, or pixels as a text such as "24px".
PictureLength read_length(const SpecValue& value, bool may_be_zero = false) {
  const toml::node* node = &value.node();
  PictureLength length;
  if (node->is_string()) {
    const std::string text = value.text();
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, length.value);
    if (error != std::errc() || std::string_view(rest, end) != "px" || !(length.value >= 0) ||
        length.value > kMaxImageSide)
      value.fail(fmt::format(
          "no such size (expected a share of the picture's height, or pixels from 0px to {}px; "
          "found \"{}\")",
          kMaxImageSide, text));
    length.in_pixels = true;
  } else {
    length.value = value.inside(0, 1);
  }
  if (length.value == 0 && !may_be_zero) value.fail("expected a positive size, found 0");
  return length;
}

std::string length_text(const PictureLength& length) {
  return length.in_pixels ? toml_text(fmt::format("{}px", length.value)) : toml_text(length.value);
}

/// The keys that every table of a part has; `size` means something else in each.
template <typename Part>
constexpr SpecKey<Part> place_key() {
  return {"place", "\"top-left\", \"top\", \"top-right\", \"left\", \"right\", \"bottom-left\" ...",
          false, [](const SpecValue& v, Part& p) { p.place = v.name_of<Place>(kPlaces); },
          [](const Part& p) -> Text { return name_text<Place>(kPlaces, p.place); }};
}

template <typename Part>
constexpr SpecKey<Part> size_key(std::string_view meaning) {
  return {"size", meaning, false, [](const SpecValue& v, Part& p) { p.size = read_length(v); },
          [](const Part& p) -> Text { return length_text(p.size); }};
}

template <typename Part>
constexpr SpecKey<Part> show_key() {
  return {"show", "false: as if the table were absent", false,
          [](const SpecValue& v, Part&) { static_cast<void>(v.truth()); },
          [](const Part&) -> Text { return "true"; }};
}

/// A text that may be absent.
template <typename Part>
constexpr SpecKey<Part> unit_key() {
  return {"unit", "follows the number", false,
          [](const SpecValue& v, Part& p) { p.unit = v.text(); },
          [](const Part& p) -> Text {
            if (p.unit.empty()) return std::nullopt;
            return toml_text(p.unit);
          }};
}

Text optional_number(const std::optional<double>& value) {
  if (!value) return std::nullopt;
  return toml_text(*value);
}

constexpr SpecKey<TitleAnnotation> kTitleKeys[] = {
    show_key<TitleAnnotation>(),
    {"text", "one line", true, [](const SpecValue& v, TitleAnnotation& t) { t.text = v.text(); },
     [](const TitleAnnotation& t) -> Text { return toml_text(t.text); }},
    place_key<TitleAnnotation>(),
    size_key<TitleAnnotation>("height of the letters, a share of the picture's height or \"24px\""),
};

constexpr SpecKey<TimeAnnotation> kTimeKeys[] = {
    show_key<TimeAnnotation>(),
    place_key<TimeAnnotation>(),
    size_key<TimeAnnotation>("height of the letters"),
    {"value", "instead of the mesh's time", false,
     [](const SpecValue& v, TimeAnnotation& t) { t.value = v.number(); },
     [](const TimeAnnotation& t) { return optional_number(t.value); }},
    unit_key<TimeAnnotation>(),
};

constexpr SpecKey<AxesAnnotation> kAxesKeys[] = {
    show_key<AxesAnnotation>(),
    place_key<AxesAnnotation>(),
    size_key<AxesAnnotation>("side of the square that contains the axes"),
};

constexpr SpecKey<LengthAnnotation> kLengthKeys[] = {
    show_key<LengthAnnotation>(),
    place_key<LengthAnnotation>(),
    size_key<LengthAnnotation>("the longest that the bar may be"),
    {"length", "of the bar, world units; without it a round number", false,
     [](const SpecValue& v, LengthAnnotation& s) { s.length = v.positive(); },
     [](const LengthAnnotation& s) { return optional_number(s.length); }},
    unit_key<LengthAnnotation>(),
};

constexpr SpecKey<ColorBarAnnotation> kColorBarKeys[] = {
    show_key<ColorBarAnnotation>(),
    {"place", "\"left\", \"right\", \"top\" or \"bottom\"", false,
     [](const SpecValue& v, ColorBarAnnotation& b) { b.place = v.name_of<Place>(kSides); },
     [](const ColorBarAnnotation& b) -> Text { return name_text<Place>(kSides, b.place); }},
    size_key<ColorBarAnnotation>("length of the bar"),
    {"label", "instead of the field's name and unit", false,
     [](const SpecValue& v, ColorBarAnnotation& b) { b.label = v.text(); },
     [](const ColorBarAnnotation& b) -> Text {
       if (!b.label) return std::nullopt;
       return toml_text(*b.label);
     }},
    {"scale", "\"linear\" or \"log\"; without it that of [volume.color]", false,
     [](const SpecValue& v, ColorBarAnnotation& b) { b.logarithmic = v.name_of<bool>(kBarScales); },
     [](const ColorBarAnnotation& b) -> Text {
       if (!b.logarithmic) return std::nullopt;
       return name_text<bool>(kBarScales, *b.logarithmic);
     }},
};

bool is_shown(const SpecValue& table) { return !table.has("show") || table.child("show").truth(); }

template <typename Part>
void read_part(const SpecValue& table, std::span<const SpecKey<Part>> keys,
               std::optional<Part>& into) {
  read_keys(table, keys, into.emplace());
  if (!is_shown(table)) into.reset();
}

/// The scale holds for a bar that stands alone, too, which is drawn whether this one is or not.
void read_color_bar(const SpecValue& table, std::optional<ColorBarAnnotation>& into) {
  ColorBarAnnotation bar;
  read_keys(table, color_bar_keys(), bar);
  bool& is_logarithmic = table.context().bar_is_logarithmic;
  is_logarithmic = bar.logarithmic.value_or(is_logarithmic);
  bar.logarithmic = is_logarithmic;
  if (is_shown(table)) into = std::move(bar);
}

constexpr SpecKey<Annotation> kAnnotationKeys[] = {
    {"text_size", "of numbers and labels: a share of the picture's height, or pixels as \"24px\"",
     false, [](const SpecValue& v, Annotation& a) { a.text_size = read_length(v); },
     [](const Annotation& a) -> Text { return length_text(a.text_size); }},
    {"margin", "between the annotation and the picture's edges", false,
     [](const SpecValue& v, Annotation& a) { a.margin = read_length(v, true); },
     [](const Annotation& a) -> Text { return length_text(a.margin); }},
    {"color", "of text and lines: \"auto\" (black or white), or red, green, blue", false,
     [](const SpecValue& v, Annotation& a) {
       a.color.reset();
       if (v.is_list())
         a.color = v.color();
       else if (v.text() != "auto")
         v.fail("no such colour (expected \"auto\" or [red, green, blue], found \"" + v.text() +
                "\")");
     },
     [](const Annotation& a) -> Text { return a.color ? toml_text(*a.color) : toml_text("auto"); }},
    {"formats", "\"integer\" (PNG, SGI, TIFF of 8 and 16 bits) or \"all\"", false,
     [](const SpecValue& v, Annotation& a) { a.in_float_formats = v.name_of<bool>(kFormats); },
     [](const Annotation& a) -> Text { return name_text<bool>(kFormats, a.in_float_formats); }},
    {"title", "", false,
     [](const SpecValue& v, Annotation& a) { read_part(v, title_keys(), a.title); }, nullptr},
    {"time", "", false,
     [](const SpecValue& v, Annotation& a) { read_part(v, time_keys(), a.time); }, nullptr},
    {"axes", "", false,
     [](const SpecValue& v, Annotation& a) { read_part(v, axes_keys(), a.axes); }, nullptr},
    {"scale", "", false,
     [](const SpecValue& v, Annotation& a) { read_part(v, length_keys(), a.scale); }, nullptr},
    {"colorbar", "", false,
     [](const SpecValue& v, Annotation& a) { read_color_bar(v, a.color_bar); }, nullptr},
};

}  // namespace

std::span<const SpecKey<Annotation>> annotation_keys() { return kAnnotationKeys; }
std::span<const SpecKey<TitleAnnotation>> title_keys() { return kTitleKeys; }
std::span<const SpecKey<TimeAnnotation>> time_keys() { return kTimeKeys; }
std::span<const SpecKey<AxesAnnotation>> axes_keys() { return kAxesKeys; }
std::span<const SpecKey<LengthAnnotation>> length_keys() { return kLengthKeys; }
std::span<const SpecKey<ColorBarAnnotation>> color_bar_keys() { return kColorBarKeys; }

Annotation read_annotation(const SpecValue& table) {
  Annotation annotation;
  read_keys(table, annotation_keys(), annotation);
  return annotation;
}

void check_annotation(const SpecValue& document, const Scene& scene, const Annotation& annotation) {
  if (annotation.color_bar && !scene.volume.color)
    document.child("annotation")
        .fail_at("colorbar", "shows the colours of [volume.color], which is missing");
}

}  // namespace hiac

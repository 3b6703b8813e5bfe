// ParaView's colour-map presets: JSON as ParaView exports them now, and XML as in former versions.

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "hiac/base/error.hpp"
#include "hiac/scene/colormaps/colormap_preset.hpp"
#include "hiac/scene/toml/spec_text.hpp"

namespace hiac {
namespace {

using Json = nlohmann::json;

/// The content of one map in a file, not yet checked.
struct RawMap {
  std::string name;
  std::string space;
  bool wrap = false;
  bool indexed = false;
  std::vector<double> numbers;  ///< scalar, red, green, blue, scalar ...
};

ColorSpace space_of(const RawMap& map, const std::string& path) {
  constexpr std::pair<std::string_view, ColorSpace> kSpaces[] = {
      {"rgb", ColorSpace::rgb},
      {"hsv", ColorSpace::hsv},
      {"wrapped", ColorSpace::hsv_wrapped},
      {"wrappedhsv", ColorSpace::hsv_wrapped},
      {"wrapped hsv", ColorSpace::hsv_wrapped},
      {"lab", ColorSpace::lab},
      {"cielab", ColorSpace::lab},
      {"diverging", ColorSpace::diverging},
      {"step", ColorSpace::step}};
  std::string space = map.space;
  std::transform(space.begin(), space.end(), space.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [name, value] : kSpaces)
    if (space == name)
      return value == ColorSpace::hsv && map.wrap ? ColorSpace::hsv_wrapped : value;
  throw InputError(path, fmt::format("colour map `{}`: colour space not known (expected RGB, HSV, "
                                     "Wrapped, Lab, CIELAB, Diverging or Step, found `{}`)",
                                     map.name, map.space));
}

ColormapPreset judged(const RawMap& map, const std::string& path) {
  const auto fail = [&](const std::string& what) {
    return InputError(path, fmt::format("colour map `{}`: {}", map.name, what));
  };
  if (map.indexed || map.numbers.empty())
    throw fail(map.indexed ? "holds indexed colours, for categories (expected colours of scalars)"
                           : "holds no points");
  if (map.numbers.size() % 4 != 0)
    throw fail(fmt::format("expected scalar, red, green and blue for every point, found {} numbers",
                           map.numbers.size()));
  ColormapPreset preset{map.name, space_of(map, path), {}};
  for (std::size_t i = 0; i < map.numbers.size(); i += 4) {
    const double* n = &map.numbers[i];
    if (!std::isfinite(n[0])) throw fail("a scalar is not finite");
    for (int c = 1; c < 4; ++c)
      if (!(n[c] >= 0 && n[c] <= 1))
        throw fail(fmt::format("a colour is out of range (expected 0 to 1, found {})", n[c]));
    preset.nodes.push_back({n[0], {n[1], n[2], n[3]}});
  }
  std::stable_sort(preset.nodes.begin(), preset.nodes.end(),
                   [](const auto& a, const auto& b) { return a.scalar < b.scalar; });
  if (!std::isfinite(preset.nodes.back().scalar - preset.nodes.front().scalar))
    throw fail("the scalars' range is not finite");
  return preset;
}

// JSON --------------------------------------------------------------------------------------------

/// Replaces commas that only white space separates from a closing bracket, outside strings, with
/// blanks; rejects brackets nested deeper than any preset's.
void blank_trailing_commas(std::string& text, const std::string& path) {
  constexpr int kMaxDepth = 64;
  bool in_string = false;
  int depth = 0;
  std::size_t comma = std::string::npos;  // the position of the last token if it is a comma
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') continue;
    if ((c == ']' || c == '}') && comma != std::string::npos) text[comma] = ' ';
    comma = c == ',' ? i : std::string::npos;
    in_string = c == '"';
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kMaxDepth) throw InputError(path, "malformed JSON (brackets nested too deep)");
  }
}

std::string string_in(const Json& map, const char* key) {
  const auto found = map.find(key);
  return found != map.end() && found->is_string() ? found->get<std::string>() : std::string();
}

RawMap raw_map(const Json& map, const std::string& path) {
  RawMap raw;
  raw.name = string_in(map, "Name");
  raw.space = string_in(map, "ColorSpace");
  if (raw.space.empty()) raw.space = "RGB";
  if (const auto wrap = map.find("HSVWrap"); wrap != map.end())
    raw.wrap = (wrap->is_boolean() && wrap->get<bool>()) ||
               (wrap->is_number() && wrap->get<double>() != 0);
  const auto points = map.find("RGBPoints");
  raw.indexed = points == map.end() && map.contains("IndexedColors");
  if (points == map.end()) return raw;
  if (!points->is_array()) throw InputError(path, "`RGBPoints` is not a list");
  for (const Json& number : *points) {
    if (!number.is_number()) throw InputError(path, "`RGBPoints` holds something but numbers");
    raw.numbers.push_back(number.get<double>());
  }
  return raw;
}

std::vector<RawMap> read_json(std::string text, const std::string& path) {
  blank_trailing_commas(text, path);
  Json document;
  try {
    document = Json::parse(text);
  } catch (const Json::exception& error) {
    throw InputError(path, in_one_line(fmt::format("malformed JSON ({})", error.what())));
  }
  if (document.is_object()) document = Json::array({document});
  std::vector<RawMap> maps;
  if (document.is_array())
    for (const Json& map : document)
      if (map.is_object()) maps.push_back(raw_map(map, path));
  return maps;
}

// XML ---------------------------------------------------------------------------------------------

/// Returns an attribute that must be a number.
double number_in(const pugi::xml_node& node, const char* name, const std::string& path) {
  const std::string_view text = node.attribute(name).as_string();
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError(
        path, in_one_line(fmt::format("a <Point> needs a number `{}` (found \"{}\")", name, text)));
  return value;
}

std::vector<RawMap> read_xml(const std::string& text, const std::string& path) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result) throw InputError(path, fmt::format("malformed XML ({})", result.description()));
  const pugi::xml_node list = document.child("ColorMaps");
  const pugi::xml_node parent = list ? list : static_cast<pugi::xml_node>(document);
  std::vector<RawMap> maps;
  for (const pugi::xml_node& map : parent.children("ColorMap")) {
    RawMap& raw = maps.emplace_back();
    raw.name = map.attribute("name").as_string();
    raw.space = map.attribute("space").as_string("RGB");
    raw.indexed = map.attribute("indexedLookup").as_bool();
    for (const pugi::xml_node& point : map.children("Point"))
      for (const char* name : {"x", "r", "g", "b"})
        raw.numbers.push_back(number_in(point, name, path));
  }
  return maps;
}

}  // namespace

ColormapPreset read_colormap_preset(const std::string& path,
                                    const std::optional<std::string>& name) {
  std::string text = read_text_file(path);
  const std::size_t start = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
  const bool is_xml = start != std::string::npos && text[start] == '<';
  const std::vector<RawMap> maps = is_xml ? read_xml(text, path) : read_json(std::move(text), path);
  if (maps.empty()) throw InputError(path, "holds no colour map");
  if (!name) return judged(maps.front(), path);
  std::string known;
  for (const RawMap& map : maps) {
    if (map.name == *name) return judged(map, path);
    if (known.size() < 200) known += fmt::format("{}`{}`", known.empty() ? "" : ", ", map.name);
  }
  throw InputError(path, fmt::format("no colour map `{}` (found {})", *name, known));
}

}  // namespace hiac

#include "tools/view/transfer/transfer_text.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "hiac/scene/toml/edited_text.hpp"
#include "hiac/scene/toml/spec_key.hpp"
#include "hiac/scene/toml/spec_text.hpp"
#include "hiac/scene/transfer_points.hpp"
#include "hiac/session/starter/starter_camera.hpp"

namespace hiac::view {
namespace {

constexpr const char* kInsteadOfPoints[] = {"preset", "preset_name", "preset_tolerance",
                                            "range",  "scale",       "color_space"};

template <std::size_t N>
constexpr const char* kTable = N == 1 ? "volume.extinction" : "volume.color";

template <std::size_t N>
std::string key(std::string_view name) {
  return fmt::format("{}.{}", kTable<N>, name);
}

template <std::size_t N>
const std::optional<TransferFunction<N>>& transfer_of(const Scene& scene) {
  if constexpr (N == 1)
    return scene.volume.extinction;
  else
    return scene.volume.color;
}

template <std::size_t N>
std::string row_text(const typename PiecewiseLinear<N>::Point& point) {
  std::array<double, N + 1> row{point.scalar};
  std::copy(point.value.begin(), point.value.end(), row.begin() + 1);
  return toml_text(std::span<const double>(row));
}

std::string surface_key(std::size_t index, std::string_view name) {
  return fmt::format("isosurface.{}.{}", index, name);
}

}  // namespace

template <std::size_t N>
bool has_plain_points(const std::string& text) {
  const toml::table document = parse_toml(text, "view");
  const auto table = document.at_path(kTable<N>);
  return std::ranges::none_of(kInsteadOfPoints,
                              [&](const char* name) { return static_cast<bool>(table[name]); });
}

template <std::size_t N>
std::string with_plain_points(std::string text, const Scene& scene) {
  if (has_plain_points<N>(text)) return text;
  for (const char* name : kInsteadOfPoints) text = without_key(text, key<N>(name));
  return with_key(text, key<N>("points"), points_text<N>(transfer_of<N>(scene)->points));
}

template <std::size_t N>
std::string with_point(const std::string& text, const Scene& scene, std::size_t index,
                       const typename PiecewiseLinear<N>::Point& point) {
  return with_key(with_plain_points<N>(text, scene), key<N>(fmt::format("points.{}", index)),
                  row_text<N>(point));
}

template <std::size_t N>
std::string with_new_point(const std::string& text, const Scene& scene,
                           const typename PiecewiseLinear<N>::Point& point) {
  const auto& points = transfer_of<N>(scene)->points;
  const auto place =
      std::ranges::upper_bound(points, point.scalar, {}, [](const auto& p) { return p.scalar; });
  return with_element(with_plain_points<N>(text, scene),
                      key<N>(fmt::format("points.{}", place - points.begin())), row_text<N>(point));
}

template <std::size_t N>
std::string without_point(const std::string& text, const Scene& scene, std::size_t index) {
  return without_key(with_plain_points<N>(text, scene), key<N>(fmt::format("points.{}", index)));
}

template <std::size_t N>
std::string with_field(const std::string& text, const Scene& scene, const std::string& field,
                       const std::array<double, 2>& extent) {
  const TransferFunction<N> transfer = *transfer_of<N>(scene);
  std::string edited = with_key(text, key<N>("field"), toml_text(field));
  const toml::table document = parse_toml(text, "view");
  const auto range = document.at_path(key<N>("range"));
  if (range.is_string()) return edited;
  const double low = transfer.points.front().scalar, high = transfer.points.back().scalar;
  if (!(extent[0] < extent[1])) return edited;
  if (range.is_array()) return with_key(edited, key<N>("range"), toml_text(extent));
  auto points = transfer.points;
  for (auto& point : points) {
    const double t = low < high ? (point.scalar - low) / (high - low) : 0.5;
    point.scalar = std::clamp((1 - t) * extent[0] + t * extent[1], extent[0], extent[1]);
  }
  edited = with_plain_points<N>(edited, scene);
  return with_key(edited, key<N>("points"), points_text<N>(points));
}

template bool has_plain_points<1>(const std::string&);
template bool has_plain_points<3>(const std::string&);
template std::string with_plain_points<1>(std::string, const Scene&);
template std::string with_plain_points<3>(std::string, const Scene&);
template std::string with_point<1>(const std::string&, const Scene&, std::size_t,
                                   const PiecewiseLinear<1>::Point&);
template std::string with_point<3>(const std::string&, const Scene&, std::size_t,
                                   const PiecewiseLinear<3>::Point&);
template std::string with_new_point<1>(const std::string&, const Scene&,
                                       const PiecewiseLinear<1>::Point&);
template std::string with_new_point<3>(const std::string&, const Scene&,
                                       const PiecewiseLinear<3>::Point&);
template std::string without_point<1>(const std::string&, const Scene&, std::size_t);
template std::string without_point<3>(const std::string&, const Scene&, std::size_t);
template std::string with_field<1>(const std::string&, const Scene&, const std::string&,
                                   const std::array<double, 2>&);
template std::string with_field<3>(const std::string&, const Scene&, const std::string&,
                                   const std::array<double, 2>&);

std::string with_density(const std::string& text, double factor) {
  const toml::table document = parse_toml(text, "view");
  const toml::array* points = document.at_path("volume.extinction.points").as_array();
  std::string edited = text;
  for (std::size_t i = 0; points != nullptr && i < points->size(); ++i) {
    const toml::array& row = *points->get(i)->as_array();
    const double before = row.get(1)->value<double>().value_or(0);
    edited = with_key(edited, key<1>(fmt::format("points.{}.1", i)), toml_text(factor * before));
  }
  return edited;
}

std::string with_bump(const std::string& text, const Scene& scene, double value, double width,
                      double peak) {
  const auto& points = scene.volume.extinction->points;
  const PiecewiseLinear<1> before = scene.volume.extinction->function();
  // without the last digits of a sum
  const double low = starter::rounded(value - width, width);
  const double high = starter::rounded(value + width, width);
  const std::array<ExtinctionTransfer::Point, 3> bump{
      {{low, before(low)}, {value, {std::max(peak, before(value)[0])}}, {high, before(high)}}};
  // point by point, so that comments in the list stay
  std::string edited = with_plain_points<1>(text, scene);
  for (std::size_t i = points.size(); i-- > 0;)
    if (points[i].scalar >= low && points[i].scalar <= high)
      edited = without_key(edited, key<1>(fmt::format("points.{}", i)));
  auto place = std::ranges::count_if(points, [&](const auto& p) { return p.scalar < low; });
  for (const auto& point : bump)
    edited = with_element(edited, key<1>(fmt::format("points.{}", place++)), row_text<1>(point));
  return edited;
}

double bump_peak(std::vector<ExtinctionTransfer::Point> points, double otherwise) {
  const auto less = [](const auto& a, const auto& b) { return a.value[0] < b.value[0]; };
  std::ranges::sort(points, less);
  const double median = points[points.size() / 2].value[0], most = points.back().value[0];
  return most > 0 ? std::max(5 * median, most) : otherwise;
}

std::string with_preset(const std::string& text, const Scene& scene, const std::string& preset,
                        const std::string& field, const std::array<double, 2>& extent) {
  if (!scene.volume.color) {
    const std::vector<std::pair<std::string, std::string>> keys{
        {"field", toml_text(field)}, {"preset", toml_text(preset)}, {"range", toml_text(extent)}};
    return with_table(text, kTable<3>, keys);
  }
  std::string edited = with_key(text, key<3>("preset"), toml_text(preset));
  if (!has_plain_points<3>(text)) {
    for (const char* name : {"points", "preset_name", "color_space"})
      edited = without_key(edited, key<3>(name));
    return edited;
  }
  const auto& points = scene.volume.color->points;
  const double low = points.front().scalar, high = points.back().scalar;
  return with_color_range(without_key(edited, key<3>("points")),
                          low < high ? std::array<double, 2>{low, high} : extent);
}

std::string preset_of(const std::string& text) {
  const toml::table document = parse_toml(text, "view");
  return document.at_path("volume.color.preset").value_or(std::string());
}

std::string with_color_range(const std::string& text, const std::array<double, 2>& range) {
  return with_key(text, key<3>("range"), toml_text(range));
}

std::string with_surface(const std::string& text, const Scene& scene, const Isosurface& surface) {
  const std::vector<std::pair<std::string, std::string>> keys{
      {"field", toml_text(surface.field)},
      {"value", toml_text(surface.value)},
      {"color", toml_text(surface.color)},
      {"opacity", toml_text(surface.opacity)}};
  return with_table(text, fmt::format("isosurface.{}", scene.isosurfaces.size()), keys);
}

std::string without_surface(const std::string& text, std::size_t index) {
  return without_table(text, fmt::format("isosurface.{}", index));
}

std::string with_surface_value(const std::string& text, std::size_t index, double value) {
  return with_key(text, surface_key(index, "value"), toml_text(value));
}

std::string with_surface_color(const std::string& text, std::size_t index, const Color& color) {
  return with_key(text, surface_key(index, "color"), toml_text(color));
}

std::string with_surface_opacity(const std::string& text, std::size_t index, double opacity) {
  return with_key(text, surface_key(index, "opacity"), toml_text(opacity));
}

}  // namespace hiac::view

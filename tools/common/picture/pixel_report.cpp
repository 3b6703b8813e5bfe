#include "tools/common/picture/pixel_report.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace hiac::tools {
namespace {

using Json = nlohmann::ordered_json;

// Lines of cells, each column as wide as its widest cell, texts to the right; behind the cells a
// line may have a remark.
class Table {
 public:
  using Line = std::vector<std::string>;

  void add(Line line, std::string remark = "") {
    rows_.push_back({std::move(line), std::move(remark)});
  }

  [[nodiscard]] std::string text() const {
    std::vector<std::size_t> width;
    for (const Row& row : rows_) {
      width.resize(std::max(width.size(), row.cells.size()));
      for (std::size_t c = 0; c < row.cells.size(); ++c)
        width[c] = std::max(width[c], row.cells[c].size());
    }
    std::string text;
    for (const Row& row : rows_) {
      std::string line;
      for (std::size_t c = 0; c < row.cells.size(); ++c)
        line += fmt::format("{}{:>{}}", c == 0 ? "" : "  ", row.cells[c], width[c]);
      if (!row.remark.empty()) line += "  " + row.remark;
      text += line + '\n';
    }
    return text;
  }

 private:
  struct Row {
    Line cells;
    std::string remark;
  };
  std::vector<Row> rows_;
};

std::string number(double value) { return fmt::format("{:.6g}", value); }

std::string error_text(const std::optional<double>& error) {
  return error ? fmt::format("{:.1e}", *error) : "";
}

void append(Table::Line& line, const Color& color) {
  for (const double channel : color) line.push_back(number(channel));
}

std::string_view part_name(RayPart part) {
  constexpr std::array<std::string_view, 3> kNames{"inside", "skin", "edge"};
  return kNames[static_cast<std::size_t>(part)];
}

// Which columns a scene has use for.
class PixelTable {
 public:
  PixelTable(const PixelExplanation& pixel, const Scene& scene) : pixel_(pixel), scene_(scene) {
    Table::Line first = header();
    columns_ = first.size();
    table_.add(std::move(first));
  }

  std::string text() {
    for (std::size_t i = 0; i < pixel_.segments.size(); ++i) add_segment(i);
    return table_.text();
  }

 private:
  [[nodiscard]] bool has_extinction() const { return scene_.volume.extinction.has_value(); }
  [[nodiscard]] bool has_color() const { return scene_.volume.color.has_value(); }
  [[nodiscard]] bool has_color_field() const {
    return has_color() &&
           (!has_extinction() || scene_.volume.color->field != scene_.volume.extinction->field);
  }

  [[nodiscard]] Table::Line header() const {
    Table::Line line{"", "cell", "kind", "depth"};
    if (has_extinction()) line.insert(line.end(), {scene_.volume.extinction->field, "tau"});
    if (has_color_field()) line.push_back(scene_.volume.color->field);
    if (has_color()) line.insert(line.end(), {"kappa R", "G", "B"});
    line.insert(line.end(), {"Psi", "transparency", "R", "G", "B", "error"});
    return line;
  }

  // The line's middle: an end of a segment.
  void append_end(Table::Line& line, const SegmentEnd& end) const {
    line.push_back(number(end.depth));
    if (has_extinction()) line.insert(line.end(), {number(end.extinction_field), number(end.tau)});
    if (has_color_field()) line.push_back(number(end.color_field));
    if (has_color()) append(line, end.kappa);
  }

  // Where the ray meets the skin or an edge, in a line.
  void add_met(std::size_t i) {
    const PixelSegment& s = pixel_.segments[i];
    Table::Line line{std::to_string(i + 1), s.cell == kNoCell ? "" : std::to_string(s.cell),
                     std::string(part_name(s.part)), number(s.front.depth)};
    line.resize(columns_ - kBehindEnds);
    line.insert(line.end(), {"", number(s.transparency)});
    append(line, s.color);
    const auto& [r, g, b] = s.light;
    table_.add(std::move(line),
               fmt::format("opacity {:.6g}, color {:.6g} {:.6g} {:.6g}", s.opacity, r, g, b));
  }

  void add_segment(std::size_t i) {
    const PixelSegment& s = pixel_.segments[i];
    if (s.part != RayPart::inside) return add_met(i);
    Table::Line front{std::to_string(i + 1), std::to_string(s.cell),
                      std::string(kind_name(s.kind))};
    append_end(front, s.front);
    table_.add(std::move(front));
    for (const MetIsosurface& met : s.surfaces) {
      const Isosurface& surface = scene_.isosurfaces[met.surface];
      const auto& [r, g, b] = met.color;
      table_.add({"", "", "isosurface", number(met.depth)},
                 fmt::format("{} = {:g}, opacity {:.6g}, color {:.6g} {:.6g} {:.6g}", surface.field,
                             surface.value, met.opacity, r, g, b));
    }
    Table::Line back{"", "", ""};
    append_end(back, s.back);
    back.insert(back.end(), {number(s.psi), number(s.transparency)});
    append(back, s.color);
    back.push_back(error_text(s.error));
    table_.add(std::move(back), s.out_of_order ? "out of order"
                                : s.in_group   ? "sorted pixel by pixel"
                                               : "");
  }

  static constexpr std::size_t kBehindEnds = 6;  // Psi, transparency, R, G, B, error

  const PixelExplanation& pixel_;
  const Scene& scene_;
  Table table_;
  std::size_t columns_ = 0;
};

Json end_json(const SegmentEnd& end) {
  return {{"depth", end.depth},
          {"color_field", end.color_field},
          {"extinction_field", end.extinction_field},
          {"kappa", end.kappa},
          {"tau", end.tau}};
}

Json error_json(const std::optional<double>& error) { return error ? Json(*error) : Json(); }

Json met_json(const PixelSegment& segment) {
  return {{"part", part_name(segment.part)},
          {"cell", segment.cell == kNoCell ? Json() : Json(segment.cell)},
          {"depth", segment.front.depth},
          {"light", segment.light},
          {"opacity", segment.opacity},
          {"transparency", segment.transparency},
          {"color", segment.color},
          {"in_group", segment.in_group}};
}

Json segment_json(const PixelSegment& segment, const Scene& scene) {
  if (segment.part != RayPart::inside) return met_json(segment);
  Json surfaces = Json::array();
  for (const MetIsosurface& met : segment.surfaces) {
    const Isosurface& surface = scene.isosurfaces[met.surface];
    surfaces.push_back({{"field", surface.field},
                        {"value", surface.value},
                        {"depth", met.depth},
                        {"color", met.color},
                        {"opacity", met.opacity}});
  }
  return {{"part", part_name(segment.part)},
          {"cell", segment.cell},
          {"kind", std::string(kind_name(segment.kind))},
          {"front", end_json(segment.front)},
          {"back", end_json(segment.back)},
          {"length", segment.length},
          {"psi", segment.psi},
          {"isosurfaces", std::move(surfaces)},
          {"transparency", segment.transparency},
          {"color", segment.color},
          {"error", error_json(segment.error)},
          {"in_group", segment.in_group},
          {"out_of_order", segment.out_of_order}};
}

}  // namespace

std::string pixel_table(const PixelExplanation& pixel, const Scene& scene) {
  std::string text;
  if (!pixel.segments.empty()) text += PixelTable(pixel, scene).text();
  if (pixel.ended)
    text +=
        "the ray ends here: cells behind would change the pixel by less than render.tolerance\n";
  const auto& [r, g, b] = pixel.background;
  text += fmt::format("background {:.6g} {:.6g} {:.6g} seen through {:.17g}\n", r, g, b,
                      pixel.transparency);
  if (pixel.error) text += fmt::format("error at most {:.1e}\n", *pixel.error);
  const auto& rgba = pixel.rgba;
  return text + fmt::format("pixel {},{}: R {:.17g} G {:.17g} B {:.17g} A {:.17g}\n", pixel.x,
                            pixel.y, rgba[0], rgba[1], rgba[2], rgba[3]);
}

Json pixel_json(const PixelExplanation& pixel, const Scene& scene) {
  Json segments = Json::array();
  for (const PixelSegment& segment : pixel.segments)
    segments.push_back(segment_json(segment, scene));
  const Volume& volume = scene.volume;
  return {{"x", pixel.x},
          {"y", pixel.y},
          {"fields",
           {{"color", volume.color ? Json(volume.color->field) : Json()},
            {"extinction", volume.extinction ? Json(volume.extinction->field) : Json()}}},
          {"segments", std::move(segments)},
          {"ended", pixel.ended},
          {"transparency", pixel.transparency},
          {"background", pixel.background},
          {"color", {pixel.rgba[0], pixel.rgba[1], pixel.rgba[2]}},
          {"alpha", pixel.rgba[3]},
          {"error", error_json(pixel.error)}};
}

}  // namespace hiac::tools

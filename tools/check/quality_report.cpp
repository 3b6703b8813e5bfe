#include "tools/check/quality_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hiac::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string parts_text(const MeshParts& parts) {
  std::string text = fmt::format(
      "  components {}, boundary faces {}, boundary shells {}, cavities {}, tunnels {}\n",
      parts.components, parts.boundary_faces, parts.shells, parts.cavities,
      parts.tunnels ? std::to_string(*parts.tunnels) : "not known");
  if (parts.branching_edges > 0)
    text += fmt::format("  edges with more than two boundary faces: {}\n", parts.branching_edges);
  if (parts.tangled_edges > 0)
    text += fmt::format("  edges whose boundary faces are in no order around them: {}\n",
                        parts.tangled_edges);
  return text;
}

std::string histogram_text(const Histogram& histogram) {
  std::vector<std::string> bins;
  const std::size_t last = histogram.edges.size();
  for (std::size_t i = 0; i <= last; ++i) {
    if (histogram.counts[i] == 0) continue;
    const std::string bin =
        i == 0      ? fmt::format("<{:.4g}", histogram.edges[0])
        : i == last ? fmt::format(">={:.4g}", histogram.edges[last - 1])
                    : fmt::format("{:.4g}..{:.4g}", histogram.edges[i - 1], histogram.edges[i]);
    bins.push_back(fmt::format("{}: {}", bin, histogram.counts[i]));
  }
  return fmt::format("      {}\n", fmt::join(bins, "  "));
}

std::string figure_text(const FigureDistribution& figure) {
  const FigureDescription& about = description_of(figure.figure);
  const Distribution& d = figure.distribution;
  const std::string title =
      about.unit == "degrees" ? fmt::format("{}, degrees", about.title) : std::string(about.title);
  std::string text = fmt::format("    {:<31}", title);
  if (d.count == 0) return text + fmt::format(" undefined in all {} cells\n", d.undefined);
  text += fmt::format(" {:>10.4g}", d.least);
  for (const double percentile : d.percentiles) text += fmt::format(" {:>10.4g}", percentile);
  text += fmt::format(" {:>10.4g}  {}, {}", d.largest, d.least_at, d.largest_at);
  if (d.undefined > 0) text += fmt::format("; undefined in {} cells", d.undefined);
  return text + "\n" + histogram_text(d.histogram);
}

std::string kind_text(const KindQuality& kind) {
  std::string text = fmt::format("  quality of {} {}, volume {:.10g}\n    {:<31} {:>10}",
                                 kind.cells, kind_name(kind.kind), kind.volume, "", "least");
  for (const unsigned percent : kPercents) text += fmt::format(" {:>8} %", percent);
  text += fmt::format(" {:>10}  cells of both\n", "largest");
  for (const FigureDistribution& figure : kind.figures) text += figure_text(figure);
  return text;
}

Json parts_json(const MeshParts& parts) {
  return {{"components", parts.components},
          {"boundary_faces", parts.boundary_faces},
          {"boundary_shells", parts.shells},
          {"cavities", parts.cavities},
          {"tunnels", parts.tunnels ? Json(*parts.tunnels) : Json()},
          {"branching_edges", parts.branching_edges},
          {"tangled_edges", parts.tangled_edges}};
}

Json figure_json(const FigureDistribution& figure) {
  const FigureDescription& about = description_of(figure.figure);
  const Distribution& d = figure.distribution;
  Json json{{"figure", about.key}, {"count", d.count}, {"undefined", d.undefined}};
  if (!about.unit.empty()) json["unit"] = about.unit;
  if (d.count == 0) return json;
  json["least"] = d.least;
  json["least_cell"] = d.least_at;
  json["largest"] = d.largest;
  json["largest_cell"] = d.largest_at;
  json["mean"] = d.mean;
  for (std::size_t i = 0; i < kPercents.size(); ++i)
    json["percentiles"][std::to_string(kPercents[i])] = d.percentiles[i];
  json["histogram"] = {{"edges", d.histogram.edges}, {"counts", d.histogram.counts}};
  return json;
}

}  // namespace

std::string quality_table(const Quality& quality) {
  std::string text = parts_text(quality.parts);
  for (const KindQuality& kind : quality.kinds) text += kind_text(kind);
  return text;
}

Json quality_json(const Quality& quality) {
  Json json = parts_json(quality.parts);
  json["kinds"] = Json::array();
  for (const KindQuality& kind : quality.kinds) {
    Json of{{"kind", kind_name(kind.kind)}, {"cells", kind.cells}, {"volume", kind.volume}};
    of["figures"] = Json::array();
    for (const FigureDistribution& figure : kind.figures)
      of["figures"].push_back(figure_json(figure));
    json["kinds"].push_back(std::move(of));
  }
  return json;
}

}  // namespace hiac::tools

#include "tools/check/report.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hiac::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string_view name_of(Severity severity) {
  constexpr std::array<std::string_view, 3> kNames{"note", "warning", "INVALID"};
  return kNames[static_cast<std::size_t>(severity)];
}

std::string_view name_of(CycleStep step) {
  constexpr std::array<std::string_view, 3> kNames{"face", "face both ways", "gap"};
  return kNames[static_cast<std::size_t>(step)];
}

// The most severe first, and in the defects' order otherwise.
std::vector<const Finding*> sorted(const std::vector<Finding>& findings) {
  std::vector<const Finding*> list;
  for (const Finding& finding : findings) list.push_back(&finding);
  std::ranges::stable_sort(list, [](const Finding* a, const Finding* b) {
    const auto severity = [](const Finding* f) { return description_of(f->defect).severity; };
    return severity(a) != severity(b) ? severity(a) > severity(b) : a->defect < b->defect;
  });
  return list;
}

template <typename T>
std::span<const T> first_of(const std::vector<T>& all, std::size_t most) {
  return std::span(all).first(std::min(most, all.size()));
}

std::string name_of(const Offender& offender, Offence offence) {
  switch (offence) {
    case Offence::cell_pair:
      return fmt::format("{}+{}", offender.id, offender.other);
    case Offence::face:
      return fmt::format("{}:{}", offender.id, offender.other);
    case Offence::node:
      if (offender.other != kNobody) return fmt::format("{}={}", offender.id, offender.other);
      break;
    case Offence::cell:
    case Offence::group:
      break;
  }
  return std::to_string(offender.id);
}

std::string row(const Finding& finding, std::size_t max_ids) {
  // there may be thousands of these beside a few that matter
  constexpr std::size_t kExamples = 3;
  if (finding.defect == Defect::possible_overlap) max_ids = std::min(max_ids, kExamples);
  const DefectDescription& about = description_of(finding.defect);
  std::vector<std::string> names;
  for (const Offender& offender : first_of(finding.offenders, max_ids))
    names.push_back(name_of(offender, about.offence));
  if (finding.offenders.size() > max_ids) names.emplace_back("...");
  std::string text = fmt::format("  {:<8} {:>9} {}: {}\n", name_of(about.severity),
                                 finding.offenders.size(), about.title, fmt::join(names, " "));
  if (!about.measure.empty())
    text += fmt::format("  {:<8} {:>9} {:.3g} at most ({})\n", "", "", finding.largest(),
                        about.measure);
  return text;
}

std::string cells_by_kind(const ZooMesh& mesh) {
  std::array<std::uint64_t, kKindCount> counts{};
  for (const CellKind kind : mesh.kinds) ++counts[static_cast<std::size_t>(kind)];
  std::vector<std::string> parts;
  for (std::size_t kind = 0; kind < kKindCount; ++kind)
    if (counts[kind] > 0)
      parts.push_back(fmt::format("{} {}", counts[kind], kind_name(static_cast<CellKind>(kind))));
  return parts.empty() ? "no cells" : fmt::format("{}", fmt::join(parts, ", "));
}

std::string cycle_text(const VisibilityGroup& group, std::size_t max_ids) {
  std::string text;
  for (const CycleCell& at : first_of(group.cycle, max_ids))
    text += fmt::format("{} -{}-> ", at.cell, name_of(at.step));
  if (group.cycle.size() > max_ids) return text + "...";
  return text + std::to_string(group.cycle.empty() ? 0 : group.cycle[0].cell);
}

std::string cycles_text(const Judgement& judgement, std::size_t max_ids) {
  std::string text;
  std::size_t free = 0, told = 0;
  for (const ViewCycles& view : judgement.views) {
    if (view.groups.empty()) ++free;
    for (const VisibilityGroup& group : view.groups)
      if (++told <= max_ids)
        text += fmt::format("  cycle    {:>9} {}: {}\n", group.cells.size(), view.view,
                            cycle_text(group, max_ids));
  }
  if (told > max_ids) text += fmt::format("  {:<8} {:>9} cycles more\n", "", told - max_ids);
  text += fmt::format("  {} of {} views without cycles", free, judgement.views.size());
  const bool proven =
      judgement.certificate && judgement.certificate->acyclicity != Acyclicity::unknown;
  if (judgement.cells_overlap())
    text +=
        "; but cells overlap: between them there is no order, and a cycle, or none, means nothing";
  else if (!judgement.overlaps_asked && !proven)
    text += ", if no cells overlap (--overlap)";
  return text + "\n";
}

std::string_view name_of(Acyclicity acyclicity) {
  constexpr std::array<std::string_view, 3> kNames{"delaunay", "regular", "unknown"};
  return kNames[static_cast<std::size_t>(acyclicity)];
}

std::string_view name_of(Convexity convexity) {
  constexpr std::array<std::string_view, 3> kNames{"convex", "not convex", "unknown"};
  return kNames[static_cast<std::size_t>(convexity)];
}

std::string convexity_text(const MeshConvexity& found, std::size_t max_ids) {
  if (found.verdict == Convexity::convex) return "  the mesh is convex\n";
  if (found.verdict == Convexity::unknown)
    return fmt::format("  whether the mesh is convex is not known: {}\n", found.reason);
  std::vector<std::string> names;
  for (const ReentrantEdge& edge : first_of(found.edges, max_ids))
    names.push_back(fmt::format("{}-{}", edge.low, edge.high));
  if (found.edges.size() > max_ids) names.emplace_back("...");
  const std::string edges = found.edges.empty()
                                ? ""
                                : fmt::format("{} edges of its boundary bend inwards: {}",
                                              found.edges.size(), fmt::join(names, " "));
  const std::string gaps =
      found.surfaces < 2 ? ""
                         : fmt::format("{} boundary surfaces (gaps or cavities)", found.surfaces);
  return fmt::format("  the mesh is not convex: {}{}{}\n", gaps,
                     edges.empty() || gaps.empty() ? "" : "; ", edges);
}

Json convexity_json(const MeshConvexity& found, std::size_t max_ids) {
  Json json{{"verdict", name_of(found.verdict)},
            {"boundary_surfaces", found.surfaces},
            {"reentrant_edges", found.edges.size()}};
  json["edges"] = Json::array();
  for (const ReentrantEdge& edge : first_of(found.edges, max_ids))
    json["edges"].push_back(
        {{"nodes", {edge.low, edge.high}}, {"cells", {edge.first, edge.second}}});
  if (!found.reason.empty()) json["reason"] = found.reason;
  return json;
}

std::string_view name_of(Delaunay delaunay) {
  constexpr std::array<std::string_view, 4> kNames{"unknown", "no", "weak", "strict"};
  return kNames[static_cast<std::size_t>(delaunay)];
}

std::string certificate_text(const Certificate& certificate) {
  constexpr std::array<std::string_view, 4> kTexts{
      "", "  not Delaunay\n", "  Delaunay; some neighbours have a circumsphere in common\n",
      "  Delaunay\n"};
  const std::string text(kTexts[static_cast<std::size_t>(certificate.delaunay)]);
  if (certificate.acyclicity == Acyclicity::unknown)
    return text +
           fmt::format("  not proven free of cycles from everywhere: {}\n", certificate.reason);
  return text + fmt::format("  proven free of cycles from everywhere: {}\n",
                            certificate.acyclicity == Acyclicity::delaunay ? "strictly Delaunay"
                                                                           : "regular");
}

std::string repair_text(const RepairCounts& c) {
  std::string text = fmt::format(
      "  repaired: {} cells reoriented, {} cells without volume dropped, {} nodes merged\n",
      c.reoriented_cells, c.dropped_cells, c.merged_nodes);
  if (c.unmerged_nodes > 0)
    text += fmt::format(
        "  {} nodes at the place of another left apart (other field values there, or in one cell "
        "with it)\n",
        c.unmerged_nodes);
  return text;
}

Json offender_json(const Offender& offender, Offence offence) {
  if (offence == Offence::cell || offence == Offence::group || offender.other == kNobody)
    return offender.id;
  return {offender.id, offender.other};
}

Json finding_json(const Finding& finding, std::size_t max_ids) {
  const DefectDescription& about = description_of(finding.defect);
  constexpr std::array<std::string_view, 3> kSeverities{"note", "warning", "invalid"};
  Json ids = Json::array();
  for (const Offender& offender : first_of(finding.offenders, max_ids))
    ids.push_back(offender_json(offender, about.offence));
  Json json{{"defect", about.key},
            {"severity", kSeverities[static_cast<std::size_t>(about.severity)]},
            {"text", about.title},
            {"count", finding.offenders.size()},
            {"ids", ids}};
  if (!about.measure.empty()) json["largest"] = finding.largest();
  return json;
}

Json group_json(const VisibilityGroup& group, std::size_t max_ids) {
  Json cycle = Json::array();
  for (const CycleCell& at : first_of(group.cycle, max_ids))
    cycle.push_back({{"cell", at.cell}, {"step", name_of(at.step)}, {"witness", at.witness}});
  return {{"count", group.cells.size()},
          {"cells", first_of(group.cells, max_ids)},
          {"cycle_length", group.cycle.size()},
          {"cycle", cycle}};
}

Json views_json(const Judgement& judgement, std::size_t max_ids) {
  Json views = Json::array();
  for (const ViewCycles& view : judgement.views) {
    Json groups = Json::array();
    for (const VisibilityGroup& group : first_of(view.groups, max_ids))
      groups.push_back(group_json(group, max_ids));
    views.push_back(
        {{"view", view.view}, {"count", view.groups.size()}, {"groups", std::move(groups)}});
  }
  return views;
}

}  // namespace

bool Judgement::cells_overlap() const {
  return std::ranges::any_of(findings, [](const Finding& finding) {
    return finding.defect == Defect::overlap || finding.defect == Defect::folded_face;
  });
}

std::string judgement_table(const ZooMesh& mesh, const Judgement& judgement, std::size_t max_ids) {
  std::string text = fmt::format("  {}; {} nodes\n", cells_by_kind(mesh), mesh.node_count());
  if (judgement.repair) text += repair_text(*judgement.repair);
  for (const Finding* finding : sorted(judgement.findings)) text += row(*finding, max_ids);
  if (judgement.convexity) text += convexity_text(*judgement.convexity, max_ids);
  if (!judgement.views.empty()) text += cycles_text(judgement, max_ids);
  if (judgement.certificate) text += certificate_text(*judgement.certificate);
  if (judgement.quality) text += quality_table(*judgement.quality);
  const bool valid = !any_invalid(judgement.findings);
  text += fmt::format("  {}", valid ? "valid" : "INVALID");
  if (valid && !judgement.overlaps_asked) text += " as far as asked (--overlap: overlaps, too)";
  return text + "\n";
}

nlohmann::ordered_json judgement_facts(const Judgement& judgement, std::size_t max_ids) {
  Json facts{{"valid", !any_invalid(judgement.findings)}, {"findings", Json::array()}};
  for (const Finding* finding : sorted(judgement.findings))
    facts["findings"].push_back(finding_json(*finding, max_ids));
  if (judgement.convexity) facts["convexity"] = convexity_json(*judgement.convexity, max_ids);
  if (!judgement.views.empty()) {
    facts["views"] = views_json(judgement, max_ids);
    facts["cells_overlap"] = judgement.cells_overlap();
  }
  if (judgement.certificate) {
    facts["acyclic"] = name_of(judgement.certificate->acyclicity);
    facts["delaunay"] = name_of(judgement.certificate->delaunay);
    if (!judgement.certificate->reason.empty())
      facts["not_proven_acyclic"] = judgement.certificate->reason;
  }
  if (judgement.quality) facts["quality"] = quality_json(*judgement.quality);
  if (judgement.repair)
    facts["repair"] = {{"reoriented_cells", judgement.repair->reoriented_cells},
                       {"dropped_cells", judgement.repair->dropped_cells},
                       {"merged_nodes", judgement.repair->merged_nodes},
                       {"unmerged_nodes", judgement.repair->unmerged_nodes}};
  return facts;
}

std::string reasons(const Judgement& judgement) {
  std::vector<std::string> parts;
  for (const Finding& finding : judgement.findings)
    if (description_of(finding.defect).severity == Severity::invalid)
      parts.push_back(
          fmt::format("{} {}", finding.offenders.size(), description_of(finding.defect).title));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace hiac::tools

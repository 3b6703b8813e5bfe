#include "tools/convert/listing.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/common/mesh/steps.hpp"
#include "formats/registry.hpp"

namespace hiac::tools {

std::string formats_table() {
  std::vector<std::array<std::string, 7>> rows{
      {"NAME", "EXTENSIONS", "READ", "WRITE", "KINDS", "FIELDS", "TIME STEPS"}};
  for (const formats::Format& format : formats::all_formats())
    rows.push_back({std::string(format.name), fmt::format("{}", fmt::join(format.extensions, " ")),
                    format.read ? "yes" : "no", format.write ? "yes" : "no",
                    std::string(format.kinds), std::string(format.fields),
                    std::string(format.time_steps)});
  std::array<std::size_t, 7> widths{};
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  widths.back() = 0;
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c)
      text += fmt::format("{:<{}}{}", row[c], widths[c], c + 1 < row.size() ? " " : "\n");
  }
  return text;
}

std::string inventory_text(const formats::Inventory& inventory) {
  std::string text = fmt::format("format  {}\npoints  {}\n", inventory.format, inventory.points);
  for (const formats::CellCount& cells : inventory.cells)
    text += fmt::format("cells   {} {}{}\n", cells.count, cells.kind,
                        cells.fate == cells.kind ? "" : fmt::format(" -> {}", cells.fate));
  for (const formats::FieldSummary& field : inventory.fields) {
    const std::string range = field.low <= field.high
                                  ? fmt::format("[{:.6g}, {:.6g}]", field.low, field.high)
                                  : std::string("no numbers");
    text += fmt::format(
        "field   {} ({}, {} x {}) {}{}\n", field.name, field.location, field.type, field.components,
        range,
        field.not_finite == 0 ? "" : fmt::format(", {} values are not finite", field.not_finite));
  }
  if (!inventory.times.empty())
    for (std::size_t step = 0; step < inventory.times.size(); ++step)
      text += fmt::format("step    {}, time {}\n", step, formats::time_text(inventory.times[step]));
  if (!inventory.blocks.empty())
    text += fmt::format("blocks  {}\n", fmt::join(inventory.blocks, ", "));
  for (const std::string& note : inventory.notes) text += fmt::format("note    {}\n", note);
  return text;
}

nlohmann::ordered_json inventory_facts(const formats::Inventory& inventory) {
  nlohmann::ordered_json facts;
  facts["format"] = inventory.format;
  facts["points"] = inventory.points;
  facts["cells"] = nlohmann::ordered_json::array();
  for (const formats::CellCount& cells : inventory.cells)
    facts["cells"].push_back(
        {{"kind", cells.kind}, {"count", cells.count}, {"becomes", cells.fate}});
  facts["fields"] = nlohmann::ordered_json::array();
  for (const formats::FieldSummary& field : inventory.fields) {
    nlohmann::ordered_json entry{{"name", field.name},     {"location", field.location},
                                 {"type", field.type},     {"components", field.components},
                                 {"tuples", field.tuples}, {"not_finite", field.not_finite}};
    if (field.low <= field.high) entry["range"] = {field.low, field.high};
    facts["fields"].push_back(std::move(entry));
  }
  facts["times"] = inventory.times;
  facts["blocks"] = inventory.blocks;
  facts["notes"] = inventory.notes;
  return facts;
}

}  // namespace hiac::tools

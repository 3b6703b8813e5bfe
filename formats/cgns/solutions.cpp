#include "formats/cgns/solutions.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "formats/common/mesh/vector_names.hpp"

namespace hiac::formats::cgns {
namespace {

constexpr std::size_t kNameLength = 32;

/// The step of every solution that the pointers of a zone name.
std::map<std::string, std::size_t> steps_of(const CgnsFile& file, const Node& zone,
                                            std::size_t step_count) {
  std::map<std::string, std::size_t> steps;
  const auto iterative = file.labelled(zone, "ZoneIterativeData_t");
  const auto pointers = iterative ? file.child(*iterative, "FlowSolutionPointers") : std::nullopt;
  if (!pointers) return steps;
  const std::string all = file.text(*pointers);
  for (std::size_t s = 0; s < step_count && (s + 1) * kNameLength <= all.size(); ++s) {
    std::string name = all.substr(s * kNameLength, kNameLength);
    name.resize(std::min(name.find('\0'), name.size()));
    while (name.ends_with(' ')) name.pop_back();
    steps[name] = s;
  }
  return steps;
}

}  // namespace

void add_solutions(const CgnsFile& file, const std::vector<Zone>& zones, std::size_t z,
                   std::size_t step_count, FieldParts& fields, std::vector<std::string>& notes) {
  const Zone& zone = zones[z];
  const std::map<std::string, std::size_t> steps = steps_of(file, zone.node, step_count);
  for (const Node& solution : file.children(zone.node, "FlowSolution_t")) {
    FieldLocation location = FieldLocation::node;
    if (const auto place = file.labelled(solution, "GridLocation_t")) {
      const std::string name = file.text(*place);
      if (name.starts_with("CellCenter")) {
        location = FieldLocation::cell;
      } else if (!name.starts_with("Vertex")) {
        notes.push_back(
            fmt::format("left out the solution '{}', which lives on {}", solution.name, name));
        continue;
      }
    }
    // if the pointers name solutions, a solution that they do not name belongs to no step
    const auto step = steps.find(solution.name);
    if (!steps.empty() && step == steps.end()) continue;
    const std::vector<Node> arrays = file.children(solution, "DataArray_t");
    std::vector<std::string> names;
    for (const Node& array : arrays) names.push_back(array.name);
    for (const VectorName& vector : vectors_among(names)) {
      FieldPart part;
      part.rind = rind_of(file, solution);
      for (const std::size_t i : vector.parts) part.arrays.push_back(arrays[i]);
      auto& parts = fields[{vector.name, location, vector.parts.size(),
                            steps.empty() ? kAlways : step->second}];
      parts.resize(zones.size());
      parts[z] = std::move(part);
    }
  }
}

}  // namespace hiac::formats::cgns

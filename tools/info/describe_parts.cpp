#include "tools/info/describe_parts.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "hiac/mesh/parted/cell_weight.hpp"
#include "hiac/mesh/parted/join_parts.hpp"
#include "hiac/mesh/parted/part_contacts.hpp"
#include "hiac/mesh/parted/parted_index.hpp"

namespace hiac::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Neighbour {
  std::size_t part;
  std::uint64_t faces;
};

std::uint64_t weight_of(const ZooMesh& mesh) {
  std::uint64_t weight = 0;
  for (const CellKind kind : mesh.kinds) weight += cell_weight(kind);
  return weight;
}

// The largest over the mean.
double balance_of(const std::vector<std::uint64_t>& shares) {
  const auto sum = static_cast<double>(std::reduce(shares.begin(), shares.end()));
  return static_cast<double>(*std::ranges::max_element(shares)) *
         static_cast<double>(shares.size()) / sum;
}

std::uint64_t faces_of(const std::vector<Neighbour>& neighbours) {
  std::uint64_t faces = 0;
  for (const Neighbour& n : neighbours) faces += n.faces;
  return faces;
}

std::string text_of(const std::vector<Neighbour>& neighbours) {
  if (neighbours.empty()) return "no neighbour";
  std::string text =
      fmt::format("{} faces to {} neighbours:", faces_of(neighbours), neighbours.size());
  for (const Neighbour& n : neighbours) text += fmt::format(" {} ({})", n.part, n.faces);
  return text;
}

}  // namespace

bool is_parted_mesh(const std::string& path) { return path.ends_with(kPartedExtension); }

void describe_parts(const std::string& path, Description& description) {
  // the whole has been read: what the index names may be read
  const PartedIndex index = read_parted_index(path, PartFiles::anywhere);
  const std::vector<MeshPart> parts = read_all_parts(index);
  std::vector<std::vector<Neighbour>> neighbours(parts.size());
  std::uint64_t cut_faces = 0, nodes = 0;
  for (const PartContact& contact : part_contacts(parts)) {
    neighbours[contact.part].push_back({contact.other, contact.faces});
    neighbours[contact.other].push_back({contact.part, contact.faces});
    cut_faces += contact.faces;
  }
  std::vector<std::uint64_t> cells, weights;
  std::string lines;
  Json each = Json::array();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const PartInfo& info = index.parts[k];
    cells.push_back(info.cells);
    weights.push_back(weight_of(parts[k].mesh));
    nodes += info.nodes;
    Json others = Json::array();
    for (const Neighbour& n : neighbours[k])
      others.push_back({{"part", n.part}, {"faces", n.faces}});
    each.push_back({{"file", info.file},
                    {"cells", info.cells},
                    {"nodes", info.nodes},
                    {"cut_faces", faces_of(neighbours[k])},
                    {"neighbours", std::move(others)}});
    lines += description_line(fmt::format("part {}", k),
                              fmt::format("{}: {} cells, {} nodes; {}", info.file, info.cells,
                                          info.nodes, text_of(neighbours[k])));
  }
  description.facts["parts"] = {{"count", parts.size()},
                                {"balance", balance_of(weights)},
                                {"cell_balance", balance_of(cells)},
                                {"nodes", nodes},
                                {"cut_faces", cut_faces},
                                {"each", std::move(each)}};
  description.text +=
      description_line("parts", fmt::format("{}; the largest weighs {:.3f} times the mean and has "
                                            "{:.3f} times the mean's cells",
                                            parts.size(), balance_of(weights), balance_of(cells)));
  description.text += description_line("", fmt::format("{} nodes in all parts", nodes));
  description.text += description_line("", fmt::format("{} faces cut", cut_faces));
  description.text += lines;
}

}  // namespace hiac::tools

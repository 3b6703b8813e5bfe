#include "tools/convert/parted_output.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/fields/find_field.hpp"
#include "hiac/mesh/parted/cell_weight.hpp"
#include "hiac/mesh/parted/write_parts.hpp"
#include "hiac/partition/partition.hpp"
#include "tools/common/as_option.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/convert/tell.hpp"

namespace hiac::tools {
namespace {

/// The part of every cell, and how many there are.
struct Division {
  std::vector<std::uint32_t> part_of_cell;
  std::size_t parts = 0;
};

/// The distinct numbers, in their order, are the parts.
template <typename Numbers>
Division division_of(const Numbers& numbers_of_cells) {
  std::map<double, std::uint32_t> numbers;
  for (const double number : numbers_of_cells) numbers.emplace(number, 0);
  Division division;
  for (auto& [value, number] : numbers) number = static_cast<std::uint32_t>(division.parts++);
  for (const double number : numbers_of_cells) division.part_of_cell.push_back(numbers.at(number));
  return division;
}

/// The pieces of the input that have cells are the parts.
Division division_into(const Pieces& pieces, const std::string& input) {
  if (!pieces)
    throw UsageError(
        fmt::format("--keep-parts: {} is in one piece (--parts N or --parts-by FIELD "
                    "expected)",
                    input));
  Division division = division_of(*pieces);
  if (division.parts > kMostParts)
    throw UsageError(fmt::format("--keep-parts: {} is in {} pieces ({} at most expected)", input,
                                 division.parts, kMostParts));
  return division;
}

/// The distinct values of a field of cells are the parts.
Division division_by(const ZooMesh& mesh, const std::string& name) {
  const std::string option = fmt::format("--parts-by {}: ", name);
  const Field* field = as_option(option, [&] { return find_field(mesh, name); });
  if (field == nullptr) throw UsageError(option + "there is no such field");
  if (field->location != FieldLocation::cell || field->components != 1)
    throw UsageError(option + "is no scalar field of the cells");
  std::set<double> values;
  for (const double value : field->values) {
    if (!(std::floor(value) == value))
      throw UsageError(fmt::format("{}holds {} (whole numbers of parts expected)", option, value));
    values.insert(value);
    if (values.size() > kMostParts)
      throw UsageError(fmt::format("{}has more than {} values", option, kMostParts));
  }
  return division_of(field->values);
}

/// The largest weight of a part over the mean.
double balance_of(const ZooMesh& mesh, const Division& division) {
  std::vector<double> weights(division.parts, 0);
  double total = 0;
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    const double weight = cell_weight(mesh.kinds[cell]);
    weights[division.part_of_cell[cell]] += weight;
    total += weight;
  }
  return *std::ranges::max_element(weights) * static_cast<double>(division.parts) / total;
}

}  // namespace

void Parting::add_options(CLI::App& app) {
  CLI::Option* by_field =
      app.add_option("--parts-by", field,
                     "With -o FILE.zparts: the cells' parts are the values of this field, whole "
                     "numbers, as a solver's own division left them")
          ->type_name("FIELD");
  CLI::Option* keeping =
      app.add_flag("--keep-parts", keep,
                   "With -o FILE.zparts: the parts are the pieces that INPUT is in (a .pvtu, an "
                   "OpenFOAM case in processor folders, Exodus files NAME.N.K, another .zparts), "
                   "joined at the nodes that they have in common, without ghost cells")
          ->excludes(by_field);
  app.add_option("--parts", parts,
                 "With -o FILE.zparts: divide the cells into N parts of nearly equal cost that "
                 "have few faces in common")
      ->check(CLI::Range(1U, static_cast<std::uint32_t>(kMostParts)).description(""))
      ->type_name("N")
      ->excludes(by_field)
      ->excludes(keeping);
}

void Parting::check_output(const std::string& output) const {
  const bool given = parts.has_value() || !field.empty() || keep;
  if (given && !is_parted_output(output))
    throw UsageError("--parts, --parts-by, --keep-parts: only for a parted mesh (-o FILE.zparts)");
  if (!given && is_parted_output(output))
    throw UsageError(
        fmt::format("-o {}: nothing says which parts (--parts N, --parts-by FIELD or "
                    "--keep-parts expected)",
                    output));
}

bool is_parted_output(const std::string& output) {
  return std::filesystem::path(output).extension() == kPartedExtension;
}

void write_parts(Tool& tool, const Parting& parting, const ZooMesh& mesh, const Pieces& pieces,
                 const std::string& input, const std::string& output) {
  const Division division = tool.timed("divide", [&]() -> Division {
    if (parting.keep) return division_into(pieces, input_name(input));
    if (!parting.parts) return division_by(mesh, parting.field);
    const std::size_t parts = *parting.parts;
    return {as_option("--parts: ", [&] { return partition_cells(mesh, parts, input); }), parts};
  });
  RunFiles files{{input}, {}};
  for (const std::string& path : part_paths(output, division.parts))
    files.outputs.push_back({"-o", path, FileKind::mesh});
  require_safe(files);
  const PartedIndex index =
      write_parted_mesh(output, mesh, division.part_of_cell, division.parts,
                        [&](const std::string& file) { tool.detail("wrote " + file); });
  const double balance = balance_of(mesh, division);
  std::uint64_t nodes = 0;
  for (const PartInfo& part : index.parts) nodes += part.nodes;
  tool.facts()["parts"] = {{"count", division.parts}, {"balance", balance}, {"nodes", nodes}};
  tool.note(
      fmt::format("{} parts; the largest weighs {:.3f} times the mean; {} nodes in all parts, "
                  "{} in the whole mesh",
                  division.parts, balance, nodes, mesh.node_count()));
}

}  // namespace hiac::tools

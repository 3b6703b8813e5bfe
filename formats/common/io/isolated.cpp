#include "formats/common/io/isolated.hpp"

#include <algorithm>
#include <memory>

#include "formats/common/cells/edge_order.hpp"
#include "hiac/base/process/isolated_process.hpp"
#include "hiac/base/process/pack.hpp"

namespace hiac::formats {
namespace {

// ---- the process that reads the file

void pack_type(PackWriter& out, const ForeignType& type) {
  out.text(type.name);
  out.number(type.nodes);
  out.number(static_cast<std::uint64_t>(type.conversion.fate));
  out.number(static_cast<std::uint64_t>(type.conversion.kind));
  out.number(type.conversion.corners ? static_cast<std::uint64_t>(*type.conversion.corners)
                                     : kKindCount);
  const auto permutation = type.conversion.permutation;
  out.text({reinterpret_cast<const char*>(permutation.data()), permutation.size()});
  out.number(type.conversion.further_nodes ? 1 : 0);
}

void pack_field(PackWriter& out, const ForeignField& field) {
  out.text(field.name);
  out.text(field.unit);
  out.text(field.type);
  out.number(static_cast<std::uint64_t>(field.location));
  out.number(field.components);
  out.number(field.step ? *field.step + 1 : 0);
}

/// Writes everything except the values of the fields, and frees what the fields do not need.
void pack_mesh(PackWriter& out, ForeignMesh& mesh) {
  out.consume(mesh.xyz);
  out.consume(mesh.node_numbers);
  out.number(static_cast<std::uint64_t>(mesh.first_node));
  out.number(mesh.types.size());
  for (const ForeignType& type : mesh.types) pack_type(out, type);
  out.consume(mesh.cell_types);
  out.consume(mesh.cell_nodes);
  out.consume(mesh.polyhedra.cells);
  out.consume(mesh.polyhedra.ends);
  out.consume(mesh.polyhedra.faces);
  out.consume(mesh.cell_numbers);
  out.number(mesh.blocks.size());
  for (const ForeignBlock& block : mesh.blocks) {
    out.text(block.name);
    out.array(std::span<const IndexRange>(block.cells));
  }
  out.consume(mesh.times);
  out.number(mesh.metadata.size());
  for (const auto& [key, text] : mesh.metadata) {
    out.text(key);
    out.text(text);
  }
  out.number(mesh.notes.size());
  for (const std::string& note : mesh.notes) out.text(note);
  out.number(mesh.fields.size());
  for (const ForeignField& field : mesh.fields) pack_field(out, field);
  out.number(mesh.field_steps.size());
  for (const auto& [name, steps] : mesh.field_steps) {
    out.text(name);
    out.array(
        std::span<const std::uint64_t>(std::vector<std::uint64_t>(steps.begin(), steps.end())));
  }
}

// ---- the process that requests

constexpr std::uint64_t kFateCount = 4;
constexpr std::uint64_t kLocationCount = 3;

/// Whether the cells of a type have the nodes that their conversion takes.
bool has_its_nodes(const ForeignType& type) {
  const CellConversion& conversion = type.conversion;
  const bool converted = conversion.fate == CellFate::converted;
  if (!converted && !conversion.corners) return true;
  const std::size_t taken = node_count(converted ? conversion.kind : *conversion.corners);
  if (conversion.permutation.empty()) return taken <= type.nodes;
  return taken <= conversion.permutation.size() &&
         std::ranges::all_of(conversion.permutation,
                             [&](std::uint8_t node) { return node < type.nodes; });
}

ForeignType unpack_type(PackReader& in) {
  ForeignType type;
  type.name = in.text();
  type.nodes = in.number();
  type.conversion.fate = static_cast<CellFate>(in.number_below(kFateCount));
  type.conversion.kind = static_cast<CellKind>(in.number_below(kKindCount));
  const std::uint64_t corners = in.number();
  if (corners < kKindCount) type.conversion.corners = static_cast<CellKind>(corners);
  const std::string permutation = in.text();
  type.conversion.permutation = kept_permutation({permutation.begin(), permutation.end()});
  type.conversion.further_nodes = in.number() != 0;
  if (!has_its_nodes(type)) in.fail();
  return type;
}

ForeignField unpack_field(PackReader& in) {
  ForeignField field;
  field.name = in.text();
  field.unit = in.text();
  field.type = in.text();
  field.location = static_cast<FieldLocation>(in.number_below(kLocationCount));
  field.components = static_cast<std::uint32_t>(in.number());
  if (const std::uint64_t step = in.number(); step > 0) field.step = step - 1;
  return field;
}

ForeignMesh unpack_mesh(PackReader& in) {
  ForeignMesh mesh;
  mesh.xyz = in.array<double>();
  mesh.node_numbers = in.array<std::int64_t>();
  mesh.first_node = static_cast<std::int64_t>(in.number());
  mesh.types.resize(in.count());
  for (ForeignType& type : mesh.types) type = unpack_type(in);
  mesh.cell_types = in.array<std::uint16_t>();
  mesh.cell_nodes = in.array<std::int64_t>();
  mesh.polyhedra.cells = in.array<std::size_t>();
  mesh.polyhedra.ends = in.array<std::size_t>();
  mesh.polyhedra.faces = in.array<std::int64_t>();
  mesh.cell_numbers = in.array<std::int64_t>();
  mesh.blocks.resize(in.count());
  for (ForeignBlock& block : mesh.blocks) {
    block.name = in.text();
    block.cells = in.array<IndexRange>();
  }
  mesh.times = in.array<double>();
  mesh.metadata.resize(in.count());
  for (auto& [key, text] : mesh.metadata) {
    key = in.text();
    text = in.text();
  }
  mesh.notes.resize(in.count());
  for (std::string& note : mesh.notes) note = in.text();
  mesh.fields.resize(in.count());
  for (ForeignField& field : mesh.fields) field = unpack_field(in);
  for (std::size_t left = in.count(); left > 0; --left) {
    const std::string name = in.text();
    const std::vector<std::uint64_t> steps = in.array<std::uint64_t>();
    mesh.field_steps[name].insert(steps.begin(), steps.end());
  }
  return mesh;
}

}  // namespace

ForeignMesh read_isolated(const std::string& path, std::string_view library,
                          const std::function<ForeignMesh(const std::string& path)>& open) {
  const auto opened = std::make_shared<ForeignMesh>();
  // a request is the number of a field; an empty one is for everything else
  const auto process = std::make_shared<IsolatedProcess>(
      std::string(library),
      [open, opened](const std::string& file, const std::string& field, PackWriter& answer) {
        if (field.empty()) {
          *opened = open(file);
          return pack_mesh(answer, *opened);
        }
        std::vector<double> values = opened->fields.at(std::stoul(field)).values();
        answer.consume(values);
      });
  const PackedAnswer answer = process->answer(path, "");
  PackReader in(answer.bytes(), path);
  ForeignMesh mesh = unpack_mesh(in);
  for (std::size_t i = 0; i < mesh.fields.size(); ++i)
    mesh.fields[i].values = [process, path, i] {
      const PackedAnswer values = process->answer(path, std::to_string(i));
      return PackReader(values.bytes(), path).array<double>();
    };
  return mesh;
}

}  // namespace hiac::formats

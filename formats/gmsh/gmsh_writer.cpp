#include "formats/gmsh/gmsh_writer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/common/io/binary_output.hpp"
#include "formats/gmsh/gmsh_types.hpp"
#include "hiac/base/error.hpp"
#include "hiac/geometry/box.hpp"

namespace hiac::formats::gmsh {
namespace {

constexpr int kVolume = 3;
constexpr int kEntity = 1;

/// The wedge as a brick: the wedge's node for each of the brick's; edge 6-7 is one node.
constexpr std::array<std::uint8_t, 8> kWedge7{0, 1, 2, 3, 4, 5, 6, 6};
constexpr std::array<std::uint8_t, 20> kWedge18{0, 1,  2,  3,  4, 5,  6,  6,  7,  8,
                                                9, 10, 11, 12, 6, 13, 14, 15, 16, 17};

std::optional<WrittenType> wedge_type(CellKind kind) {
  const bool linear = kind == CellKind::wedge7;
  WrittenType type = *written_type(linear ? CellKind::brick8 : CellKind::brick20);
  for (std::uint8_t& node : type.nodes) node = linear ? kWedge7[node] : kWedge18[node];
  return type;
}

class MshWriter {
 public:
  MshWriter(const std::string& path, const ZooMesh& mesh) : path_(path), mesh_(mesh) {}

  std::vector<std::string> run() {
    check_kinds();
    check_fields();
    BinaryOutput out(path_);
    out.text("$MeshFormat\n4.1 1 8\n");
    out.number<std::int32_t>(1);
    out.text("\n$EndMeshFormat\n");
    write_entities(out);
    write_nodes(out);
    write_elements(out);
    for (const Field& field : mesh_.fields) write_field(out, field);
    out.finish();
    return std::move(notes_);
  }

 private:
  const WrittenType& type_of(CellId cell) const {
    return *types_[static_cast<std::size_t>(mesh_.kinds[cell])];
  }

  void check_kinds() {
    std::array<std::size_t, kKindCount> counts{};
    for (const CellKind kind : mesh_.kinds) ++counts[static_cast<std::size_t>(kind)];
    for (std::size_t k = 0; k < kKindCount; ++k) {
      const auto kind = static_cast<CellKind>(k);
      const bool wedge = kind == CellKind::wedge7 || kind == CellKind::wedge18;
      types_[k] = wedge ? wedge_type(kind) : written_type(kind);
      if (counts[k] == 0) continue;
      if (!types_[k])
        throw InputError(path_, fmt::format("Gmsh has no element for a {} ({} found)",
                                            kind_name(kind), counts[k]));
      if (wedge)
        notes_.push_back(
            fmt::format("{} {} cells written as bricks with a repeated node, Gmsh "
                        "having no such element",
                        counts[k], kind_name(kind)));
    }
    // in Gmsh's fields, the counts of elements and nodes have 32 bits
    constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
    if (!mesh_.fields.empty() && std::max(mesh_.node_count(), mesh_.cell_count()) > kMost)
      throw InputError(path_, "Gmsh cannot hold fields on so many nodes or cells");
  }

  void check_fields() {
    std::vector<std::string> left_out;
    for (const auto& [key, text] : mesh_.metadata) {
      double time = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
      if (key == "time" && error == std::errc() && end == text.data() + text.size())
        time_ = time;
      else if (key != "source")
        left_out.push_back(key);
    }
    if (!left_out.empty())
      notes_.push_back(
          fmt::format("left out, Gmsh having no place for them: {}", fmt::join(left_out, ", ")));
    for (const Field& field : mesh_.fields) {
      if (field.name.find_first_of("\"\n\r") != std::string::npos || field.name.empty())
        throw InputError(path_, fmt::format("Gmsh cannot hold a field of the name '{}' (rename it)",
                                            field.name));
      const auto twins = std::count_if(mesh_.fields.begin(), mesh_.fields.end(), [&](auto& other) {
        return other.name == field.name && other.location == field.location;
      });
      if (twins > 1)
        throw InputError(path_, fmt::format("Gmsh cannot hold two fields of one name in one place "
                                            "('{}' found twice: rename one)",
                                            field.name));
      if (!field.unit.empty())
        notes_.push_back(
            fmt::format("the unit of '{}' is left out, Gmsh having no place for it", field.name));
      if (field.components != 1 && field.components != 3 && field.components != 9)
        notes_.push_back(
            fmt::format("field '{}' has {} components; Gmsh itself shows fields with "
                        "1, 3 or 9",
                        field.name, field.components));
    }
  }

  void write_entities(BinaryOutput& out) const {
    const Box box = mesh_.xyz.empty() ? Box{} : box_of_nodes(mesh_);
    out.text("$Entities\n");
    for (const std::uint64_t count : {0, 0, 0, 1}) out.number(count);
    out.number<std::int32_t>(kEntity);
    for (const double least : box.low) out.number(least);
    for (const double most : box.high) out.number(most);
    out.number<std::uint64_t>(0);  // physical groups
    out.number<std::uint64_t>(0);  // bounding surfaces
    out.text("\n$EndEntities\n");
  }

  void write_nodes(BinaryOutput& out) const {
    const std::uint64_t count = mesh_.node_count();
    out.text("$Nodes\n");
    for (const std::uint64_t head : {std::uint64_t{1}, count, std::uint64_t{1}, count})
      out.number(head);
    for (const std::int32_t head : {kVolume, kEntity, 0}) out.number(head);
    out.number(count);
    for (std::uint64_t node = 1; node <= count; ++node) out.number(node);
    for (const double x : mesh_.xyz) out.number(x);
    out.text("\n$EndNodes\n");
  }

  /// The beginnings of runs of cells of one kind, followed by the number of cells: these blocks
  /// preserve the order of the cells.
  [[nodiscard]] std::vector<CellId> runs() const {
    std::vector<CellId> begins;
    for (CellId cell = 0; cell < mesh_.cell_count(); ++cell)
      if (cell == 0 || mesh_.kinds[cell] != mesh_.kinds[cell - 1]) begins.push_back(cell);
    begins.push_back(static_cast<CellId>(mesh_.cell_count()));
    return begins;
  }

  void write_elements(BinaryOutput& out) const {
    const std::vector<CellId> begins = runs();
    const std::uint64_t count = mesh_.cell_count();
    out.text("$Elements\n");
    for (const std::uint64_t head :
         {std::uint64_t{begins.size() - 1}, count, std::uint64_t{1}, count})
      out.number(head);
    for (std::size_t run = 0; run + 1 < begins.size(); ++run) {
      const WrittenType& type = type_of(begins[run]);
      for (const std::int32_t head : {kVolume, kEntity, type.number}) out.number(head);
      out.number<std::uint64_t>(begins[run + 1] - begins[run]);
      for (CellId cell = begins[run]; cell < begins[run + 1]; ++cell) {
        out.number<std::uint64_t>(std::uint64_t{cell} + 1);
        const auto nodes = mesh_.cell_nodes(cell);
        for (const std::uint8_t n : type.nodes)
          out.number<std::uint64_t>(std::uint64_t{nodes[n]} + 1);
      }
    }
    out.text("\n$EndElements\n");
  }

  void write_field(BinaryOutput& out, const Field& field) const {
    constexpr std::array<std::string_view, 3> kSections{"NodeData", "ElementData",
                                                        "ElementNodeData"};
    const std::string_view section = kSections[static_cast<std::size_t>(field.location)];
    const bool on_nodes = field.location == FieldLocation::node;
    const std::size_t entities = on_nodes ? mesh_.node_count() : mesh_.cell_count();
    out.text(fmt::format("${}\n1\n\"{}\"\n{}3\n0\n{}\n{}\n", section, field.name,
                         time_ ? fmt::format("1\n{}\n", *time_) : "0\n", field.components,
                         entities));
    for (std::size_t i = 0; i < entities; ++i) {
      out.number(static_cast<std::int32_t>(i + 1));
      if (field.location == FieldLocation::corner)
        write_corners(out, field, static_cast<CellId>(i));
      else
        write_tuple(out, field, i);
    }
    out.text(fmt::format("\n$End{}\n", section));
  }

  void write_corners(BinaryOutput& out, const Field& field, CellId cell) const {
    const std::vector<std::uint8_t>& nodes = type_of(cell).nodes;
    out.number(static_cast<std::int32_t>(nodes.size()));
    for (const std::uint8_t n : nodes) write_tuple(out, field, mesh_.elems[cell] + n);
  }

  static void write_tuple(BinaryOutput& out, const Field& field, std::size_t tuple) {
    for (std::size_t c = 0; c < field.components; ++c)
      out.number(field.values[tuple * field.components + c]);
  }

  const std::string& path_;
  const ZooMesh& mesh_;
  std::array<std::optional<WrittenType>, kKindCount> types_;
  std::optional<double> time_;
  std::vector<std::string> notes_;
};

}  // namespace

std::vector<std::string> write_msh(const std::string& path, const ZooMesh& mesh) {
  return MshWriter(path, mesh).run();
}

}  // namespace hiac::formats::gmsh

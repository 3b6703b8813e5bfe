// The layout is that of the CalculiX GraphiX manual (cgx, "Result Format"): Fortran columns, or
// lines of text followed by binary blocks.
#include "formats/calculix/frd_file.hpp"

#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "formats/calculix/frd_records.hpp"
#include "formats/calculix/frd_results.hpp"
#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/io/bytes_behind.hpp"

namespace hiac::formats::frd {
namespace {

std::vector<ForeignType> element_types() {
  // cgx numbers its element types from 1
  return {{"he8", 8, solid_conversion(CellKind::brick8)},
          {"pe6", 6, solid_conversion(CellKind::prism6)},
          {"te4", 4, solid_conversion(CellKind::tetrahedron4)},
          {"he20", 20, vertical_edges_first(CellKind::brick20)},
          {"pe15", 15, vertical_edges_first(CellKind::prism15)},
          {"te10", 10, solid_conversion(CellKind::tetrahedron10)},
          {"tr3", 3, kNoVolume},
          {"tr6", 6, kNoVolume},
          {"qu4", 4, kNoVolume},
          {"qu8", 8, kNoVolume},
          {"be2", 2, kNoVolume},
          {"be3", 3, kNoVolume}};
}

class FrdReader {
 public:
  explicit FrdReader(const std::shared_ptr<InputText>& text)
      : text_(text), cursor_(text->text(), text->path()) {
    mesh_.types = element_types();
  }

  ForeignMesh run() {
    while (!cursor_.at_end() && read_line()) {
    }
    note_text_behind(cursor_.text().substr(cursor_.offset()), "the line 9999", mesh_.notes);
    if (!have_nodes_ || !have_elements_)
      cursor_.fail(fmt::format("the file ends too early (a block of {} expected)",
                               have_nodes_ ? "elements, '    3C'" : "nodes, '    2C'"));
    add_material_blocks();
    results_.add_to(mesh_, text_);
    return std::move(mesh_);
  }

 private:
  /// Reads one line and the block that it begins; false at the end mark.
  bool read_line() {
    const std::size_t start = cursor_.offset();
    const std::string_view line = cursor_.line();
    const std::string_view key = trimmed(columns(line, 0, 5));
    const char code = line.size() > 5 ? line[5] : ' ';
    if (key == "9999") return false;
    if (trimmed(line).empty() || key == "1") return true;
    if (code != 'C' || (key != "2" && key != "3" && key != "100"))
      cursor_.fail_at(start, fmt::format("a block '    2C', '    3C' or '  100C' expected ({} "
                                         "found)",
                                         shown(line)));
    const Encoding encoding = encoding_of(line, start);
    constexpr std::size_t kCountColumn = 24;
    // a mark ends a text block, so programs other than CalculiX leave its count out
    const std::string_view counted = columns(line, kCountColumn, 12);
    const bool left_out = is_text(encoding) && trimmed(counted).empty();
    const auto count = left_out ? std::optional<std::int64_t>(0) : to_integer(counted);
    if (!count || *count < 0)
      cursor_.fail_at(start, fmt::format("a number of records in columns 25 to 36 expected ({} "
                                         "found)",
                                         shown(counted)));
    const auto records = static_cast<std::size_t>(*count);
    if (key == "2")
      read_nodes(records, encoding);
    else if (key == "3")
      read_elements(records, encoding);
    else
      results_.read(cursor_, line, start, records, encoding, mesh_.times);
    return true;
  }

  Encoding encoding_of(std::string_view line, std::size_t start) const {
    const std::string_view written = columns(line, 73, 2);
    // programs other than CalculiX leave the format number out in blocks of long text
    if (trimmed(written).empty()) return Encoding::long_text;
    const auto number = to_integer(written);
    if (!number || *number < 0 || *number > 3)
      cursor_.fail_at(start, fmt::format("a format number 0 to 3 in columns 74 and 75 expected ({} "
                                         "found)",
                                         shown(written)));
    return static_cast<Encoding>(*number);
  }

  void read_nodes(std::size_t count, Encoding encoding) {
    have_nodes_ = true;
    Records records(cursor_, encoding);
    std::array<double, 3> point{};
    const auto add = [&] {
      mesh_.node_numbers.push_back(records.read(3, point.data()));
      mesh_.xyz.insert(mesh_.xyz.end(), point.begin(), point.end());
    };
    if (is_text(encoding)) {
      while (records.next_text_record()) add();
      return;
    }
    require_records(cursor_, count <= cursor_.left() / records.binary_bytes(3), count);
    for (std::size_t i = 0; i < count; ++i) add();
  }

  void read_elements(std::size_t count, Encoding encoding) {
    have_elements_ = true;
    if (is_text(encoding)) {
      Records records(cursor_, encoding);
      while (records.next_text_record()) read_text_element(encoding);
      return;
    }
    constexpr std::size_t kHeadBytes = 16;
    require_records(cursor_, count <= cursor_.left() / kHeadBytes, count);
    for (std::size_t i = 0; i < count; ++i) {
      std::array<std::int64_t, 4> head{};
      for (std::int64_t& number : head) number = binary_integer();
      begin_element(head[0], head[1], fmt::format("{}", head[3]), cursor_.offset());
      for (std::size_t n = 0; n < mesh_.types[mesh_.cell_types.back()].nodes; ++n)
        mesh_.cell_nodes.push_back(binary_integer());
    }
  }

  std::int64_t binary_integer() {
    std::int32_t number = 0;
    std::memcpy(&number, cursor_.bytes(sizeof(number), "an element").data(), sizeof(number));
    return number;
  }

  void begin_element(std::int64_t number, std::int64_t type, const std::string& material,
                     std::size_t start) {
    if (type < 1 || static_cast<std::size_t>(type) > mesh_.types.size())
      cursor_.fail_at(start, fmt::format("element {}: an element type 1 to {} expected ({} found)",
                                         number, mesh_.types.size(), type));
    const std::size_t cell = mesh_.cell_count();
    mesh_.cell_numbers.push_back(number);
    mesh_.cell_types.push_back(static_cast<std::uint16_t>(type - 1));
    std::vector<IndexRange>& cells = materials_[material];
    if (!cells.empty() && cells.back().end == cell)
      ++cells.back().end;
    else
      cells.push_back({cell, cell + 1});
  }

  void read_text_element(Encoding encoding) {
    const std::size_t width = encoding == Encoding::short_text ? 5 : 10;
    const std::size_t start = cursor_.offset();
    std::string_view line = cursor_.line();
    const std::int64_t number = integer_in(columns(line, 3, width), start);
    const std::int64_t type = integer_in(columns(line, 3 + width, 5), start);
    // a material is a number, a name, or missing
    const std::string_view material = trimmed(columns(line, 3 + width + 10, 5));
    begin_element(number, type, material.empty() ? "0" : std::string(material), start);
    const std::size_t in_line = encoding == Encoding::short_text ? 15 : 10;
    const std::size_t nodes = mesh_.types[mesh_.cell_types.back()].nodes;
    for (std::size_t n = 0; n < nodes; ++n) {
      const std::size_t line_start = cursor_.offset();
      if (n % in_line == 0) {
        line = cursor_.line();
        if (trimmed(columns(line, 0, 3)) != "-2")
          cursor_.fail_at(line_start,
                          fmt::format("the nodes of element {} (' -2') expected ({} found)", number,
                                      shown(line)));
      }
      mesh_.cell_nodes.push_back(
          integer_in(columns(line, 3 + width * (n % in_line), width), start));
    }
  }

  std::int64_t integer_in(std::string_view text, std::size_t start) const {
    const auto number = to_integer(text);
    if (!number)
      cursor_.fail_at(start, fmt::format("an integer of {} columns expected ({} found)",
                                         text.size(), shown(text)));
    return *number;
  }

  void add_material_blocks() {
    for (auto& [material, cells] : materials_)
      mesh_.blocks.push_back({fmt::format("material {}", material), std::move(cells)});
  }

  std::shared_ptr<InputText> text_;
  TextCursor cursor_;
  ForeignMesh mesh_;
  bool have_nodes_ = false;
  bool have_elements_ = false;
  std::map<std::string, std::vector<IndexRange>> materials_;
  Results results_;
};

}  // namespace

ForeignMesh read_frd(const std::shared_ptr<InputText>& text) { return FrdReader(text).run(); }

}  // namespace hiac::formats::frd

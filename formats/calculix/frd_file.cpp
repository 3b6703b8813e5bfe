// The layout is that of the CalculiX GraphiX manual (cgx, "Result Format"): Fortran columns, or
// lines of text followed by binary blocks.
#include "formats/calculix/frd_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/calculix/frd_records.hpp"
#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/io/number_index.hpp"

namespace hiac::formats::frd {
namespace {

constexpr std::size_t kMostComponents = 200;

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

/// A result block: its values, and where they begin.
struct ResultBlock {
  std::string name;
  std::size_t components = 0;
  std::size_t records = 0;  ///< of binary blocks
  Encoding encoding{};
  std::size_t offset = 0;
};

class FrdReader {
 public:
  explicit FrdReader(const std::shared_ptr<InputText>& text)
      : text_(text), cursor_(text->text(), text->path()) {
    mesh_.types = element_types();
  }

  ForeignMesh run() {
    while (!cursor_.at_end() && read_line()) {
    }
    if (!have_nodes_ || !have_elements_)
      cursor_.fail(fmt::format("the file ends too early (a block of {} expected)",
                               have_nodes_ ? "elements, '    3C'" : "nodes, '    2C'"));
    add_material_blocks();
    add_fields();
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
      read_result(line, start, records, encoding);
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

  void require(bool fits, std::size_t records) const {
    if (!fits)
      cursor_.fail(fmt::format("{} records announced, more than the file can hold", records));
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
    require(count <= cursor_.left() / records.binary_bytes(3), count);
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
    require(count <= cursor_.left() / kHeadBytes, count);
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

  /// "100CL": the head of a result block, its components (-4, -5), and its values, which are
  /// skipped.
  void read_result(std::string_view line, std::size_t start, std::size_t count, Encoding encoding) {
    const auto value = to_real(columns(line, 12, 12));
    if (!value || !std::isfinite(*value))
      cursor_.fail_at(start, fmt::format("a time in columns 13 to 24 expected ({} found)",
                                         shown(columns(line, 12, 12))));
    const std::int64_t number = to_integer(columns(line, 58, 5)).value_or(0);
    ResultBlock block;
    block.encoding = encoding;
    block.records = count;
    read_components(block);
    block.offset = cursor_.offset();
    if (is_text(encoding)) {
      step_over_text();
    } else {
      const std::size_t bytes = Records(cursor_, encoding).binary_bytes(block.components);
      require(count <= cursor_.left() / bytes, count);
      cursor_.bytes(count * bytes, "values");
    }
    if (block.components > 0) blocks_.emplace_back(step_of(*value, number, block.name), block);
  }

  void read_components(ResultBlock& block) {
    const std::size_t start = cursor_.offset();
    const std::string_view head = cursor_.line();
    const auto announced = to_integer(columns(head, 13, 5));
    if (trimmed(columns(head, 0, 3)) != "-4" || !announced || *announced < 0 ||
        *announced > static_cast<std::int64_t>(kMostComponents))
      cursor_.fail_at(start, fmt::format("the name and number of components (' -4') expected ({} "
                                         "found)",
                                         shown(head)));
    block.name = trimmed(columns(head, 5, 8));
    for (std::int64_t c = 0; c < *announced; ++c) {
      const std::size_t at = cursor_.offset();
      const std::string_view line = cursor_.line();
      if (trimmed(columns(line, 0, 3)) != "-5")
        cursor_.fail_at(at, fmt::format("a component (' -5') expected ({} found)", shown(line)));
      // cgx computes some components itself (magnitudes): the file does not contain them
      if (to_integer(columns(line, 33, 5)).value_or(0) == 0) ++block.components;
    }
  }

  void step_over_text() {
    const std::string_view rest = cursor_.text().substr(cursor_.offset());
    const std::size_t end = rest.starts_with(" -3") ? 0 : rest.find("\n -3");
    if (end == std::string_view::npos) cursor_.fail("the file ends too early (' -3' expected)");
    cursor_.move_to(cursor_.offset() + end + (end == 0 ? 0 : 1));
    cursor_.line();
  }

  /// Steps differ in their time or, as mode shapes of one frequency do, in their number.
  std::size_t step_of(double time, std::int64_t number, const std::string& name) {
    std::size_t step = 0;
    while (step < steps_.size() &&
           (steps_[step] != std::pair(time, number) || seen_.contains({step, name})))
      ++step;
    if (step == steps_.size()) {
      steps_.emplace_back(time, number);
      mesh_.times.push_back(time);
    }
    seen_.insert({step, name});
    return step;
  }

  void add_material_blocks() {
    for (auto& [material, cells] : materials_)
      mesh_.blocks.push_back({fmt::format("material {}", material), std::move(cells)});
  }

  void add_fields() {
    if (blocks_.empty()) return;
    const auto index = std::make_shared<NumberIndex>(mesh_.node_numbers);
    const std::size_t points = mesh_.point_count();
    for (const auto& [step, block] : blocks_) look_for_strays(*index, block);
    if (!strays_.empty())
      mesh_.notes.push_back(
          fmt::format("left out values of {} nodes that the file does not have, "
                      "the first of them is node {}",
                      strays_.size(), *strays_.begin()));
    for (const auto& [step, block] : blocks_) {
      ForeignField field;
      field.name = block.name;
      field.components = static_cast<std::uint32_t>(block.components);
      field.step = step;
      field.values = [text = text_, index, points, part = block] {
        return read_values(*text, *index, points, part);
      };
      mesh_.fields.push_back(std::move(field));
    }
  }

  /// Collects the numbers in a block that no node has. Malformed numbers are refused when the
  /// values are read.
  void look_for_strays(const NumberIndex& index, const ResultBlock& block) {
    const auto look_at = [&](std::int64_t number) {
      if (index.find(number) == NumberIndex::kNone) strays_.insert(number);
    };
    TextCursor cursor(text_->text(), text_->path());
    cursor.move_to(block.offset);
    if (is_text(block.encoding)) {
      const std::size_t width = block.encoding == Encoding::short_text ? 5 : 10;
      for (std::string_view line = cursor.line(); trimmed(columns(line, 0, 3)) != "-3";
           line = cursor.line()) {
        const auto number = to_integer(columns(line, 3, width));
        if (trimmed(columns(line, 0, 3)) == "-1" && number) look_at(*number);
      }
      return;
    }
    const std::size_t bytes = Records(cursor, block.encoding).binary_bytes(block.components);
    for (std::size_t i = 0; i < block.records; ++i) {
      std::int32_t number = 0;
      std::memcpy(&number, cursor.bytes(bytes, "a value").data(), sizeof number);
      look_at(number);
    }
  }

  static std::vector<double> read_values(const InputText& text, const NumberIndex& index,
                                         std::size_t points, const ResultBlock& block) {
    TextCursor cursor(text.text(), text.path());
    cursor.move_to(block.offset);
    Records records(cursor, block.encoding);
    std::vector<double> values(points * block.components, std::numeric_limits<double>::quiet_NaN());
    std::vector<double> tuple(block.components);
    const auto read = [&] {
      const std::int64_t number = records.read(block.components, tuple.data());
      const std::size_t place = index.find(number);
      if (place == NumberIndex::kNone) return;  // a note tells of it
      std::copy(tuple.begin(), tuple.end(),
                values.begin() + static_cast<std::ptrdiff_t>(place * block.components));
    };
    if (is_text(block.encoding)) {
      while (records.next_text_record()) read();
    } else {
      for (std::size_t i = 0; i < block.records; ++i) read();
    }
    return values;
  }

  std::shared_ptr<InputText> text_;
  TextCursor cursor_;
  ForeignMesh mesh_;
  bool have_nodes_ = false;
  bool have_elements_ = false;
  std::map<std::string, std::vector<IndexRange>> materials_;
  std::vector<std::pair<std::size_t, ResultBlock>> blocks_;  ///< with their steps
  std::vector<std::pair<double, std::int64_t>> steps_;
  std::set<std::pair<std::size_t, std::string>> seen_;
  std::set<std::int64_t> strays_;  ///< nodes that have values and no place
};

}  // namespace

ForeignMesh read_frd(const std::shared_ptr<InputText>& text) { return FrdReader(text).run(); }

}  // namespace hiac::formats::frd

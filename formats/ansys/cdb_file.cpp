// The layout of the blocks: Ansys Mechanical APDL Programmer's Reference, "Mapping of the coded
// database file": NBLOCK, EBLOCK, CMBLOCK.
#include "formats/ansys/cdb_file.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "formats/ansys/cdb_commands.hpp"
#include "formats/ansys/cdb_elements.hpp"
#include "formats/ansys/cdb_model.hpp"
#include "formats/common/io/comma_fields.hpp"
#include "formats/common/io/number_index.hpp"
#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::ansys {
namespace {

/// Fields of an element's first line before its nodes.
constexpr std::size_t kHeadFields = 11;

/// The widths of "(3i8,6e20.13)": how many integers of which width, then reals of which width.
struct Layout {
  std::size_t integers = 0;
  std::size_t integer_width = 0;
  std::size_t real_width = 0;
};

class CdbReader {
 public:
  explicit CdbReader(const InputText& text)
      : cursor_(text.text(), text.path()), commands_(model_, cursor_) {}

  ForeignMesh run() {
    while (!cursor_.at_end()) read_line();
    commands_.finish(have_nodes_ || have_elements_);
    have_nodes_ |= commands_.any_nodes();
    have_elements_ |= commands_.any_elements();
    if (!have_nodes_ || !have_elements_)
      cursor_.fail(fmt::format("the file ends too early ({} expected)",
                               have_nodes_ ? "EBLOCK,19,SOLID or E or EN" : "NBLOCK or N"));
    const NumberIndex index(mesh_.cell_numbers);
    for (const auto& [name, numbers] : components_) add_block(name, numbers, index);
    return std::move(mesh_);
  }

 private:
  /// A line holds a command, or several separated by $; a comment follows !.
  void read_line() {
    const std::size_t start = cursor_.offset();
    std::string_view line = cursor_.line();
    line = line.substr(0, line.find('!'));
    while (true) {
      const std::size_t end = line.find('$');
      read_command(line.substr(0, end), start);
      if (end == std::string_view::npos) return;
      line.remove_prefix(end + 1);
    }
  }

  void read_command(std::string_view line, std::size_t start) {
    CommaFields fields(line);
    const std::string command = upper(fields.field());
    if (command == "ET") {
      const auto number = fields.integer();
      const auto routine = routine_in(fields.field());
      // in decks of blocks, parameters may give the types of contacts
      if (!number && (have_nodes_ || have_elements_)) return commands_.leave_out();
      if (!number || !routine)
        cursor_.fail_at(start, fmt::format("ET: a number and an element type expected ({} found)",
                                           shown(line)));
      model_.routines[*number] = *routine;
      if (!fields.at_end()) model_.shapes[*number] = fields.integer().value_or(0);
    } else if (command == "ETBLOCK") {
      read_types();
    } else if (command.starts_with("KEYO")) {
      const auto number = fields.integer();
      const auto key = fields.integer();
      const auto value = fields.integer();
      if (number && key == 1 && value) model_.shapes[*number] = *value;
    } else if (command == "NBLOCK") {
      read_nodes(start);
    } else if (command == "EBLOCK") {
      fields.field();
      if (upper(fields.field()) == "SOLID")
        read_elements(start);
      else
        skip_elements();
    } else if (command == "CMBLOCK") {
      read_component(fields, start);
    } else {
      commands_.command(command, fields, start, have_nodes_ || have_elements_);
    }
  }

  /// The number of an element routine, which may follow a name (SOLID186).
  static std::optional<std::int64_t> routine_in(std::string_view field) {
    const std::size_t digit = field.find_first_of("0123456789");
    return digit == std::string_view::npos ? std::nullopt : to_integer(field.substr(digit));
  }

  /// ETBLOCK: number, routine and options of every element type.
  void read_types() {
    const Layout layout = read_layout();
    while (true) {
      if (cursor_.at_end()) cursor_.fail("the file ends within ETBLOCK (a line -1 expected)");
      const std::size_t start = cursor_.offset();
      const std::string_view line = cursor_.line();
      if (ends_block(line)) return;
      const std::int64_t number = required_integer(line, 0, layout.integer_width, start);
      model_.routines[number] = required_integer(line, 1, layout.integer_width, start);
      if (const auto first = integer_in(line, 2, layout.integer_width, start))
        model_.shapes[number] = *first;
    }
  }

  /// The Fortran format in the line after a block's command.
  Layout read_layout() {
    const std::size_t start = cursor_.offset();
    std::string_view line = trimmed(cursor_.line());
    Layout layout;
    const auto number = [&line] {
      std::size_t value = 0;
      while (!line.empty() && line.front() >= '0' && line.front() <= '9' && value < 1000) {
        value = 10 * value + static_cast<std::size_t>(line.front() - '0');
        line.remove_prefix(1);
      }
      return value;
    };
    const std::string_view whole = line;
    if (line.starts_with('(')) {
      line.remove_prefix(1);
      layout.integers = number();
      if (!line.empty() && (line.front() == 'i' || line.front() == 'I')) {
        line.remove_prefix(1);
        layout.integer_width = number();
      }
      if (line.starts_with(',')) {
        line.remove_prefix(1);
        number();  // the number of reals: a line may have fewer
        if (!line.empty() && (line.front() == 'e' || line.front() == 'E')) {
          line.remove_prefix(1);
          layout.real_width = number();
        }
      }
    }
    if (layout.integers == 0 || layout.integer_width == 0)
      cursor_.fail_at(start, fmt::format("a format like (3i9,6e21.13e3) or (19i9) expected ({} "
                                         "found)",
                                         shown(whole)));
    return layout;
  }

  /// Field `i` of the given width; none when the line is shorter or the field is blank.
  std::optional<std::int64_t> integer_in(std::string_view line, std::size_t i, std::size_t width,
                                         std::size_t start) const {
    const std::size_t at = i * width;
    if (at >= line.size()) return std::nullopt;
    const std::string_view field = line.substr(at, width);
    if (trimmed(field).empty()) return std::nullopt;
    const auto value = to_integer(field);
    if (!value)
      cursor_.fail_at(start, fmt::format("an integer in columns {} to {} expected ({} found)",
                                         at + 1, at + width, shown(field)));
    return value;
  }

  std::int64_t required_integer(std::string_view line, std::size_t i, std::size_t width,
                                std::size_t start) const {
    const auto value = integer_in(line, i, width, start);
    if (!value)
      cursor_.fail_at(start, fmt::format("an integer in columns {} to {} expected (the line ends)",
                                         i * width + 1, (i + 1) * width));
    return *value;
  }

  /// Whether a line ends a block: "-1", or "N,R5.3,LOC,-1" of blocks of nodes.
  static bool ends_block(std::string_view line) {
    const std::string_view rest = trimmed(line);
    return rest == "-1" || rest.starts_with("-1,") || starts_with_upper(rest, "N,");
  }

  void read_nodes(std::size_t block) {
    have_nodes_ = true;
    const Layout layout = read_layout();
    if (layout.real_width == 0)
      cursor_.fail_at(block, "NBLOCK: a format with reals, like (3i9,6e21.13e3), expected");
    while (true) {
      if (cursor_.at_end()) cursor_.fail("the file ends within NBLOCK (a line -1 expected)");
      const std::size_t start = cursor_.offset();
      const std::string_view line = cursor_.line();
      if (ends_block(line)) return;
      mesh_.node_numbers.push_back(required_integer(line, 0, layout.integer_width, start));
      const std::size_t reals = layout.integers * layout.integer_width;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = reals + c * layout.real_width;
        const std::string_view field =
            at < line.size() ? line.substr(at, layout.real_width) : std::string_view();
        // zeros at the end of a line are left out
        const auto value = trimmed(field).empty() ? std::optional<double>(0.0) : to_real(field);
        if (!value)
          cursor_.fail_at(start, fmt::format("a coordinate in columns {} to {} expected ({} found)",
                                             at + 1, at + layout.real_width, shown(field)));
        mesh_.xyz.push_back(*value);
      }
    }
  }

  void skip_elements() {
    std::size_t skipped = 0;
    while (!cursor_.at_end()) {
      if (ends_block(cursor_.line())) {
        mesh_.notes.push_back(
            fmt::format("left out an EBLOCK that is not of solids ({} lines)", skipped));
        return;
      }
      ++skipped;
    }
    cursor_.fail("the file ends within EBLOCK (a line -1 expected)");
  }

  void read_elements(std::size_t block) {
    have_elements_ = true;
    const Layout layout = read_layout();
    if (layout.integers <= kHeadFields)
      cursor_.fail_at(block, fmt::format("EBLOCK: a format of more than {} integers expected ({} "
                                         "found)",
                                         kHeadFields, layout.integers));
    while (true) {
      if (cursor_.at_end()) cursor_.fail("the file ends within EBLOCK (a line -1 expected)");
      const std::size_t start = cursor_.offset();
      const std::string_view line = cursor_.line();
      if (ends_block(line)) return;
      read_element(line, start, layout);
    }
  }

  void read_element(std::string_view line, std::size_t start, const Layout& layout) {
    const std::size_t width = layout.integer_width;
    const std::int64_t count = required_integer(line, 8, width, start);
    if (count < 1 || count > static_cast<std::int64_t>(kMostNodes))
      cursor_.fail_at(start, fmt::format("an element's number of nodes: impossible (1 to {} "
                                         "expected, {} found)",
                                         kMostNodes, count));
    const std::int64_t number = required_integer(line, kHeadFields - 1, width, start);
    const std::int64_t type = required_integer(line, 1, width, start);
    std::array<std::int64_t, kMostNodes> nodes{};
    std::size_t field = kHeadFields;
    for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n, ++field) {
      if (field == layout.integers) {
        start = cursor_.offset();
        line = cursor_.line();
        field = 0;
      }
      const std::int64_t node = required_integer(line, field, width, start);
      nodes[n] = node == 0 ? kLeftOutNode : node;
    }
    model_.add_element(type, number, std::span(nodes).first(static_cast<std::size_t>(count)));
  }

  /// CMBLOCK,NAME,ELEM,COUNT: numbers; a negative number ends a range that begins with the number
  /// before it.
  void read_component(CommaFields& fields, std::size_t block) {
    const std::string name(fields.field());
    const bool elements = starts_with_upper(fields.field(), "ELEM");
    const std::string_view text = fields.field();
    const auto count = to_integer(text.substr(0, text.find('!')));
    if (!count || *count < 0)
      cursor_.fail_at(block,
                      fmt::format("CMBLOCK: a number of items expected ({} found)", shown(text)));
    const Layout layout = read_layout();
    std::vector<std::int64_t> numbers;
    std::string_view line;
    std::size_t start = 0;
    for (std::int64_t i = 0; i < *count; ++i) {
      const std::size_t field = static_cast<std::size_t>(i) % layout.integers;
      if (field == 0) {
        if (cursor_.at_end()) cursor_.fail("the file ends within CMBLOCK");
        start = cursor_.offset();
        line = cursor_.line();
      }
      numbers.push_back(required_integer(line, field, layout.integer_width, start));
    }
    if (elements) components_.emplace_back(name, std::move(numbers));
  }

  void add_block(const std::string& name, const std::vector<std::int64_t>& numbers,
                 const NumberIndex& index) {
    ForeignBlock block{name, {}};
    const auto add = [&](std::size_t cell) {
      if (!block.cells.empty() && block.cells.back().end == cell)
        ++block.cells.back().end;
      else
        block.cells.push_back({cell, cell + 1});
    };
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (numbers[i] >= 0) {
        if (const std::size_t cell = index.find(numbers[i]); cell != NumberIndex::kNone) add(cell);
        continue;
      }
      if (i == 0) continue;
      for (std::size_t cell = 0; cell < mesh_.cell_count(); ++cell)
        if (mesh_.cell_numbers[cell] > numbers[i - 1] && mesh_.cell_numbers[cell] <= -numbers[i])
          add(cell);
    }
    mesh_.blocks.push_back(std::move(block));
  }

  TextCursor cursor_;
  CdbModel model_;
  ForeignMesh& mesh_ = model_.mesh;
  CdbCommands commands_;
  bool have_nodes_ = false;
  bool have_elements_ = false;
  std::vector<std::pair<std::string, std::vector<std::int64_t>>> components_;
};

}  // namespace

ForeignMesh read_cdb(const InputText& text) { return CdbReader(text).run(); }

}  // namespace hiac::formats::ansys

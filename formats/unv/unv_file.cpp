#include "formats/unv/unv_file.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/common/io/number_index.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/unv/unv_elements.hpp"
#include "formats/unv/unv_results.hpp"

namespace hiac::formats::unv {
namespace {

constexpr std::size_t kColumns = 10;
constexpr std::int64_t kElementsInGroup = 8;
constexpr std::int64_t kMostUnits = 10;

class UnvReader {
 public:
  explicit UnvReader(const std::shared_ptr<InputText>& text)
      : text_(text), cursor_(text->text(), text->path()) {}

  ForeignMesh run() {
    while (next_dataset()) {
    }
    if (mesh_.node_numbers.empty())
      cursor_.fail("no nodes found (dataset 15, 781 or 2411 expected)");
    if (!left_out_.empty())
      mesh_.notes.push_back(fmt::format("left out datasets {}", fmt::join(left_out_, ", ")));
    if (stray_lines_ > 0)
      mesh_.notes.push_back(fmt::format("left out {} lines that are in no dataset", stray_lines_));
    add_groups();
    add_results(std::move(results_), text_, mesh_);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] static bool is_mark(std::string_view line) {
    return line.starts_with("    -1") && trimmed(line) == "-1";
  }

  /// Reads one dataset, from the line -1 to the line -1.
  bool next_dataset() {
    while (!cursor_.at_end() && !is_mark(cursor_.peek_line()))
      if (!trimmed(cursor_.line()).empty()) ++stray_lines_;
    if (cursor_.at_end()) return false;
    cursor_.line();
    // an end mark that does not begin a dataset
    if (cursor_.at_end()) return false;
    const std::size_t start = cursor_.offset();
    const std::string_view line = cursor_.line();
    // binary variants (58b) have further words after the number
    const auto dataset = to_integer(line.substr(0, 6));
    if (!dataset)
      cursor_.fail_at(start,
                      fmt::format("the number of a dataset expected ({} found)", shown(line)));
    const std::size_t begin = cursor_.offset();
    end_ = find_end(start);
    read_dataset(*dataset);
    if (cursor_.offset() > end_)
      cursor_.fail_at(begin, fmt::format("dataset {} ends within a record", *dataset));
    cursor_.move_to(end_);
    cursor_.line();
    return true;
  }

  std::size_t find_end(std::size_t start) const {
    TextCursor look = cursor_;
    const std::string_view text = cursor_.text();
    std::size_t at = cursor_.offset();
    if (at > 0) --at;
    while (true) {
      at = text.find("\n    -1", at);
      if (at == std::string_view::npos)
        cursor_.fail_at(start, "the file ends within a dataset ('    -1' expected)");
      ++at;
      look.move_to(at);
      if (is_mark(look.line())) return at;
    }
  }

  void read_dataset(std::int64_t dataset) {
    switch (dataset) {
      case 15:
      case 781:
      case 2411:
        return read_nodes(dataset == 15);
      case 780:
      case 2412:
        return read_elements(dataset == 780);
      case 164:
        return read_units();
      case 2435:
      case 2452:
      case 2467:
      case 2477:
        return read_groups();
      case 55:
      case 2414:
        if (auto result = read_result_head(cursor_, dataset, end_, mesh_.notes))
          results_.push_back(std::move(*result));
        return;
      case 151:
      case 2420:
        return;  // the header, and coordinate systems (nodes are in the global one)
      default:
        left_out_.insert(dataset);
    }
  }

  [[nodiscard]] bool at_end() const { return cursor_.offset() >= end_; }

  std::int64_t integer_at(std::string_view line, std::size_t i, std::size_t start) const {
    const std::size_t at = i * kColumns;
    const std::string_view field =
        at < line.size() ? line.substr(at, kColumns) : std::string_view();
    const auto value = to_integer(field);
    if (!value)
      cursor_.fail_at(start, fmt::format("an integer in columns {} to {} expected ({} found)",
                                         at + 1, at + kColumns, shown(field)));
    return *value;
  }

  void read_nodes(bool one_line) {
    while (!at_end()) {
      const std::size_t start = cursor_.offset();
      const std::string_view line = cursor_.peek_line();
      mesh_.node_numbers.push_back(integer_at(line, 0, start));
      if (one_line)
        cursor_.move_to(start + std::min(4 * kColumns, line.size()));
      else
        cursor_.line();
      for (int c = 0; c < 3; ++c) mesh_.xyz.push_back(cursor_.real("a coordinate"));
      cursor_.line();
    }
  }

  void read_elements(bool old) {
    const std::size_t nodes_field = old ? 7 : 5;
    while (!at_end()) {
      const std::size_t start = cursor_.offset();
      const std::string_view line = cursor_.line();
      const std::int64_t number = integer_at(line, 0, start);
      const std::int64_t nodes = integer_at(line, nodes_field, start);
      const UnvElement& element = element_of(integer_at(line, 1, start), nodes, start);
      if (nodes != static_cast<std::int64_t>(element.type.nodes))
        cursor_.fail_at(start, fmt::format("element {}: a {} has {} nodes ({} found)", number,
                                           element.type.name, element.type.nodes, nodes));
      mesh_.cell_types.push_back(types_[integer_at(line, 1, start)]);
      mesh_.cell_numbers.push_back(number);
      if (element.is_beam) cursor_.line();
      read_element_nodes(element.type.nodes);
    }
  }

  void read_element_nodes(std::size_t nodes) {
    constexpr std::size_t kNodesInLine = 8;
    std::size_t start = 0;
    std::string_view line;
    for (std::size_t n = 0; n < nodes; ++n) {
      if (n % kNodesInLine == 0) {
        start = cursor_.offset();
        line = cursor_.line();
      }
      mesh_.cell_nodes.push_back(integer_at(line, n % kNodesInLine, start));
    }
  }

  const UnvElement& element_of(std::int64_t descriptor, std::int64_t nodes, std::size_t start) {
    const auto known = elements_.find(descriptor);
    if (known != elements_.end() && !open_.contains(descriptor)) return known->second;
    auto element = unv_element(descriptor);
    if (!element) {
      // springs, dampers, gaps, rigid bodies: the file gives the number of nodes
      if (nodes < 0 || static_cast<std::uint64_t>(nodes) > cursor_.left())
        cursor_.fail_at(start, fmt::format("{} nodes of an element announced", nodes));
      element = UnvElement{
          {fmt::format("descriptor {}", descriptor), static_cast<std::size_t>(nodes), kNoVolume},
          false};
      open_.insert(descriptor);
    }
    types_[descriptor] =
        mesh_.type_place(element->type.name, element->type.nodes, element->type.conversion);
    return elements_.insert_or_assign(descriptor, std::move(*element)).first->second;
  }

  void read_units() {
    const std::size_t start = cursor_.offset();
    const std::string_view line = cursor_.line();
    // the name may follow the columns of the code at once, but some programs write the code further
    // to the right: a word that is a number is the code
    TextCursor words(line, cursor_.subject());
    const std::string_view word = words.word();
    const bool alone = to_integer(word).has_value();
    const std::int64_t code = to_integer(alone ? word : line.substr(0, kColumns)).value_or(0);
    if (code < 1 || code > kMostUnits)
      cursor_.fail_at(start, fmt::format("unknown units (a code from 1 to {} expected, {} found)",
                                         kMostUnits, shown(word)));
    const std::size_t behind = alone ? std::max(words.offset(), kColumns) : kColumns;
    const std::string_view name =
        trimmed(line.size() > behind ? line.substr(behind, 2 * kColumns) : "");
    if (!name.empty()) mesh_.metadata.emplace_back("units", name);
  }

  void read_groups() {
    while (!at_end()) {
      const std::size_t start = cursor_.offset();
      const std::string_view line = cursor_.line();
      const std::int64_t group = integer_at(line, 0, start);
      const std::int64_t count = integer_at(line, 7, start);
      if (count < 0 || static_cast<std::uint64_t>(count) > cursor_.left())
        cursor_.fail_at(start, fmt::format("group {}: {} members announced", group, count));
      std::string name(trimmed(cursor_.line()));
      if (name.empty()) name = fmt::format("{}", group);
      std::vector<std::int64_t> cells;
      std::size_t member_start = 0;
      std::string_view members;
      for (std::int64_t i = 0; i < count; ++i) {
        if (i % 2 == 0) {
          member_start = cursor_.offset();
          members = cursor_.line();
        }
        const std::size_t field = i % 2 == 0 ? 0 : 4;
        if (integer_at(members, field, member_start) == kElementsInGroup)
          cells.push_back(integer_at(members, field + 1, member_start));
      }
      if (!cells.empty()) groups_.emplace_back(std::move(name), std::move(cells));
    }
  }

  void add_groups() {
    const NumberIndex index(mesh_.cell_numbers);
    for (const auto& [name, numbers] : groups_) {
      ForeignBlock block{name, {}};
      for (const std::int64_t number : numbers)
        if (const std::size_t cell = index.find(number); cell != NumberIndex::kNone)
          block.cells.push_back({cell, cell + 1});
      mesh_.blocks.push_back(std::move(block));
    }
  }

  std::shared_ptr<InputText> text_;
  TextCursor cursor_;
  ForeignMesh mesh_;
  std::size_t end_ = 0;  ///< the start of the dataset's last line
  std::map<std::int64_t, UnvElement> elements_;
  std::map<std::int64_t, std::uint16_t> types_;
  std::set<std::int64_t> open_;  ///< descriptors whose number of nodes is the file's
  std::vector<std::pair<std::string, std::vector<std::int64_t>>> groups_;
  std::vector<UnvResult> results_;
  std::set<std::int64_t> left_out_;
  std::size_t stray_lines_ = 0;
};

}  // namespace

ForeignMesh read_unv(const std::shared_ptr<InputText>& text) { return UnvReader(text).run(); }

}  // namespace hiac::formats::unv

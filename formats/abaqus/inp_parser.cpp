#include "formats/abaqus/inp_parser.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "formats/abaqus/inp_elements.hpp"
#include "formats/abaqus/inp_generation.hpp"
#include "formats/abaqus/inp_set_reader.hpp"
#include "formats/common/io/comma_fields.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/io/large_reserve.hpp"
#include "formats/common/io/named_file.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::abaqus {
namespace {

/// The limit of nested includes.
constexpr int kMostIncludes = 10;

class DeckReader {
 public:
  Model run(const std::string& path) {
    read_file(path, nullptr);
    keep_last_definitions(model_.root, model_.types);
    for (Part& part : model_.parts) keep_last_definitions(part, model_.types);
    return std::move(model_);
  }

 private:
  /// Reads a deck or, if `keyword` is given, a file that contains that keyword's data lines.
  void read_file(const std::string& path, const Keyword* keyword) {
    if (depth_ == kMostIncludes)
      throw InputError(path, fmt::format("files include files more than {} deep", kMostIncludes));
    ++depth_;
    const InputText text(path);
    TextCursor cursor(text.text(), path);
    if (keyword != nullptr) read_data(*keyword, cursor);
    while (!cursor.at_end()) {
      if (is_keyword(cursor.peek_line()))
        read_block(cursor, path);
      else
        cursor.line();
    }
    --depth_;
  }

  void read_block(TextCursor& cursor, const std::string& path) {
    const Keyword keyword = read_keyword(cursor);
    const std::string* input = keyword.value("INPUT");
    const bool takes_input = keyword.name == "INCLUDE" || keyword.name == "NODE" ||
                             keyword.name == "ELEMENT" || keyword.name == "ELSET" ||
                             keyword.name == "NSET";
    if (takes_input && input != nullptr) {
      const bool include = keyword.name == "INCLUDE";
      try {
        read_file(file_beside(path, *input), include ? nullptr : &keyword);
      } catch (const InputError& error) {
        cursor.fail_at(keyword.offset, fmt::format("in the included file: {}", error.what()));
      }
      return;
    }
    read_data(keyword, cursor);
  }

  /// Executes the keyword and reads its data lines.
  void read_data(const Keyword& keyword, TextCursor& cursor) {
    const std::string& name = keyword.name;
    if (name == "NODE") return read_nodes(keyword, cursor);
    if (name == "ELEMENT") return read_elements(keyword, cursor);
    if (name == "ELSET") return read_element_set(keyword, cursor, part(), model_);
    if (name == "NSET") return read_node_set(keyword, cursor, part());
    if (name == "PART") return begin_part(keyword, cursor);
    if (name == "INSTANCE") return begin_instance(keyword, cursor);
    if (name == "END PART" || name == "END INSTANCE") enter(std::nullopt);
    // *SYSTEM without data lines returns to the global system
    if (name == "SYSTEM") system_ = read_system(cursor);
    if (makes_mesh(name))
      generate({keyword, cursor, part(), model_.types, system_.has_value(), made_});
  }

  /// The following lines belong to that part; a *SYSTEM ends with the part that contains it.
  void enter(std::optional<std::size_t> part) {
    part_ = part;
    system_.reset();
  }

  Part& part() { return part_ ? model_.parts[*part_] : model_.root; }

  void add_part(const std::string& name) {
    model_.parts.emplace_back().name = name;
    enter(model_.parts.size() - 1);
  }

  void begin_part(const Keyword& keyword, const TextCursor& cursor) {
    add_part(required(keyword, "NAME", cursor));
  }

  /// The number of lines that the rest of the file can hold if all are as long as the next one.
  static std::size_t lines_left(const TextCursor& cursor) {
    constexpr std::size_t kShortest = 16;
    return cursor.left() / std::max(cursor.peek_line().size() + 1, kShortest) + 1;
  }

  void begin_instance(const Keyword& keyword, TextCursor& cursor) {
    Instance instance;
    instance.name = required(keyword, "NAME", cursor);
    const std::string* part = keyword.value("PART");
    // an instance without PART defines its own nodes and elements
    instance.part = part == nullptr ? instance.name : *part;
    if (const auto line = data_line(cursor)) {
      CommaFields fields(*line);
      for (double& x : instance.placement.translation) x = real_in(fields, cursor, *line);
      instance.placement.moved = true;
    }
    if (const auto line = data_line(cursor)) {
      CommaFields fields(*line);
      std::array<double, 7> data{};
      for (double& x : data) x = real_in(fields, cursor, *line);
      rotate(data, instance.placement);
    }
    if (part == nullptr) add_part(instance.name);
    model_.instances.push_back(std::move(instance));
  }

  void read_nodes(const Keyword& keyword, TextCursor& cursor) {
    const char kind = kind_of_system(keyword);
    const std::string* set = keyword.value("NSET");
    std::vector<NumberRange> numbers;
    Part& into = part();
    const std::size_t lines = lines_left(cursor);
    reserve_large(into.node_numbers, into.node_numbers.size() + lines);
    reserve_large(into.xyz, into.xyz.size() + 3 * lines);
    while (const auto line = data_line(cursor)) {
      CommaFields fields(*line);
      into.node_numbers.push_back(integer_in(fields, cursor, *line, "a node number"));
      if (set != nullptr) add_number(into.node_numbers.back(), numbers);
      Vector point{};
      for (double& x : point)
        if (!fields.at_end()) x = real_in(fields, cursor, *line);
      to_rectangular(kind, point);
      if (system_) point = placed(*system_, point.data());
      into.xyz.insert(into.xyz.end(), point.begin(), point.end());
    }
    if (set != nullptr && !set->empty()) add_ranges(numbers, set_named(into.node_sets, *set));
  }

  std::uint16_t place_of_type(const InpElement& element) {
    const auto known =
        std::find_if(model_.types.begin(), model_.types.end(),
                     [&](const ForeignType& other) { return other.name == element.type.name; });
    if (known != model_.types.end())
      return static_cast<std::uint16_t>(known - model_.types.begin());
    model_.types.push_back(element.type);
    return static_cast<std::uint16_t>(model_.types.size() - 1);
  }

  void read_elements(const Keyword& keyword, TextCursor& cursor) {
    const InpElement element = inp_element(upper(required(keyword, "TYPE", cursor)));
    const std::uint16_t type = place_of_type(element);
    Part& into = part();
    const std::size_t lines = lines_left(cursor);
    reserve_large(into.cell_numbers, into.cell_numbers.size() + lines);
    reserve_large(into.cell_types, into.cell_types.size() + lines);
    reserve_large(into.cell_nodes, into.cell_nodes.size() + lines * element.type.nodes);
    std::vector<NumberRange> numbers;
    while (const auto line = data_line(cursor)) {
      CommaFields fields(*line);
      const std::int64_t number = integer_in(fields, cursor, *line, "an element number");
      into.cell_numbers.push_back(number);
      into.cell_types.push_back(type);
      add_number(number, numbers);
      if (element.nodes_in_file > 0)
        read_element_nodes(element.nodes_in_file, fields, *line, cursor, into);
      else
        read_open_element(element.type.nodes, fields, *line, cursor, into);
    }
    const std::string* set = keyword.value("ELSET");
    if (set != nullptr && !set->empty()) add_ranges(numbers, set_named(into.sets, *set));
  }

  static void read_element_nodes(std::size_t nodes, CommaFields fields, std::string_view line,
                                 TextCursor& cursor, Part& into) {
    for (std::size_t n = 0; n < nodes; ++n) {
      if (fields.at_end()) {
        const auto next = data_line(cursor);
        if (!next)
          cursor.fail(fmt::format("element {}: {} nodes expected ({} found)",
                                  into.cell_numbers.back(), nodes, n));
        line = *next;
        fields = CommaFields(line);
      }
      add_node(fields, cursor, line, into);
    }
    if (!fields.at_end())
      refuse(cursor, line, fmt::format("element {}: {} nodes", into.cell_numbers.back(), nodes));
  }

  /// Solvers write 0 for a missing mid-edge node.
  static void add_node(CommaFields& fields, const TextCursor& cursor, std::string_view line,
                       Part& into) {
    const std::int64_t node = integer_in(fields, cursor, line, "a node number");
    into.cell_nodes.push_back(node == 0 ? kLeftOutNode : node);
  }

  /// Reads an element whose record continues as long as lines end in commas; its first nodes are
  /// kept.
  static void read_open_element(std::size_t kept, CommaFields fields, std::string_view line,
                                TextCursor& cursor, Part& into) {
    std::size_t nodes = 0;
    while (true) {
      while (!fields.at_end() && nodes < kept) {
        add_node(fields, cursor, line, into);
        ++nodes;
      }
      if (!trimmed(line).ends_with(',')) break;
      const auto next = data_line(cursor);
      if (!next) break;
      line = *next;
      fields = CommaFields(line);
    }
    if (nodes < kept)
      refuse(cursor, line,
             fmt::format("element {}: at least {} nodes", into.cell_numbers.back(), kept));
  }

  Model model_;
  std::optional<std::size_t> part_;  ///< place in Model::parts of the part that is read
  std::optional<Placement> system_;  ///< *SYSTEM: the system of node coordinates
  Made made_;
  int depth_ = 0;
};

}  // namespace

Model parse_deck(const std::string& path) { return DeckReader().run(path); }

}  // namespace hiac::formats::abaqus

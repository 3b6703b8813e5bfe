#include "formats/abaqus/inp_parser.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "formats/abaqus/inp_elements.hpp"
#include "formats/comma_fields.hpp"
#include "formats/input_text.hpp"
#include "formats/large_reserve.hpp"
#include "formats/named_file.hpp"
#include "formats/text_cursor.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::abaqus {
namespace {

/// Files may include files, not without end.
constexpr int kMostIncludes = 10;

std::string_view without_blanks_before(std::string_view line) {
  while (!line.empty() && TextCursor::is_space(line.front())) line.remove_prefix(1);
  return line;
}

/// Blanks before stars do not count.
bool is_comment(std::string_view line) { return without_blanks_before(line).starts_with("**"); }
bool is_keyword(std::string_view line) {
  const std::string_view rest = without_blanks_before(line);
  return rest.starts_with('*') && !rest.starts_with("**");
}

/// A line `*KEYWORD, NAME=VALUE, ...` with the lines that continue it.
struct Keyword {
  std::string name;                                             ///< in capitals, without the star
  std::vector<std::pair<std::string, std::string>> parameters;  ///< names in capitals
  std::size_t offset = 0;

  [[nodiscard]] const std::string* value(std::string_view parameter) const {
    for (const auto& [key, value] : parameters)
      if (key == parameter) return &value;
    return nullptr;
  }
};

std::string without_quotes(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  return std::string(text);
}

void add_parameters(std::string_view text, Keyword& keyword) {
  CommaFields fields(text);
  while (!fields.at_end()) {
    const std::string_view field = fields.field();
    const std::size_t equals = field.find('=');
    const std::string_view value =
        equals == std::string_view::npos ? std::string_view() : trimmed(field.substr(equals + 1));
    keyword.parameters.emplace_back(upper(trimmed(field.substr(0, equals))), without_quotes(value));
  }
}

Keyword read_keyword(TextCursor& cursor) {
  Keyword keyword;
  keyword.offset = cursor.offset();
  std::string_view line = trimmed(cursor.line()).substr(1);
  const std::size_t comma = line.find(',');
  keyword.name = upper(trimmed(line.substr(0, comma)));
  if (comma == std::string_view::npos) return keyword;
  add_parameters(line.substr(comma + 1), keyword);
  while (line.ends_with(',') && !cursor.at_end() && !is_keyword(cursor.peek_line())) {
    const std::string_view next = cursor.line();
    if (is_comment(next)) continue;
    line = trimmed(next);
    add_parameters(line, keyword);
  }
  return keyword;
}

/// The rotation about the axis from a to b by `degrees` (Abaqus: *INSTANCE, second data line),
/// after the translation.
void rotate(const std::array<double, 7>& data, Placement& placement) {
  std::array<double, 3> axis{};
  double length = 0;
  for (std::size_t c = 0; c < 3; ++c) axis[c] = data[3 + c] - data[c];
  for (const double x : axis) length = std::hypot(length, x);
  if (!(length > 0)) return;
  for (double& x : axis) x /= length;
  const double angle = data[6] * std::numbers::pi / 180;
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  // Rodrigues' formula
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      placement.rotation[3 * i + j] = (i == j ? cosine : 0) + (1 - cosine) * axis[i] * axis[j];
  for (std::size_t i = 0; i < 3; ++i) {
    placement.rotation[3 * i + (i + 1) % 3] -= sine * axis[(i + 2) % 3];
    placement.rotation[3 * i + (i + 2) % 3] += sine * axis[(i + 1) % 3];
  }
  // x -> R (x + t - a) + a
  std::array<double, 3> moved{};
  for (std::size_t i = 0; i < 3; ++i) {
    moved[i] = data[i];
    for (std::size_t j = 0; j < 3; ++j)
      moved[i] += placement.rotation[3 * i + j] * (placement.translation[j] - data[j]);
  }
  placement.translation = moved;
}

class DeckReader {
 public:
  Model run(const std::string& path) {
    read_file(path, nullptr);
    return std::move(model_);
  }

 private:
  /// Reads a deck, or, with `keyword`, a file that has that keyword's data lines.
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
                             keyword.name == "ELEMENT" || keyword.name == "ELSET";
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

  /// What the keyword does, and its data lines.
  void read_data(const Keyword& keyword, TextCursor& cursor) {
    const std::string& name = keyword.name;
    if (name == "NODE") return read_nodes(keyword, cursor);
    if (name == "ELEMENT") return read_elements(keyword, cursor);
    if (name == "ELSET") return read_set(keyword, cursor);
    if (name == "PART") return begin_part(keyword, cursor);
    if (name == "INSTANCE") return begin_instance(keyword, cursor);
    if (name == "END PART" || name == "END INSTANCE") part_.reset();
    static const std::set<std::string> kGenerators{"NGEN", "NFILL", "NCOPY",
                                                   "NMAP", "ELGEN", "ELCOPY"};
    // a system without data is the global one again
    if (kGenerators.contains(name) || (name == "SYSTEM" && data_line(cursor)))
      cursor.fail_at(
          keyword.offset,
          fmt::format("*{} makes nodes or elements that the file does not list, which is "
                      "not supported",
                      name));
  }

  Part& part() { return part_ ? model_.parts[*part_] : model_.root; }

  std::string required(const Keyword& keyword, std::string_view parameter,
                       const TextCursor& cursor) const {
    const std::string* value = keyword.value(parameter);
    if (value == nullptr || value->empty())
      cursor.fail_at(keyword.offset, fmt::format("*{} without {}", keyword.name, parameter));
    return *value;
  }

  void begin_part(const Keyword& keyword, const TextCursor& cursor) {
    model_.parts.push_back({required(keyword, "NAME", cursor), {}, {}, {}, {}, {}, {}});
    part_ = model_.parts.size() - 1;
  }

  /// How many lines there may be of the length of the next one, if the rest of the file is such.
  static std::size_t lines_left(const TextCursor& cursor) {
    constexpr std::size_t kShortest = 16;
    return cursor.left() / std::max(cursor.peek_line().size() + 1, kShortest) + 1;
  }

  /// The next data line; none where the next keyword begins or the file ends.
  static std::optional<std::string_view> data_line(TextCursor& cursor) {
    while (!cursor.at_end()) {
      const std::string_view line = cursor.peek_line();
      if (is_keyword(line)) return std::nullopt;
      cursor.line();
      if (!is_comment(line) && !trimmed(line).empty()) return line;
    }
    return std::nullopt;
  }

  void begin_instance(const Keyword& keyword, TextCursor& cursor) {
    Instance instance;
    instance.name = required(keyword, "NAME", cursor);
    const std::string* part = keyword.value("PART");
    // an instance of no part brings its own nodes and elements
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
    if (part == nullptr) {
      model_.parts.push_back({instance.name, {}, {}, {}, {}, {}, {}});
      part_ = model_.parts.size() - 1;
    }
    model_.instances.push_back(std::move(instance));
  }

  /// A line lies in the cursor's text: errors name it.
  [[noreturn]] static void refuse(const TextCursor& cursor, std::string_view line,
                                  std::string_view what) {
    cursor.fail_at(static_cast<std::size_t>(line.data() - cursor.text().data()),
                   fmt::format("{} expected ({} found)", what, shown(line)));
  }

  static double real_in(CommaFields& fields, const TextCursor& cursor, std::string_view line) {
    const auto value = fields.real();
    if (!value) refuse(cursor, line, "a real number");
    return *value;
  }

  static std::int64_t integer_in(CommaFields& fields, const TextCursor& cursor,
                                 std::string_view line, std::string_view what) {
    const auto value = fields.integer();
    if (!value) refuse(cursor, line, what);
    return *value;
  }

  void read_nodes(const Keyword& keyword, TextCursor& cursor) {
    const std::string* system = keyword.value("SYSTEM");
    const char kind = system == nullptr || system->empty() ? 'R' : upper(*system).front();
    Part& into = part();
    const std::size_t lines = lines_left(cursor);
    reserve_large(into.node_numbers, into.node_numbers.size() + lines);
    reserve_large(into.xyz, into.xyz.size() + 3 * lines);
    while (const auto line = data_line(cursor)) {
      CommaFields fields(*line);
      into.node_numbers.push_back(integer_in(fields, cursor, *line, "a node number"));
      std::array<double, 3> point{};
      for (double& x : point)
        if (!fields.at_end()) x = real_in(fields, cursor, *line);
      if (kind != 'R') to_rectangular(kind, point);
      into.xyz.insert(into.xyz.end(), point.begin(), point.end());
    }
  }

  /// *NODE, SYSTEM=C: radius, angle in degrees, z; SYSTEM=S: radius, azimuth, elevation.
  static void to_rectangular(char kind, std::array<double, 3>& point) {
    constexpr double kDegree = std::numbers::pi / 180;
    const double azimuth = point[1] * kDegree;
    const double elevation = kind == 'S' ? point[2] * kDegree : 0;
    const double radius = point[0];
    point[0] = radius * std::cos(azimuth) * std::cos(elevation);
    point[1] = radius * std::sin(azimuth) * std::cos(elevation);
    if (kind == 'S') point[2] = radius * std::sin(elevation);
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
    ElementSet numbers;
    while (const auto line = data_line(cursor)) {
      CommaFields fields(*line);
      const std::int64_t number = integer_in(fields, cursor, *line, "an element number");
      into.cell_numbers.push_back(number);
      into.cell_types.push_back(type);
      if (!numbers.empty() && numbers.back().last + 1 == number)
        numbers.back().last = number;
      else
        numbers.push_back({number, number, 1});
      if (element.nodes_in_file > 0)
        read_element_nodes(element.nodes_in_file, fields, *line, cursor, into);
      else
        read_open_element(element.type.nodes, fields, *line, cursor, into);
    }
    const std::string* set = keyword.value("ELSET");
    if (set != nullptr && !set->empty()) add_to_set(into.sets, *set, numbers);
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

  /// Solvers write 0 for a mid-edge node that there is not.
  static void add_node(CommaFields& fields, const TextCursor& cursor, std::string_view line,
                       Part& into) {
    const std::int64_t node = integer_in(fields, cursor, line, "a node number");
    into.cell_nodes.push_back(node == 0 ? kLeftOutNode : node);
  }

  /// An element whose record goes on as long as lines end in commas; its first nodes are kept.
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

  using Sets = std::map<std::string, std::pair<std::string, ElementSet>>;

  static void add_to_set(Sets& sets, const std::string& name, const ElementSet& elements) {
    auto& [written, all] = sets[upper(name)];
    if (written.empty()) written = name;
    all.insert(all.end(), elements.begin(), elements.end());
  }

  void read_set(const Keyword& keyword, TextCursor& cursor) {
    const std::string name = required(keyword, "ELSET", cursor);
    Sets* sets = &part().sets;
    const Sets* known = sets;
    if (const std::string* instance = keyword.value("INSTANCE")) {
      const auto found =
          std::find_if(model_.instances.begin(), model_.instances.end(),
                       [&](const Instance& i) { return upper(i.name) == upper(*instance); });
      if (found == model_.instances.end())
        cursor.fail_at(keyword.offset,
                       fmt::format("*ELSET: there is no instance {}", shown(*instance)));
      known = sets = &found->sets;
    }
    const bool generate = keyword.value("GENERATE") != nullptr;
    ElementSet elements;
    while (const auto line = data_line(cursor)) {
      CommaFields fields(*line);
      if (generate) {
        elements.push_back(generated(fields, cursor, *line));
        continue;
      }
      while (!fields.at_end()) add_member(fields.field(), *known, elements);
    }
    add_to_set(*sets, name, elements);
  }

  static NumberRange generated(CommaFields& fields, const TextCursor& cursor,
                               std::string_view line) {
    NumberRange range{integer_in(fields, cursor, line, "an element number"), 0, 1};
    range.last = integer_in(fields, cursor, line, "an element number");
    if (!fields.at_end()) range.step = integer_in(fields, cursor, line, "a step");
    if (range.step < 1 || range.last < range.first || range.first < 0)
      refuse(cursor, line, "first, last and step of a range");
    return range;
  }

  /// A number, or the name of a set that there is by now; others are of nodes or surfaces.
  static void add_member(std::string_view member, const Sets& known, ElementSet& elements) {
    if (const auto number = to_integer(member)) {
      if (!elements.empty() && elements.back().step == 1 && elements.back().last + 1 == *number)
        elements.back().last = *number;
      else
        elements.push_back({*number, *number, 1});
      return;
    }
    const auto set = known.find(upper(member));
    if (set == known.end()) return;
    const ElementSet copy = set->second.second;
    elements.insert(elements.end(), copy.begin(), copy.end());
  }

  Model model_;
  std::optional<std::size_t> part_;  ///< place in Model::parts of the part that is read
  int depth_ = 0;
};

}  // namespace

Model parse_deck(const std::string& path) { return DeckReader().run(path); }

}  // namespace hiac::formats::abaqus

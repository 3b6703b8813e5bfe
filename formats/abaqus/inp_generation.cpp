#include "formats/abaqus/inp_generation.hpp"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

#include "formats/common/io/deck_numbers.hpp"
#include "formats/common/mesh/last_definitions.hpp"

namespace hiac::formats::abaqus {
namespace {

/// The corners of a solid, and then the nodes of its edges, in the order that its mirror image
/// needs; empty for elements without volume.
std::span<const std::uint8_t> reflection(std::size_t nodes) {
  static constexpr std::array<std::uint8_t, 4> kTetrahedron{0, 2, 1, 3};
  static constexpr std::array<std::uint8_t, 10> kTetrahedron10{0, 2, 1, 3, 6, 5, 4, 7, 9, 8};
  static constexpr std::array<std::uint8_t, 5> kPyramid{0, 3, 2, 1, 4};
  static constexpr std::array<std::uint8_t, 6> kPrism{0, 2, 1, 3, 5, 4};
  static constexpr std::array<std::uint8_t, 15> kPrism15{0, 2,  1,  3, 5,  4,  8, 7,
                                                         6, 11, 10, 9, 12, 14, 13};
  static constexpr std::array<std::uint8_t, 8> kBrick{0, 3, 2, 1, 4, 7, 6, 5};
  static constexpr std::array<std::uint8_t, 20> kBrick20{0, 3, 2,  1,  4,  7,  6,  5,  11, 10,
                                                         9, 8, 15, 14, 13, 12, 16, 19, 18, 17};
  switch (nodes) {
    case 4:
      return kTetrahedron;
    case 5:
      return kPyramid;
    case 6:
      return kPrism;
    case 8:
      return kBrick;
    case 10:
      return kTetrahedron10;
    case 15:
      return kPrism15;
    case 20:
      return kBrick20;
    default:
      return {};
  }
}

void follow_cells(const Generation& g) {
  Part& part = g.part;
  part.made = true;
  part.cell_places.follow(part.cell_numbers);
  for (std::size_t cell = part.cell_begins.size(); cell < part.cell_types.size(); ++cell)
    part.cell_begins.push_back(
        cell == 0 ? 0 : part.cell_begins[cell - 1] + g.types[part.cell_types[cell - 1]].nodes);
}

/// Appends a copy of the element at `place` with its numbers shifted, and its nodes permuted if an
/// order is given.
void copy_element(const Generation& g, std::size_t place, std::int64_t number_shift,
                  std::int64_t node_shift, std::span<const std::uint8_t> order = {}) {
  Part& part = g.part;
  const std::uint16_t type = part.cell_types[place];
  const std::size_t nodes = g.types[type].nodes;
  part.cell_numbers.push_back(checked_number(g, part.cell_numbers[place]) + number_shift);
  part.cell_types.push_back(type);
  for (std::size_t n = 0; n < nodes; ++n) {
    const std::int64_t node =
        part.cell_nodes[part.cell_begins[place] + (order.empty() ? n : order[n])];
    part.cell_nodes.push_back(node == kLeftOutNode ? node : checked_number(g, node) + node_shift);
  }
}

/// How often something is repeated, and the increments of the numbers from one copy to the next.
struct Repetition {
  std::int64_t count = 1;
  std::int64_t nodes = 0;
  std::int64_t elements = 0;
};

/// A row, rows, layers: fields 2 to 10 of *ELGEN.
std::array<Repetition, 3> repetitions(CommaFields& fields, const Generation& g,
                                      std::string_view line) {
  std::array<Repetition, 3> all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Repetition& one = all[i];
    one.count = whole_in(fields, g.cursor, line, "*ELGEN: a number of elements, rows or layers", 1);
    if (one.count < 1) refuse(g.cursor, line, "*ELGEN: 1 element, row or layer or more");
    // increments within a row have a default; the others are required
    const auto otherwise = i == 0 || one.count == 1 ? std::optional<std::int64_t>(1) : std::nullopt;
    one.nodes = whole_in(fields, g.cursor, line, "*ELGEN: an increment of node numbers", otherwise);
    one.elements =
        whole_in(fields, g.cursor, line, "*ELGEN: an increment of element numbers", otherwise);
  }
  return all;
}

void generate_elements(const Generation& g) {
  std::vector<NumberRange> numbers;
  while (const auto line = data_line(g.cursor)) {
    follow_cells(g);
    CommaFields fields(*line);
    const std::int64_t master = whole_in(fields, g.cursor, *line, "*ELGEN: an element number");
    const auto place = g.part.cell_places.find(master);
    if (!place) refuse(g.cursor, *line, fmt::format("*ELGEN: an element {} before it", master));
    const auto [row, rows, layers] = repetitions(fields, g, *line);
    const std::size_t each = g.types[g.part.cell_types[*place]].nodes + 2;
    take(g, *line, each * static_cast<std::size_t>(row.count));
    // two factors of at most 1e9 each, then three that are below the limit
    take(g, *line,
         each * static_cast<std::size_t>(row.count) * static_cast<std::size_t>(rows.count - 1));
    take(g, *line,
         each * static_cast<std::size_t>(row.count * rows.count) *
             static_cast<std::size_t>(layers.count - 1));
    for (std::int64_t k = 0; k < layers.count; ++k)
      for (std::int64_t j = 0; j < rows.count; ++j)
        for (std::int64_t i = 0; i < row.count; ++i) {
          const std::int64_t shift = i * row.elements + j * rows.elements + k * layers.elements;
          add_number(master + shift, numbers);
          if (i + j + k > 0)
            copy_element(g, *place, shift, i * row.nodes + j * rows.nodes + k * layers.nodes);
        }
  }
  const std::string* set = g.keyword.value("ELSET");
  if (set != nullptr && !set->empty()) add_ranges(numbers, set_named(g.part.sets, *set));
}

void copy_elements(const Generation& g) {
  const std::int64_t element_shift = whole_parameter(g, "ELEMENTSHIFT");
  const std::int64_t node_shift = whole_parameter(g, "SHIFTNODES");
  const std::string name = required(g.keyword, "OLDSET", g.cursor);
  const auto old = g.part.sets.find(upper(name));
  if (old == g.part.sets.end())
    g.cursor.fail_at(g.keyword.offset,
                     fmt::format("*ELCOPY: there is no element set {} before it", shown(name)));
  follow_cells(g);
  const std::string_view line = keyword_line(g);
  const auto members =
      members_of(old->second, g.part.cell_places, g.part.cell_numbers, g.made.looked_at);
  take(g, line, 0);
  std::vector<NumberRange> numbers;
  for (const std::int64_t number : members) {
    const std::size_t place = *g.part.cell_places.find(number);
    const std::size_t nodes = g.types[g.part.cell_types[place]].nodes;
    take(g, line, nodes + 2);
    copy_element(g, place, element_shift, node_shift,
                 g.keyword.has("REFLECT") ? reflection(nodes) : std::span<const std::uint8_t>());
    add_number(g.part.cell_numbers.back(), numbers);
  }
  const std::string* set = g.keyword.value("NEWSET");
  if (set != nullptr && !set->empty()) add_ranges(numbers, set_named(g.part.sets, *set));
}

}  // namespace

bool makes_mesh(std::string_view keyword) {
  constexpr std::array<std::string_view, 6> kAll{"NGEN", "NFILL", "NCOPY",
                                                 "NMAP", "ELGEN", "ELCOPY"};
  return std::find(kAll.begin(), kAll.end(), keyword) != kAll.end();
}

void generate(const Generation& generation) {
  const std::string& name = generation.keyword.name;
  if (name == "NMAP") not_supported(generation, "*NMAP");
  if (name == "ELGEN") return generate_elements(generation);
  if (name == "ELCOPY") return copy_elements(generation);
  generate_nodes(generation);
}

void take(const Generation& generation, std::string_view line, std::size_t numbers) {
  constexpr std::size_t kMostLookedAt = 200'000'000;
  Made& made = generation.made;
  if (numbers > kMostMade - made.numbers || made.looked_at > kMostLookedAt)
    refuse(generation.cursor, line,
           fmt::format("*{}: at most {} numbers of nodes and elements made by keywords",
                       generation.keyword.name, kMostMade));
  made.numbers += numbers;
}

void not_supported(const Generation& generation, std::string_view what) {
  generation.cursor.fail_at(
      generation.keyword.offset,
      fmt::format("{} makes nodes or elements that the file does not list, which is not supported",
                  what));
}

std::int64_t checked_number(const Generation& g, std::int64_t number) {
  if (number < -kLargestNumber || number > kLargestNumber)
    g.cursor.fail_at(g.keyword.offset, fmt::format("*{}: numbers of at most {} expected ({} found)",
                                                   g.keyword.name, kLargestNumber, number));
  return number;
}

std::string_view keyword_line(const Generation& generation) {
  const std::string_view text = generation.cursor.text().substr(generation.keyword.offset);
  return text.substr(0, text.find_first_of("\r\n"));
}

std::int64_t whole_in(CommaFields& fields, const TextCursor& cursor, std::string_view line,
                      std::string_view what, std::optional<std::int64_t> otherwise) {
  const std::string_view field = fields.at_end() ? std::string_view() : fields.field();
  if (field.empty() && otherwise) return *otherwise;
  const auto value = whole_number(field);
  if (!value) refuse(cursor, line, what);
  return *value;
}

std::int64_t whole_parameter(const Generation& generation, std::string_view parameter) {
  const auto value = whole_number(required(generation.keyword, parameter, generation.cursor));
  if (!value)
    refuse(generation.cursor, keyword_line(generation),
           fmt::format("*{}, {}: a whole number", generation.keyword.name, parameter));
  return *value;
}

void keep_last_definitions(Part& part, const std::vector<ForeignType>& types) {
  if (!part.made) return;
  keep_last_points(part.node_numbers, part.xyz);
  keep_last_cells(part.cell_numbers, part.cell_types, part.cell_nodes, types);
}

}  // namespace hiac::formats::abaqus

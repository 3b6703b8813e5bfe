#include "hiac/derive/scalar_expression.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <muParser.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/derive/averages.hpp"
#include "hiac/mesh/fields/tuple_count.hpp"

namespace hiac {
namespace {

constexpr std::size_t kScalarExpressionGrain = 1 << 14;  // values a thread computes at a time

constexpr std::array<std::string_view, 7> kScalarsOfFields{
    "magnitude", "von_mises", "tresca", "trace", "principal_1", "principal_2", "principal_3"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_name(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalpha(byte) != 0 || c == '_' || byte >= 0x80;
}
bool is_in_name(char c) { return begins_name(c) || is_digit(c) || c == '.'; }

template <typename Accept>
std::size_t end_of(std::string_view text, std::size_t at, const Accept& accept) {
  while (at < text.size() && accept(text[at])) ++at;
  return at;
}

// The place behind "@location" and ":component", as far as they follow a field's name.
std::size_t behind_suffixes(std::string_view text, std::size_t at) {
  for (const char sign : {'@', ':'})
    if (at + 1 < text.size() && text[at] == sign && is_in_name(text[at + 1]))
      at = end_of(text, at + 1, is_in_name);
  return at;
}

std::optional<Field> find_scalar(const ZooMesh& mesh, const std::string& reference) {
  try {
    return scalar_field(mesh, reference);
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

std::string without_quotes(std::string_view reference) {
  std::string text(reference);
  std::erase(text, '"');
  return text;
}

mu::Parser new_parser() {
  mu::Parser parser;
  parser.DefineConst("pi", std::numbers::pi);
  return parser;
}

// A parser of a translated expression that takes its operands from there: the fields' values, and
// then a position.
mu::Parser parser_of(const std::string& text, std::span<double> operands) {
  mu::Parser parser = new_parser();
  const std::size_t fields = operands.size() - 3;
  for (std::size_t k = 0; k < fields; ++k) parser.DefineVar(fmt::format("f{}", k), &operands[k]);
  for (std::size_t d = 0; d < 3; ++d)
    parser.DefineVar(fmt::format("x{}", d), &operands[fields + d]);
  parser.SetExpr(text);
  return parser;
}

using Position = std::array<double, 3>;

// The mean position of the nodes of a cell.
Position middle_of(const ZooMesh& mesh, CellId cell) {
  Position sum{0, 0, 0};
  const auto nodes = mesh.cell_nodes(cell);
  for (const NodeId node : nodes)
    for (std::size_t d = 0; d < 3; ++d) sum[d] += mesh.position(node)[d];
  for (double& s : sum) s /= static_cast<double>(nodes.size());
  return sum;
}

Position position_of(const ZooMesh& mesh, FieldLocation location, std::size_t tuple) {
  if (location == FieldLocation::cell) return middle_of(mesh, static_cast<CellId>(tuple));
  const NodeId node =
      location == FieldLocation::node ? static_cast<NodeId>(tuple) : mesh.nodes[tuple];
  const auto p = mesh.position(node);
  return {p[0], p[1], p[2]};
}

}  // namespace

std::size_t behind_closing(std::string_view text, std::size_t open) {
  if (text[open] == '"') {
    const std::size_t close = text.find('"', open + 1);
    return close == std::string_view::npos ? close : close + 1;
  }
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == '"') {
      const std::size_t behind = behind_closing(text, i);
      if (behind == std::string_view::npos) return behind;
      i = behind - 1;
    } else if (text[i] == '(') {
      ++depth;
    } else if (text[i] == ')' && --depth == 0) {
      return i + 1;
    }
  }
  return std::string_view::npos;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

// Translates the text for muParser, name by name.
class ScalarExpression::Translation {
 public:
  Translation(const ZooMesh& mesh, std::string_view text, ScalarExpression& to)
      : mesh_(mesh), text_(text), to_(to), functions_(new_parser().GetFunDef()) {}

  void run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (begins_name(c) || c == '"')
        name();
      else if (is_digit(c) || c == '.')
        number();
      else
        sign();
    }
  }

 private:
  void copy_to(std::size_t end) {
    to_.text_ += text_.substr(at_, end - at_);
    at_ = end;
  }

  void number() {
    std::size_t end = end_of(text_, at_, [](char c) { return is_digit(c) || c == '.'; });
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      std::size_t digits = end + 1;
      if (digits < text_.size() && (text_[digits] == '+' || text_[digits] == '-')) ++digits;
      if (digits < text_.size() && is_digit(text_[digits])) end = end_of(text_, digits, is_digit);
    }
    copy_to(end);
  }

  void sign() {
    constexpr std::string_view kBefore = "=<>!";
    if (text_[at_] == '=') {
      const bool is_comparison = at_ + 1 < text_.size() && text_[at_ + 1] == '=';
      if (!is_comparison)
        throw UsageError("a single = has no meaning in an expression (== expected)");
      return copy_to(at_ + 2);
    }
    const bool is_pair = at_ + 1 < text_.size() && text_[at_ + 1] == '=' &&
                         kBefore.find(text_[at_]) != std::string_view::npos;
    copy_to(at_ + (is_pair ? 2 : 1));
  }

  void name() {
    const bool is_quoted = text_[at_] == '"';
    const std::size_t end = is_quoted ? behind_closing(text_, at_) : end_of(text_, at_, is_in_name);
    if (end == std::string_view::npos) throw UsageError("a \" is not closed");
    const std::string_view word = text_.substr(at_, end - at_);
    const std::size_t next = text_.find_first_not_of(' ', end);
    if (!is_quoted && next != std::string_view::npos && text_[next] == '(')
      return function(word, next);
    const std::size_t behind = behind_suffixes(text_, end);
    const std::string reference = without_quotes(text_.substr(at_, behind - at_));
    at_ = behind;
    if (std::optional<Field> field = find_scalar(mesh_, reference)) return add(std::move(*field));
    if (word == "pi" && behind == end) {
      to_.text_ += word;
      return;
    }
    if (word.size() == 1 && word[0] >= 'x' && word[0] <= 'z' && behind == end) {
      to_.text_ += fmt::format("x{}", word[0] - 'x');
      to_.with_position_ = true;
      return;
    }
    scalar_field(mesh_, reference);  // throws: names the fields that there are
  }

  void function(std::string_view word, std::size_t open) {
    if (functions_.contains(std::string(word))) {
      to_.text_ += word;  // muParser takes no blank between a function and its parenthesis
      at_ = open;
      return;
    }
    const std::size_t behind = behind_closing(text_, open);
    if (behind == std::string_view::npos) throw UsageError("a ( is not closed");
    const std::string argument(without_quotes(trimmed(text_.substr(open + 1, behind - open - 2))));
    at_ = behind;
    if (std::ranges::find(kScalarsOfFields, word) != kScalarsOfFields.end())
      return add(scalar_field(mesh_, fmt::format("{}:{}", argument, word)));
    if (word == "node_average") return add(node_average(mesh_, scalar_field(mesh_, argument)));
    if (word == "cell_average") return add(cell_average(mesh_, scalar_field(mesh_, argument)));
    throw UsageError(fmt::format("there is no function {}", word));
  }

  void add(Field field) {
    to_.text_ += fmt::format("f{}", to_.fields_.size());
    to_.fields_.push_back(std::move(field));
  }

  const ZooMesh& mesh_;
  std::string_view text_;
  ScalarExpression& to_;
  mu::funmap_type functions_;
  std::size_t at_ = 0;
};

ScalarExpression::ScalarExpression(const ZooMesh& mesh, std::string_view text) {
  Translation(mesh, text, *this).run();
  std::vector<double> operands(fields_.size() + 3);
  try {
    parser_of(text_, operands).Eval();
  } catch (const mu::Parser::exception_type& error) {
    // its places and names are those of the translation
    throw UsageError(fmt::format(
        "the expression is not complete or not understood{}",
        fields_.empty() && !with_position_ ? fmt::format(" ({})", error.GetMsg()) : std::string()));
  }
}

std::vector<double> ScalarExpression::values(const ZooMesh& mesh, FieldLocation location) const {
  std::vector<SharedArray<double>> columns;
  for (const Field& field : fields_)
    columns.push_back(location == FieldLocation::corner ? values_at_corners(mesh, field)
                                                        : field.values);
  std::vector<double> result(tuple_count(mesh, location));
  parallel_for(result.size(), kScalarExpressionGrain, [&](IndexRange range) {
    // a parser of each range's own: it keeps the operands
    std::vector<double> operands(fields_.size() + 3);
    const mu::Parser parser = parser_of(text_, operands);
    for (std::size_t i = range.begin; i < range.end; ++i) {
      for (std::size_t k = 0; k < columns.size(); ++k) operands[k] = columns[k][i];
      if (with_position_)
        std::ranges::copy(position_of(mesh, location, i),
                          operands.begin() + static_cast<std::ptrdiff_t>(fields_.size()));
      result[i] = parser.Eval();
    }
  });
  return result;
}

FieldLocation common_location(const std::vector<Field>& fields) {
  const Field *of_nodes = nullptr, *of_cells = nullptr;
  for (const Field& field : fields) {
    if (field.location == FieldLocation::corner) return FieldLocation::corner;
    (field.location == FieldLocation::node ? of_nodes : of_cells) = &field;
  }
  if (of_nodes != nullptr && of_cells != nullptr)
    throw UsageError(
        fmt::format("'{}' is a field of nodes, '{}' one of cells (node_average({}) or "
                    "cell_average({}) expected)",
                    of_nodes->name, of_cells->name, of_cells->name, of_nodes->name));
  return of_cells != nullptr ? FieldLocation::cell : FieldLocation::node;
}

}  // namespace hiac

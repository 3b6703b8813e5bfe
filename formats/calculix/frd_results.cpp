#include "formats/calculix/frd_results.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "formats/common/io/number_index.hpp"

namespace hiac::formats::frd {
namespace {

constexpr std::size_t kMostComponents = 200;

void read_components(TextCursor& cursor, ResultBlock& block) {
  const std::size_t start = cursor.offset();
  const std::string_view head = cursor.line();
  const auto announced = to_integer(columns(head, 13, 5));
  if (trimmed(columns(head, 0, 3)) != "-4" || !announced || *announced < 0 ||
      *announced > static_cast<std::int64_t>(kMostComponents))
    cursor.fail_at(start, fmt::format("the name and number of components (' -4') expected ({} "
                                      "found)",
                                      shown(head)));
  block.name = trimmed(columns(head, 5, 8));
  for (std::int64_t c = 0; c < *announced; ++c) {
    const std::size_t at = cursor.offset();
    const std::string_view line = cursor.line();
    if (trimmed(columns(line, 0, 3)) != "-5")
      cursor.fail_at(at, fmt::format("a component (' -5') expected ({} found)", shown(line)));
    // cgx computes some components itself (magnitudes): the file does not contain them
    if (to_integer(columns(line, 33, 5)).value_or(0) == 0) ++block.components;
  }
}

void step_over_text(TextCursor& cursor) {
  const std::string_view rest = cursor.text().substr(cursor.offset());
  const std::size_t end = rest.starts_with(" -3") ? 0 : rest.find("\n -3");
  if (end == std::string_view::npos) cursor.fail("the file ends too early (' -3' expected)");
  cursor.move_to(cursor.offset() + end + (end == 0 ? 0 : 1));
  cursor.line();
}

/// Collects the numbers in a block that no node has. Malformed numbers are refused when the
/// values are read.
void look_for_strays(const InputText& text, const NumberIndex& index, const ResultBlock& block,
                     std::set<std::int64_t>& strays) {
  const auto look_at = [&](std::int64_t number) {
    if (index.find(number) == NumberIndex::kNone) strays.insert(number);
  };
  TextCursor cursor(text.text(), text.path());
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

std::vector<double> read_values(const InputText& text, const NumberIndex& index, std::size_t points,
                                const ResultBlock& block) {
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

}  // namespace

void Results::read(TextCursor& cursor, std::string_view line, std::size_t start, std::size_t count,
                   Encoding encoding, std::vector<double>& times) {
  const auto value = to_real(columns(line, 12, 12));
  if (!value || !std::isfinite(*value))
    cursor.fail_at(start, fmt::format("a time in columns 13 to 24 expected ({} found)",
                                      shown(columns(line, 12, 12))));
  const std::int64_t number = to_integer(columns(line, 58, 5)).value_or(0);
  ResultBlock block;
  block.encoding = encoding;
  block.records = count;
  read_components(cursor, block);
  block.offset = cursor.offset();
  if (is_text(encoding)) {
    step_over_text(cursor);
  } else {
    const std::size_t bytes = Records(cursor, encoding).binary_bytes(block.components);
    require_records(cursor, count <= cursor.left() / bytes, count);
    cursor.bytes(count * bytes, "values");
  }
  if (block.components > 0) blocks_.emplace_back(step_of(*value, number, block.name, times), block);
}

/// Steps differ in their time or, as mode shapes of one frequency do, in their number.
std::size_t Results::step_of(double time, std::int64_t number, const std::string& name,
                             std::vector<double>& times) {
  std::size_t step = 0;
  while (step < steps_.size() &&
         (steps_[step] != std::pair(time, number) || seen_.contains({step, name})))
    ++step;
  if (step == steps_.size()) {
    steps_.emplace_back(time, number);
    times.push_back(time);
  }
  seen_.insert({step, name});
  return step;
}

void Results::add_to(ForeignMesh& mesh, const std::shared_ptr<InputText>& text) const {
  if (blocks_.empty()) return;
  const auto index = std::make_shared<NumberIndex>(mesh.node_numbers);
  const std::size_t points = mesh.point_count();
  std::set<std::int64_t> strays;  // nodes that have values and no place
  for (const auto& [step, block] : blocks_) look_for_strays(*text, *index, block, strays);
  if (!strays.empty())
    mesh.notes.push_back(
        fmt::format("left out values of {} nodes that the file does not have, "
                    "the first of them is node {}",
                    strays.size(), *strays.begin()));
  for (const auto& [step, block] : blocks_) {
    ForeignField field;
    field.name = block.name;
    field.components = static_cast<std::uint32_t>(block.components);
    field.step = step;
    field.values = [text, index, points, part = block] {
      return read_values(*text, *index, points, part);
    };
    mesh.fields.push_back(std::move(field));
  }
}

}  // namespace hiac::formats::frd

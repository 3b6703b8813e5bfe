// Datasets 55 and 2414: the Universal File Datasets reference of the Structural Dynamics Research
// Lab, University of Cincinnati, and of Siemens.
#include "formats/unv/unv_results.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "formats/common/io/number_index.hpp"

namespace hiac::formats::unv {
namespace {

constexpr std::size_t kIntegerColumns = 10;
constexpr std::size_t kRealColumns = 13;
constexpr std::size_t kRealsInLine = 6;
constexpr std::size_t kMostValues = 200;
/// The places of the six components of a symmetric tensor: xx, yy, zz, xy, yz, xz.
constexpr std::array<std::size_t, 6> kTensorPlaces{0, 3, 1, 5, 4, 2};

// codes of datasets 55 and 2414
constexpr std::int64_t kNormalModes = 2;
constexpr std::int64_t kTransient = 4;
constexpr std::int64_t kFrequencyResponse = 5;
constexpr std::int64_t kSymmetricTensor = 4;
constexpr std::int64_t kSingle = 2;
constexpr std::int64_t kDouble = 4;

struct Line {
  std::string_view text;
  std::size_t start;
};

Line next_line(TextCursor& cursor) {
  const std::size_t start = cursor.offset();
  return {cursor.line(), start};
}

std::int64_t integer_at(const Line& line, std::size_t i, const TextCursor& cursor) {
  const std::size_t at = i * kIntegerColumns;
  const std::string_view field =
      at < line.text.size() ? line.text.substr(at, kIntegerColumns) : std::string_view();
  const auto value = to_integer(field);
  if (!value)
    cursor.fail_at(line.start, fmt::format("an integer in columns {} to {} expected ({} found)",
                                           at + 1, at + kIntegerColumns, shown(field)));
  return *value;
}

double real_at(const Line& line, std::size_t i, const TextCursor& cursor) {
  const std::size_t at = i * kRealColumns;
  const std::string_view field =
      at < line.text.size() ? line.text.substr(at, kRealColumns) : std::string_view();
  const auto value = to_real(field);
  if (!value)
    cursor.fail_at(line.start, fmt::format("a real in columns {} to {} expected ({} found)", at + 1,
                                           at + kRealColumns, shown(field)));
  return *value;
}

/// The six integers that both datasets have.
struct Codes {
  std::int64_t analysis;
  std::int64_t characteristic;
  std::int64_t result;
  std::int64_t type;
  std::int64_t values;
};

Codes read_codes(TextCursor& cursor) {
  const Line line = next_line(cursor);
  return {integer_at(line, 1, cursor), integer_at(line, 2, cursor), integer_at(line, 3, cursor),
          integer_at(line, 4, cursor), integer_at(line, 5, cursor)};
}

std::string result_name(std::int64_t result) {
  switch (result) {
    case 2:
      return "stress";
    case 3:
      return "strain";
    case 4:
      return "element force";
    case 5:
      return "temperature";
    case 6:
      return "heat flux";
    case 7:
      return "strain energy";
    case 8:
      return "displacement";
    case 9:
      return "reaction force";
    case 11:
      return "velocity";
    case 12:
      return "acceleration";
    default:
      return fmt::format("result {}", result);
  }
}

/// The head of dataset 55 after its five texts.
UnvResult head_55(TextCursor& cursor, Codes& codes) {
  UnvResult result;
  for (int i = 0; i < 5; ++i) cursor.line();
  codes = read_codes(cursor);
  result.name = result_name(codes.result);
  const Line counts = next_line(cursor);
  const std::int64_t integers = integer_at(counts, 0, cursor);
  const std::int64_t reals = integer_at(counts, 1, cursor);
  if (integers < 0 || integers > 6 || reals < 0 || reals > 12)
    cursor.fail_at(counts.start, fmt::format("impossible numbers of integers and reals ({} and {} "
                                             "found)",
                                             integers, reals));
  result.step =
      integers > 0 ? integer_at(counts, 1 + static_cast<std::size_t>(integers), cursor) : 0;
  const Line first = next_line(cursor);
  const bool has_time = codes.analysis == kNormalModes || codes.analysis == kTransient ||
                        codes.analysis == kFrequencyResponse;
  result.time =
      has_time && reals > 0 ? real_at(first, 0, cursor) : static_cast<double>(result.step);
  if (static_cast<std::size_t>(reals) > kRealsInLine) cursor.line();
  return result;
}

UnvResult head_2414(TextCursor& cursor, Codes& codes) {
  UnvResult result;
  cursor.line();
  result.name = trimmed(cursor.line());
  const Line place = next_line(cursor);
  const std::int64_t location = integer_at(place, 0, cursor);
  if (location < 1 || location > 3)
    cursor.fail_at(place.start,
                   fmt::format("data at nodes, on elements or at nodes on elements (1, "
                               "2, 3) expected ({} found)",
                               location));
  constexpr std::array kPlaces{FieldLocation::node, FieldLocation::cell, FieldLocation::corner};
  result.location = kPlaces[static_cast<std::size_t>(location - 1)];
  for (int i = 0; i < 5; ++i) cursor.line();
  codes = read_codes(cursor);
  if (result.name.empty()) result.name = result_name(codes.result);
  const Line numbers = next_line(cursor);
  cursor.line();
  const Line reals = next_line(cursor);
  cursor.line();
  const bool modal = codes.analysis == kNormalModes || codes.analysis == kFrequencyResponse;
  result.step = integer_at(numbers, codes.analysis == kNormalModes ? 5 : 6, cursor);
  const bool has_time = modal || codes.analysis == kTransient;
  result.time = has_time ? real_at(reals, modal ? 1 : 0, cursor) : static_cast<double>(result.step);
  return result;
}

/// Reads the tuples of a result.
class Values {
 public:
  Values(const InputText& text, const UnvResult& result)
      : cursor_(text.text(), text.path()), result_(result) {
    cursor_.move_to(result.begin);
  }

  [[nodiscard]] bool at_end() const { return cursor_.offset() >= result_.end; }
  TextCursor& cursor() { return cursor_; }
  Line line() { return next_line(cursor_); }

  /// Reads `count` values, six a line.
  void read(std::size_t count, double* to) {
    Line line{};
    for (std::size_t i = 0; i < count; ++i) {
      if (i % kRealsInLine == 0) line = next_line(cursor_);
      to[i] = real_at(line, i % kRealsInLine, cursor_);
    }
  }

 private:
  TextCursor cursor_;
  const UnvResult& result_;
};

/// The tables for looking up values.
struct Places {
  std::shared_ptr<InputText> text;
  NumberIndex nodes;
  NumberIndex cells;
  std::size_t points = 0;
  std::vector<std::size_t> starts;
  std::size_t cell_total = 0;
};

void store(const UnvResult& result, const double* tuple, double* to) {
  for (std::size_t c = 0; c < result.values; ++c)
    to[result.symmetric ? kTensorPlaces[c] : c] = tuple[c];
}

std::size_t place_of(const NumberIndex& index, std::int64_t number, const TextCursor& cursor,
                     const Line& line) {
  const std::size_t place = index.find(number);
  if (place == NumberIndex::kNone)
    cursor.fail_at(line.start, fmt::format("a value for {}, which there is not", number));
  return place;
}

std::vector<double> read_values(const UnvResult& result, const Places& places) {
  const std::size_t tuples = result.location == FieldLocation::node   ? places.points
                             : result.location == FieldLocation::cell ? places.cell_total
                                                                      : places.starts.back();
  std::vector<double> values(tuples * result.values, std::numeric_limits<double>::quiet_NaN());
  std::vector<double> tuple(result.values);
  Values data(*places.text, result);
  while (!data.at_end()) {
    const Line line = data.line();
    const bool node = result.location == FieldLocation::node;
    const std::size_t place = place_of(node ? places.nodes : places.cells,
                                       integer_at(line, 0, data.cursor()), data.cursor(), line);
    if (result.location != FieldLocation::corner) {
      if (!node && integer_at(line, 1, data.cursor()) != static_cast<std::int64_t>(result.values))
        data.cursor().fail_at(line.start, fmt::format("{} values expected", result.values));
      data.read(result.values, tuple.data());
      store(result, tuple.data(), &values[place * result.values]);
      continue;
    }
    const bool one_for_all = integer_at(line, 1, data.cursor()) == 2;
    const auto nodes = static_cast<std::size_t>(integer_at(line, 2, data.cursor()));
    if (nodes != places.starts[place + 1] - places.starts[place] ||
        integer_at(line, 3, data.cursor()) != static_cast<std::int64_t>(result.values))
      data.cursor().fail_at(
          line.start, fmt::format("values at {} nodes, {} each, expected",
                                  places.starts[place + 1] - places.starts[place], result.values));
    for (std::size_t n = 0; n < nodes; ++n) {
      if (n == 0 || !one_for_all) data.read(result.values, tuple.data());
      store(result, tuple.data(), &values[(places.starts[place] + n) * result.values]);
    }
  }
  return values;
}

}  // namespace

std::optional<UnvResult> read_result_head(TextCursor cursor, std::int64_t dataset, std::size_t end,
                                          std::vector<std::string>& notes) {
  const std::size_t start = cursor.offset();
  Codes codes{};
  UnvResult result = dataset == 55 ? head_55(cursor, codes) : head_2414(cursor, codes);
  if (codes.values < 1 || codes.values > static_cast<std::int64_t>(kMostValues) ||
      !std::isfinite(result.time))
    cursor.fail_at(start, fmt::format("impossible numbers in the head of dataset {}", dataset));
  result.begin = cursor.offset();
  result.end = end;
  if (result.begin > end) cursor.fail_at(end, fmt::format("dataset {} ends too early", dataset));
  result.values = static_cast<std::size_t>(codes.values);
  result.symmetric = codes.characteristic == kSymmetricTensor && codes.values == 6;
  if (codes.type == kSingle || codes.type == kDouble) return result;
  notes.push_back(fmt::format("left out result '{}': its values are not real", result.name));
  return std::nullopt;
}

void add_results(std::vector<UnvResult>&& results, const std::shared_ptr<InputText>& text,
                 ForeignMesh& mesh) {
  if (results.empty()) return;
  auto places = std::make_shared<Places>();
  places->text = text;
  places->nodes = NumberIndex(mesh.node_numbers);
  places->cells = NumberIndex(mesh.cell_numbers);
  places->points = mesh.point_count();
  places->cell_total = mesh.cell_count();
  places->starts.push_back(0);
  for (const std::uint16_t type : mesh.cell_types)
    places->starts.push_back(places->starts.back() + mesh.types[type].nodes);
  std::vector<std::pair<double, std::int64_t>> steps;
  for (UnvResult& result : results) {
    const std::pair key(result.time, result.step);
    const auto known = std::find(steps.begin(), steps.end(), key);
    ForeignField field;
    field.name = result.name;
    field.location = result.location;
    field.components = static_cast<std::uint32_t>(result.values);
    field.step = static_cast<std::size_t>(known - steps.begin());
    if (known == steps.end()) {
      steps.push_back(key);
      mesh.times.push_back(result.time);
    }
    field.values = [places, result] { return read_values(result, *places); };
    mesh.fields.push_back(std::move(field));
  }
}

}  // namespace hiac::formats::unv

// The layout: the EnSight User Manual, "EnSight6 Geometry File Format" and "EnSight6 Variable File
// Format".
#include "formats/ensight/six_file.hpp"

#include <limits>

#include <fmt/format.h>

#include "formats/common/io/input_text.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/ensight/element_types.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::ensight {
namespace {

constexpr std::size_t kIntegerColumns = 8;
constexpr std::size_t kRealColumns = 12;
constexpr std::size_t kRealsInLine = 6;

/// The lines of a file, and numbers in their columns.
class Columns {
 public:
  explicit Columns(const InputText& input) : cursor_(input.text(), input.path()) {}

  [[nodiscard]] bool at_end() {
    cursor_.skip_space();
    return cursor_.at_end();
  }
  std::string_view line() {
    start_ = cursor_.offset();
    line_ = cursor_.line();
    return line_;
  }
  [[nodiscard]] std::string_view peek() const { return trimmed(cursor_.peek_line()); }
  [[nodiscard]] std::size_t left() const { return cursor_.left(); }
  [[noreturn]] void fail(const std::string& problem) const { cursor_.fail_at(start_, problem); }

  std::int64_t integer_at(std::size_t column) const {
    const auto value = to_integer(field(column, kIntegerColumns));
    if (!value)
      fail(fmt::format("an integer in columns {} to {} expected ({} found)", column + 1,
                       column + kIntegerColumns, shown(field(column, kIntegerColumns))));
    return *value;
  }
  double real_at(std::size_t column) const {
    const auto value = to_real(field(column, kRealColumns));
    if (!value)
      fail(fmt::format("a real in columns {} to {} expected ({} found)", column + 1,
                       column + kRealColumns, shown(field(column, kRealColumns))));
    return *value;
  }
  /// A line with the count of items that take a line or a value each.
  std::size_t count() {
    const auto value = to_integer(line());
    if (!value || *value < 0 || static_cast<std::uint64_t>(*value) > left())
      fail(fmt::format("a count that fits the file expected ({} found)", shown(line_)));
    return static_cast<std::size_t>(*value);
  }
  std::vector<double> reals(std::size_t amount) {
    if (amount > left()) fail("more values expected than the file can hold");
    std::vector<double> values;
    for (std::size_t i = 0; i < amount; ++i) {
      if (i % kRealsInLine == 0) line();
      values.push_back(real_at(kRealColumns * (i % kRealsInLine)));
    }
    return values;
  }

 private:
  [[nodiscard]] std::string_view field(std::size_t column, std::size_t width) const {
    return column < line_.size() ? line_.substr(column, width) : std::string_view();
  }
  TextCursor cursor_;
  std::string_view line_;
  std::size_t start_ = 0;
};

/// Whether numbers precede the nodes or elements (`there`), and whether they are used (`given`).
struct Numbers {
  bool there;
  bool given;
};
Numbers numbers_of(std::string_view line) {
  line = trimmed(line);
  return {line.ends_with("given") || line.ends_with("ignore"), line.ends_with("given")};
}

/// "part 3"
std::string part_number(std::string_view line) {
  return std::string(trimmed(line.substr(std::string_view("part").size())));
}

}  // namespace

void SixMesh::read(const std::string& path, ForeignMesh& mesh) {
  const InputText input(path);
  if (input.text().starts_with("C Binary") ||
      input.text().substr(0, 80).find("Fortran Binary") < input.text().size())
    throw InputError(path, "is a binary file of EnSight 6 (a text, or EnSight Gold, expected)");
  Columns file(input);
  file.line();
  file.line();
  const Numbers nodes = numbers_of(file.line());
  const Numbers elements_numbers = numbers_of(file.line());
  if (trimmed(file.line()) != "coordinates") file.fail("'coordinates' expected");
  points_ = file.count();
  mesh.first_node = 1;
  for (std::size_t i = 0; i < points_; ++i) {
    file.line();
    const std::size_t skipped = nodes.there ? kIntegerColumns : 0;
    if (nodes.given) mesh.node_numbers.push_back(file.integer_at(0));
    for (std::size_t c = 0; c < 3; ++c)
      mesh.xyz.push_back(file.real_at(skipped + kRealColumns * c));
  }
  std::string part;
  while (!file.at_end()) {
    const std::string name(trimmed(file.line()));
    if (name.starts_with("part")) {
      part = part_number(name);
      mesh.blocks.push_back({std::string(trimmed(file.line())), {}});
      continue;
    }
    const auto found = elements().find(name.starts_with("g_") ? name.substr(2) : name);
    if (part.empty() || found == elements().end())
      file.fail(fmt::format("a part or an element's name expected ({} found)", shown(name)));
    const Element& element = found->second;
    const std::size_t count = file.count();
    const std::size_t first = mesh.cell_count();
    mesh.cell_types.insert(mesh.cell_types.end(), count,
                           mesh.type_place(name, element.nodes,
                                           name == found->first ? element.conversion : kNoVolume));
    for (std::size_t e = 0; e < count; ++e) {
      file.line();
      const std::size_t before = elements_numbers.there ? kIntegerColumns : 0;
      for (std::size_t n = 0; n < element.nodes; ++n)
        mesh.cell_nodes.push_back(file.integer_at(before + kIntegerColumns * n));
    }
    parts_[part][name] = {first, count};
    mesh.blocks.back().cells.push_back({first, first + count});
  }
  cells_ = mesh.cell_count();
}

std::vector<double> SixMesh::values(const std::string& path, FieldLocation location,
                                    std::size_t width) const {
  const InputText input(path);
  Columns file(input);
  file.line();
  const bool node = location == FieldLocation::node;
  std::vector<double> values((node ? points_ : cells_) * width,
                             std::numeric_limits<double>::quiet_NaN());
  const auto store = [&](std::size_t first, std::size_t count) {
    const std::vector<double> found = file.reals(count * width);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < width; ++c)
        values[(first + i) * width + component_place(c, width)] = found[i * width + c];
  };
  if (node) {
    store(0, points_);
    return values;
  }
  std::string part;
  while (!file.at_end()) {
    const std::string name(trimmed(file.line()));
    if (name.starts_with("part")) {
      part = part_number(name);
      continue;
    }
    const auto sections = parts_.find(part);
    if (sections == parts_.end() || !sections->second.contains(name))
      file.fail(fmt::format("a part or an element's name of the geometry expected ({} found)",
                            shown(name)));
    const Section& section = sections->second.at(name);
    store(section.first, section.count);
  }
  return values;
}

}  // namespace hiac::formats::ensight

#include "formats/gmsh/gmsh_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/common/io/bytes_behind.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::gmsh {
namespace {

/// Gmsh knows scalars, vectors and tensors; other numbers of components are possible, but not large
/// ones.
constexpr std::size_t kMostComponents = 100;

/// The text between quotes; the whole text when it has none.
std::string unquoted(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.starts_with('"') && text.ends_with('"'))
    text = text.substr(1, text.size() - 2);
  return std::string(text);
}

class SectionReader {
 public:
  explicit SectionReader(MshStream stream) : stream_(std::move(stream)) {}

  MshContents run() {
    read_format();
    while (next_section()) read_section();
    if (!have_nodes_ || !have_elements_)
      throw InputError(stream_.cursor().subject(),
                       fmt::format("the file ends too early (${} expected)",
                                   have_nodes_ ? "Elements" : "Nodes"));
    if (!left_out_.empty())
      contents_.mesh.notes.push_back(
          fmt::format("left out sections: {}", fmt::join(left_out_, ", ")));
    return std::move(contents_);
  }

 private:
  /// Moves past the next line that begins a section and stores the section's name; skips other
  /// lines between sections, as Gmsh does.
  bool next_section() {
    TextCursor& cursor = stream_.cursor();
    const std::size_t behind = cursor.offset();
    while (!cursor.at_end()) {
      section_start_ = cursor.offset();
      const std::string_view line = trimmed(cursor.line());
      if (!line.starts_with('$')) continue;
      section_ = line.substr(1);
      return true;
    }
    note_text_behind(cursor.text().substr(behind), "the last section", contents_.mesh.notes);
    return false;
  }

  void read_format() {
    TextCursor& cursor = stream_.cursor();
    bool found = next_section();
    while (found && section_ == "Comments") {
      skip_section();
      found = next_section();
    }
    if (!found) cursor.fail("no section found ('$MeshFormat' expected)");
    if (section_ == "NOD") {
      contents_.version = 1;
      read_section();
      return;
    }
    if (section_ != "MeshFormat")
      cursor.fail_at(section_start_,
                     fmt::format("'$MeshFormat' or '$NOD' expected ({} found)", shown(section_)));
    const std::size_t at = cursor.offset();
    contents_.version = cursor.real("the version of the format");
    const std::int64_t binary = cursor.integer("0 (text) or 1 (binary)");
    const std::int64_t size = cursor.integer("the size of a number");
    const double version = contents_.version;
    if (!(version >= 2 && version < 2.3) && version != 3 && version != 4 && version != 4.1)
      cursor.fail_at(at, fmt::format("version {} of the format is not known (1, 2 to 2.2, 3, 4 or "
                                     "4.1 expected)",
                                     version));
    if (binary < 0 || binary > 1 || size != 8)
      cursor.fail_at(at, fmt::format("'0 8' or '1 8' expected behind the version ('{} {}' found)",
                                     binary, size));
    cursor.line();
    if (binary == 1) read_byte_order();
    expect_end();
  }

  void read_byte_order() {
    const std::string_view one = stream_.cursor().bytes(4, "the number one");
    const bool swapped = one == std::string_view("\0\0\0\1", 4);
    if (!swapped && one != std::string_view("\1\0\0\0", 4))
      stream_.fail("the number one that tells the byte order expected");
    stream_.set_binary(swapped);
  }

  /// Reads the section's last line.
  void expect_end() {
    TextCursor& cursor = stream_.cursor();
    cursor.skip_space();
    const std::size_t at = cursor.offset();
    const std::string_view line = trimmed(cursor.line());
    const std::string wanted =
        contents_.version == 1 ? fmt::format("$END{}", section_) : fmt::format("$End{}", section_);
    if (line != wanted)
      cursor.fail_at(at, fmt::format("'{}' expected ({} found)", wanted, shown(line)));
  }

  void skip_section() {
    TextCursor& cursor = stream_.cursor();
    const std::string wanted =
        contents_.version == 1 ? fmt::format("$END{}", section_) : fmt::format("$End{}", section_);
    const std::size_t end = cursor.text().find(wanted, cursor.offset());
    if (end == std::string_view::npos)
      cursor.fail_at(section_start_,
                     fmt::format("the file ends too early ('{}' expected)", wanted));
    cursor.move_to(end);
    expect_end();
  }

  void read_section() {
    if (section_ == "Nodes" || section_ == "NOD") {
      read_nodes(stream_, contents_);
      have_nodes_ = true;
    } else if (section_ == "ParametricNodes" && contents_.version < 3) {
      read_parametric_nodes(stream_, contents_);
      have_nodes_ = true;
    } else if (section_ == "Elements" || section_ == "ELM") {
      read_elements(stream_, contents_);
      have_elements_ = true;
    } else if (section_ == "Entities" && contents_.version == 3) {
      read_entities_3(stream_.cursor(), contents_);
    } else if (section_ == "Entities" && contents_.version >= 4) {
      read_entities(stream_, contents_);
    } else if (section_ == "PhysicalNames") {
      read_physical_names();
    } else if (section_ == "NodeData") {
      return read_data(FieldLocation::node);
    } else if (section_ == "ElementData") {
      return read_data(FieldLocation::cell);
    } else if (section_ == "ElementNodeData") {
      return read_data(FieldLocation::corner);
    } else {
      if (section_ != "Comments") left_out_.insert(shown(fmt::format("${}", section_)));
      return skip_section();
    }
    expect_end();
  }

  void read_physical_names() {
    TextCursor& cursor = stream_.cursor();
    const std::size_t count = cursor.count("the number of physical names", cursor.left());
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t dimension = cursor.integer("a dimension");
      const std::int64_t tag = cursor.integer("a physical group");
      if (dimension < 0 || dimension > 3)
        cursor.fail(fmt::format("a dimension: impossible (0 to 3 expected, {} found)", dimension));
      contents_.physical_names[{static_cast<int>(dimension), tag}] = unquoted(cursor.line());
    }
  }

  void read_data(FieldLocation location) {
    TextCursor& cursor = stream_.cursor();
    DataSection data{"", location, std::nullopt, 0, 1, 0, stream_};
    const std::size_t strings = cursor.count("a number of texts", cursor.left());
    cursor.line();
    for (std::size_t i = 0; i < strings; ++i) {
      const std::string text = unquoted(cursor.line());
      if (i == 0) data.name = text;
    }
    const std::size_t reals = cursor.count("a number of reals", cursor.left());
    for (std::size_t i = 0; i < reals; ++i) {
      const double value = cursor.real("a real");
      if (i == 0) data.time = value;
    }
    if (data.time && !std::isfinite(*data.time)) cursor.fail("the time is not finite");
    const std::size_t integers = cursor.count("a number of integers", cursor.left());
    for (std::size_t i = 0; i < integers; ++i) {
      const std::int64_t value = cursor.integer("an integer");
      if (i == 0) data.step = value;
      if (i == 1 && (value < 1 || value > static_cast<std::int64_t>(kMostComponents)))
        cursor.fail(fmt::format("a number of components: impossible (1 to {} expected, {} found)",
                                kMostComponents, value));
      if (i == 1) data.components = static_cast<std::size_t>(value);
      if (i == 2 && (value < 0 || static_cast<std::uint64_t>(value) > cursor.left() / 2 + 1))
        cursor.fail(fmt::format("{} values announced, more than the file can hold", value));
      if (i == 2) data.entities = static_cast<std::size_t>(value);
    }
    if (integers < 3) cursor.fail("step, components and number of values expected");
    if (data.name.empty()) data.name = "unnamed";
    if (stream_.binary()) cursor.line();
    data.data = stream_;
    if (stream_.binary()) skip_binary(data);
    contents_.data.push_back(std::move(data));
    skip_section();
  }

  /// Binary values may contain what looks like the section's end, so they are skipped by their
  /// size.
  void skip_binary(const DataSection& data) {
    for (std::size_t i = 0; i < data.entities; ++i) {
      stream_.integer("a number");
      const std::size_t tuples =
          data.location == FieldLocation::corner ? stream_.narrow_count("a number of nodes", 8) : 1;
      stream_.skip(8 * data.components * tuples, "values");
    }
  }

  MshStream stream_;
  MshContents contents_;
  std::string section_;
  std::size_t section_start_ = 0;
  bool have_nodes_ = false;
  bool have_elements_ = false;
  std::set<std::string> left_out_;
};

}  // namespace

MshContents read_sections(MshStream stream) { return SectionReader(std::move(stream)).run(); }

}  // namespace hiac::formats::gmsh

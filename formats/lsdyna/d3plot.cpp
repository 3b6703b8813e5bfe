#include "formats/lsdyna/d3plot.hpp"

#include <array>
#include <filesystem>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "formats/common/io/bytes_behind.hpp"
#include "formats/common/io/mapped_file.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/steps.hpp"
#include "formats/lsdyna/d3plot_layout.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

using lsdyna::Layout;
using lsdyna::Words;

/// A state: its file and the word at which it begins.
struct State {
  std::size_t file;
  std::size_t word;
};

/// The first file and its continuations, which stay mapped as long as a field needs them.
struct Family {
  std::vector<std::unique_ptr<MappedFile>> files;
  std::vector<Words> words;
  std::vector<State> states;
  std::vector<double> times;
  Layout layout;
  std::vector<std::string> notes;
};

void add_file(Family& family, const std::string& path, std::size_t bytes, std::endian order) {
  family.files.push_back(std::make_unique<MappedFile>(path));
  family.words.emplace_back(family.files.back()->text(), bytes, order, path);
}

/// Finds the states of the last added file from that word on, up to the end mark or to the last
/// complete state: a run that was ended may leave a part of the next one, which a note tells. Zeros
/// fill files up.
void find_states(Family& family, std::size_t at) {
  Words& words = family.words.back();
  for (; at < words.size(); at += family.layout.state_words) {
    const double time = words.real(at);
    if (time == lsdyna::kEndMark) return;
    if (family.layout.state_words > words.size() - at) break;
    family.states.push_back({family.words.size() - 1, at});
    family.times.push_back(time);
  }
  bool filled_up = true;
  for (std::size_t w = at; w < words.size() && filled_up; ++w) filled_up = words.real(w) == 0;
  if (!filled_up)
    note_bytes_behind((words.size() - at) * words.word_bytes(), "the last complete state",
                      family.notes);
}

std::shared_ptr<Family> family_of(const std::string& path) {
  auto family = std::make_shared<Family>();
  {
    const MappedFile first(path);
    const auto kind = lsdyna::word_kind(first.text());
    if (!kind) throw InputError(path, "has no control words of a d3plot file");
    add_file(*family, path, kind->bytes, kind->order);
  }
  Words& words = family->words.front();
  family->layout = lsdyna::read_layout(words);
  const std::size_t bytes = words.word_bytes();
  const std::endian order = words.order();
  find_states(*family, family->layout.first_state);
  for (std::size_t n = 1;; ++n) {
    const std::string next = fmt::format("{}{:02}", path, n);
    std::error_code failed;
    if (!std::filesystem::is_regular_file(next, failed)) break;
    add_file(*family, next, bytes, order);
    find_states(*family, 0);
  }
  return family;
}

class D3plotReader {
 public:
  D3plotReader(const std::string& path, const ReadOptions& options)
      : subject_(path), family_(family_of(path)), layout_(family_->layout) {
    mesh_.times = family_->times;
    const auto step = requested_step(options, mesh_.times, path);
    if (!family_->states.empty()) step_ = step.value_or(family_->states.size() - 1);
  }

  ForeignMesh read() {
    mesh_.first_node = 1;
    if (layout_.solids + layout_.thick_shells == 0)
      throw InputError(subject_, fmt::format("holds no solids (but {} shells, {} beams)",
                                             layout_.shells, layout_.beams));
    Words& words = family_->words.front();
    for (std::size_t i = 0; i < 3 * layout_.nodes; ++i)
      mesh_.xyz.push_back(words.real(layout_.coordinates + i));
    for (std::size_t s = 0; s < layout_.solids; ++s) add_solid(words, s);
    add_other_elements(words);
    mesh_.fields.push_back(field_of("part", FieldLocation::cell, 1, std::move(parts_)));
    if (deleted_ > 0)
      mesh_.notes.push_back(fmt::format("left out {} solids that are deleted by then", deleted_));
    for (std::size_t step = 0; step < family_->states.size(); ++step) add_fields(step);
    mesh_.notes.insert(mesh_.notes.end(), family_->notes.begin(), family_->notes.end());
    return std::move(mesh_);
  }

 private:
  void add_solid(Words& words, std::size_t s) {
    std::array<std::int64_t, 10> nodes{};
    for (std::size_t n = 0; n < 8; ++n) nodes[n] = words.integer(layout_.connectivity + 9 * s + n);
    for (std::size_t n = 8; n < 10 && layout_.ten_nodes; ++n)
      nodes[n] = words.integer(layout_.more_nodes + 2 * s + n - 8);
    // a tetrahedron of 4 nodes repeats its fourth; two further nodes mark a tetrahedron of 10 nodes
    const bool tetrahedron = nodes[3] == nodes[4] && nodes[3] == nodes[5] && nodes[3] == nodes[6] &&
                             nodes[3] == nodes[7];
    const bool ten = layout_.ten_nodes && nodes[8] > 0 && nodes[9] > 0 && !tetrahedron;
    parts_.push_back(static_cast<double>(words.integer(layout_.connectivity + 9 * s + 8)));
    if (is_deleted(s))
      add("deleted solid", nodes, 8, kNoVolume);
    else if (tetrahedron)
      add("tetrahedron", nodes, 4, converted_to(CellKind::tetrahedron4));
    else if (ten)
      add("tetrahedron", nodes, 10, converted_to(CellKind::tetrahedron10));
    else
      add("solid", nodes, 8, converted_to(CellKind::brick8));
  }

  /// Thick shells are bricks; beams and shells have no volume.
  void add_other_elements(Words& words) {
    struct Kind {
      const char* name;
      std::size_t count;
      std::size_t nodes;
      std::size_t words;  ///< of each, the last being its part
      CellConversion conversion;
    };
    const std::array<Kind, 3> kinds{
        {{"thick shell", layout_.thick_shells, 8, 9, converted_to(CellKind::brick8)},
         {"beam", layout_.beams, 2, 6, kNoVolume},
         {"shell", layout_.shells, 4, 5, kNoVolume}}};
    std::size_t at = layout_.connectivity + 9 * layout_.solids;
    for (const Kind& kind : kinds)
      for (std::size_t e = 0; e < kind.count; ++e, at += kind.words) {
        std::array<std::int64_t, 10> nodes{};
        for (std::size_t n = 0; n < kind.nodes; ++n) nodes[n] = words.integer(at + n);
        const bool deleted = kind.nodes == 8 && is_deleted(layout_.solids + e);
        if (deleted)
          add("deleted thick shell", nodes, kind.nodes, kNoVolume);
        else
          add(kind.name, nodes, kind.nodes, kind.conversion);
        parts_.push_back(static_cast<double>(words.integer(at + kind.words - 1)));
      }
    if (layout_.thick_shells > 0)
      mesh_.notes.emplace_back(
          "values of thick shells, which are layer by layer, are not read: NaN there");
  }

  void add(std::string_view type, const std::array<std::int64_t, 10>& nodes, std::size_t count,
           const CellConversion& conversion) {
    mesh_.cell_types.push_back(mesh_.type_place(type, count, conversion));
    mesh_.cell_nodes.insert(mesh_.cell_nodes.end(), nodes.begin(),
                            nodes.begin() + static_cast<std::ptrdiff_t>(count));
  }

  bool is_deleted(std::size_t s) {
    if (layout_.deletion != 2 || !step_) return false;
    const State& state = family_->states[*step_];
    const bool deleted =
        family_->words[state.file].real(state.word + layout_.deletion_data + s) == 0;
    deleted_ += deleted ? 1 : 0;
    return deleted;
  }

  void add_fields(std::size_t step) {
    std::size_t at = layout_.node_data;
    if (layout_.has_coordinates) {
      add_displacement(step, at);
      at += 3 * layout_.nodes;
    }
    if (layout_.has_temperature) add_field("temperature", step, at, 1, 1, layout_.nodes);
    at += layout_.nodes * layout_.temperatures;
    if (layout_.has_velocity) {
      add_field("velocity", step, at, 3, 3, layout_.nodes);
      at += 3 * layout_.nodes;
    }
    if (layout_.has_acceleration) add_field("acceleration", step, at, 3, 3, layout_.nodes);
    const std::size_t width = layout_.solid_values;
    if (width >= 7) {
      add_field("stress", step, layout_.solid_data, 6, width, layout_.solids);
      add_field("plastic strain", step, layout_.solid_data + 6, 1, width, layout_.solids);
    }
    for (std::size_t h = 7; h < width; ++h)
      add_field(fmt::format("history {}", h - 6), step, layout_.solid_data + h, 1, width,
                layout_.solids);
  }

  /// `width` values of each tuple, whose beginnings are `stride` words apart.
  void add_field(std::string name, std::size_t step, std::size_t at, std::size_t width,
                 std::size_t stride, std::size_t tuples) {
    ForeignField field;
    field.name = std::move(name);
    field.location = at < layout_.thermal_data ? FieldLocation::node : FieldLocation::cell;
    field.components = static_cast<std::uint32_t>(width);
    field.step = step;
    field.type = family_->words.front().word_bytes() == 4 ? "float" : "double";
    // the solids come first among the cells
    const std::size_t others =
        field.location == FieldLocation::cell ? mesh_.cell_count() - tuples : 0;
    field.values = [family = family_, state = family_->states[step], at, width, stride, tuples,
                    others] {
      Words& words = family->words[state.file];
      std::vector<double> values;
      values.reserve(width * tuples);
      for (std::size_t t = 0; t < tuples; ++t)
        for (std::size_t c = 0; c < width; ++c)
          values.push_back(words.real(state.word + at + t * stride + c));
      values.resize(values.size() + width * others, std::numeric_limits<double>::quiet_NaN());
      return values;
    };
    mesh_.fields.push_back(std::move(field));
  }

  /// The state stores the current positions of nodes, but users look at displacements.
  void add_displacement(std::size_t step, std::size_t at) {
    add_field("displacement", step, at, 3, 3, layout_.nodes);
    ForeignField& field = mesh_.fields.back();
    field.values = [family = family_, now = std::move(field.values)] {
      std::vector<double> values = now();
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] -= family->words.front().real(family->layout.coordinates + i);
      return values;
    };
  }

  std::string subject_;
  std::shared_ptr<Family> family_;
  const Layout& layout_;
  ForeignMesh mesh_;
  std::optional<std::size_t> step_;
  std::vector<double> parts_;
  std::size_t deleted_ = 0;
};

}  // namespace

Format d3plot_format() {
  Format format;
  format.name = "d3plot";
  format.extensions = {".d3plot"};
  format.kinds = "tet4,10 pyr5 prism6 brick8";
  format.fields = "node, cell";
  format.time_steps = "many";
  format.recognizes = [](std::string_view head) { return lsdyna::word_kind(head).has_value(); };
  read_through(format, [](const std::string& path, const ReadOptions& options) {
    return D3plotReader(path, options).read();
  });
  return format;
}

}  // namespace hiac::formats

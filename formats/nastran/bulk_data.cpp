#include "formats/nastran/bulk_data.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/io/bytes_behind.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/io/named_file.hpp"
#include "formats/common/io/number_index.hpp"
#include "formats/nastran/bulk_cards.hpp"
#include "formats/nastran/coordinate_systems.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::nastran {
namespace {

constexpr int kMostIncludes = 10;

/// A solid element: its corners are required, its mid-edge nodes are not.
struct Solid {
  std::string_view name;
  CellKind linear;
  CellKind quadratic;
};

// Node orders: Nastran's Quick Reference Guide, CHEXA, CPENTA, CPYRAM, CTETRA; the NASTRAN User's
// Manual of NASA, CIHEX1, CHEXA1, CHEXA2, CWEDGE.
constexpr std::array<Solid, 9> kSolids{
    {{"CIHEX1", CellKind::brick8, CellKind::brick8},
     {"CHEXA1", CellKind::brick8, CellKind::brick8},
     {"CHEXA2", CellKind::brick8, CellKind::brick8},
     {"CWEDGE", CellKind::prism6, CellKind::prism6},
     {"CHEXA", CellKind::brick8, CellKind::brick20},
     {"CPENTA", CellKind::prism6, CellKind::prism15},
     {"CPYRAM", CellKind::pyramid5, CellKind::pyramid13},
     {"CPYRA", CellKind::pyramid5, CellKind::pyramid13},
     {"CTETRA", CellKind::tetrahedron4, CellKind::tetrahedron10}}};

/// Elements without volume.
const std::set<std::string, std::less<>> kFlat{
    "CBAR",   "CBEAM",  "CBEAM3", "CBEND",  "CBUSH",  "CBUSH1D", "CBUSH2D", "CDAMP1", "CDAMP2",
    "CDAMP3", "CDAMP4", "CELAS1", "CELAS2", "CELAS3", "CELAS4",  "CFAST",   "CGAP",   "CONM1",
    "CONM2",  "CONROD", "CMASS1", "CMASS2", "CMASS3", "CMASS4",  "CQUAD",   "CQUAD4", "CQUAD8",
    "CQUADR", "CQUADX", "CROD",   "CSHEAR", "CTRIA3", "CTRIA6",  "CTRIAR",  "CTRIAX", "CTRIAX6",
    "CTUBE",  "CVISC",  "CWELD",  "PLOTEL", "RBE1",   "RBE2",    "RBE3",    "RBAR"};

class BulkReader {
 public:
  ForeignMesh run(const std::string& path) {
    read_file(path);
    place_grids(path);
    for (auto& [property, cells] : blocks_)
      mesh_.blocks.push_back({fmt::format("{}", property), std::move(cells)});
    return std::move(mesh_);
  }

 private:
  void read_file(const std::string& path) {
    if (depth_ == kMostIncludes)
      throw InputError(path, fmt::format("files include files more than {} deep", kMostIncludes));
    const InputText text(path);
    TextCursor cursor(text.text(), path);
    if (depth_++ == 0) skip_to_bulk(cursor);
    CardReader cards(cursor);
    while (const Card* card = cards.next()) read_card(*card, cursor, path);
    note_text_behind(text.text().substr(cursor.offset()), "ENDDATA", mesh_.notes);
    --depth_;
  }

  /// Executive and case control end at BEGIN BULK; without it, the whole file is bulk data.
  static void skip_to_bulk(TextCursor& cursor) {
    while (!cursor.at_end()) {
      const std::string_view line = cursor.line();
      if (starts_with_upper(trimmed(line), "BEGIN") &&
          upper(line).find("BULK") != std::string::npos)
        return;
    }
    cursor.move_to(0);
  }

  /// Whether entries with that name describe the mesh.
  static bool is_read(const std::string& name) {
    return name == "GRID" || name == "GRDSET" || name == "INCLUDE" || name == "CIHEX2" ||
           name == "CIHEX3" || kFlat.contains(name) ||
           (name.starts_with("CORD") && name.size() == 6) ||
           std::ranges::any_of(kSolids, [&](const Solid& solid) { return name == solid.name; });
  }

  void read_card(const Card& card, const TextCursor& cursor, const std::string& path) {
    const std::string name = upper(card.name);
    if (name.starts_with('=')) {
      // it repeats the preceding entry, which may be a load or a property
      if (repeats_what_is_read_)
        cursor.fail_at(card.offset, "replicated entries ('=') are not supported");
      return;
    }
    repeats_what_is_read_ = is_read(name);
    if (name == "GRID") return read_grid(card, cursor);
    for (std::size_t s = 0; s < kSolids.size(); ++s)
      if (name == kSolids[s].name) return read_solid(card, s, cursor);
    if (name.starts_with("CORD") && name.size() == 6) return read_system(card, name, cursor);
    if (name == "GRDSET") {
      default_system_ = integer_or(card, 1, 0, cursor);
    } else if (name == "INCLUDE") {
      include(card, cursor, path);
    } else if (name == "CIHEX2" || name == "CIHEX3") {
      begin_cell(type_place(name, 0, {}), integer_or(card, 0, 0, cursor));
    } else if (kFlat.contains(name)) {
      begin_cell(type_place(name, 0, kNoVolume), integer_or(card, 0, 0, cursor));
    }
  }

  static std::int64_t integer_in(const Card& card, std::size_t i, const TextCursor& cursor) {
    const auto value = to_integer(card.field(i));
    if (!value)
      cursor.fail_at(card.offset, fmt::format("{}: an integer in field {} expected ({} found)",
                                              card.name, i + 2, shown(card.field(i))));
    return *value;
  }
  static std::int64_t integer_or(const Card& card, std::size_t i, std::int64_t otherwise,
                                 const TextCursor& cursor) {
    return card.field(i).empty() ? otherwise : integer_in(card, i, cursor);
  }
  static double real_in(const Card& card, std::size_t i, const TextCursor& cursor) {
    if (card.field(i).empty()) return 0;
    const auto value = to_real(card.field(i));
    if (!value)
      cursor.fail_at(card.offset, fmt::format("{}: a real in field {} expected ({} found)",
                                              card.name, i + 2, shown(card.field(i))));
    return *value;
  }

  void read_grid(const Card& card, const TextCursor& cursor) {
    if (!card.field(1).empty()) {
      const std::int64_t system = integer_in(card, 1, cursor);
      if (system != 0) systems_of_grids_.emplace_back(mesh_.node_numbers.size(), system);
    } else {
      unset_systems_.push_back(mesh_.node_numbers.size());
    }
    mesh_.node_numbers.push_back(integer_in(card, 0, cursor));
    for (std::size_t c = 0; c < 3; ++c) mesh_.xyz.push_back(real_in(card, 2 + c, cursor));
  }

  void read_solid(const Card& card, std::size_t s, const TextCursor& cursor) {
    const Solid& solid = kSolids[s];
    const std::size_t corners = node_count(solid.linear);
    const std::size_t most = node_count(solid.quadratic);
    bool quadratic = false;
    for (std::size_t n = corners; n < most; ++n)
      quadratic |= !card.field(2 + n).empty() && card.field(2 + n) != "0";
    const std::size_t nodes = quadratic ? most : corners;
    std::uint16_t& type = solid_types_[s][quadratic ? 1 : 0];
    if (type == kUnseen)
      type = type_place(fmt::format("{}({} nodes)", solid.name, nodes), nodes,
                        vertical_edges_first(quadratic ? solid.quadratic : solid.linear));
    begin_cell(type, integer_in(card, 0, cursor));
    for (std::size_t n = 0; n < nodes; ++n) {
      const std::string_view field = card.field(2 + n);
      const bool left_out = n >= corners && (field.empty() || field == "0");
      mesh_.cell_nodes.push_back(left_out ? kLeftOutNode : integer_in(card, 2 + n, cursor));
    }
    add_to_block(integer_or(card, 1, mesh_.cell_numbers.back(), cursor));
  }

  std::uint16_t type_place(const std::string& name, std::size_t nodes,
                           const CellConversion& conversion) {
    for (std::size_t t = 0; t < mesh_.types.size(); ++t)
      if (mesh_.types[t].name == name) return static_cast<std::uint16_t>(t);
    mesh_.types.push_back({name, nodes, conversion});
    return static_cast<std::uint16_t>(mesh_.types.size() - 1);
  }

  void begin_cell(std::uint16_t type, std::int64_t number) {
    mesh_.cell_types.push_back(type);
    mesh_.cell_numbers.push_back(number);
  }

  void add_to_block(std::int64_t property) {
    const std::size_t cell = mesh_.cell_count() - 1;
    std::vector<IndexRange>& cells = blocks_[property];
    if (!cells.empty() && cells.back().end == cell)
      ++cells.back().end;
    else
      cells.push_back({cell, cell + 1});
  }

  /// CORD1R, CORD1C, CORD1S (one or two systems an entry) and CORD2R, CORD2C, CORD2S.
  void read_system(const Card& card, const std::string& name, const TextCursor& cursor) {
    CoordinateSystem system;
    system.kind = name[5];
    system.by_grids = name[4] == '1';
    if (name[4] == '2') {
      system.reference = integer_or(card, 1, 0, cursor);
      for (std::size_t i = 0; i < 9; ++i)
        system.points[i / 3][i % 3] = real_in(card, 2 + i, cursor);
      coordinate_systems_.add(integer_in(card, 0, cursor), system);
    } else if (name[4] == '1') {
      for (const std::size_t first : {0, 4}) {
        if (card.field(first).empty()) continue;
        for (std::size_t i = 0; i < 3; ++i)
          system.grids[i] = integer_in(card, first + 1 + i, cursor);
        coordinate_systems_.add(integer_in(card, first, cursor), system);
      }
    }
  }

  void include(const Card& card, const TextCursor& cursor, const std::string& path) {
    // the name may contain commas and blanks, so it is read from the line itself; a quoted name may
    // continue on the next lines
    TextCursor again = cursor;
    again.move_to(card.offset);
    std::string name(trimmed(trimmed(again.line()).substr(std::string_view("INCLUDE").size())));
    if (name.starts_with('\'') || name.starts_with('"')) {
      const char quote = name.front();
      while (name.find(quote, 1) == std::string::npos && !again.at_end())
        name += trimmed(again.line());
      name = name.substr(1, name.find(quote, 1) - 1);
    }
    try {
      read_file(file_beside(path, name));
    } catch (const InputError& error) {
      cursor.fail_at(card.offset, fmt::format("in the included file: {}", error.what()));
    }
  }

  /// Transforms grid points that have their own coordinate system to basic coordinates.
  void place_grids(const std::string& path) {
    if (default_system_ != 0)
      for (const std::size_t grid : unset_systems_)
        systems_of_grids_.emplace_back(grid, default_system_);
    if (systems_of_grids_.empty()) return;
    const NumberIndex index(mesh_.node_numbers);
    std::map<std::size_t, std::int64_t> pending(systems_of_grids_.begin(), systems_of_grids_.end());
    const CoordinateSystems::GridPosition position = [&](std::int64_t number) {
      const std::size_t grid = index.find(number);
      if (grid == NumberIndex::kNone || pending.contains(grid))
        throw std::invalid_argument(
            fmt::format("a coordinate system names grid point {}, which {}", number,
                        grid == NumberIndex::kNone ? "there is not" : "is in a system of its own"));
      return Point{mesh_.xyz[3 * grid], mesh_.xyz[3 * grid + 1], mesh_.xyz[3 * grid + 2]};
    };
    try {
      for (const auto& [grid, system] : systems_of_grids_) {
        const Point local{mesh_.xyz[3 * grid], mesh_.xyz[3 * grid + 1], mesh_.xyz[3 * grid + 2]};
        const Point basic = coordinate_systems_.basic(system, local, position);
        std::copy(basic.begin(), basic.end(),
                  mesh_.xyz.begin() + static_cast<std::ptrdiff_t>(3 * grid));
      }
    } catch (const std::invalid_argument& problem) {
      throw InputError(path, problem.what());
    }
  }

  static constexpr std::uint16_t kUnseen = 0xffff;
  ForeignMesh mesh_;
  std::array<std::array<std::uint16_t, 2>, kSolids.size()> solid_types_ = [] {
    std::array<std::array<std::uint16_t, 2>, kSolids.size()> unseen{};
    for (auto& types : unseen) types.fill(kUnseen);
    return unseen;
  }();
  std::map<std::int64_t, std::vector<IndexRange>> blocks_;
  CoordinateSystems coordinate_systems_;
  std::vector<std::pair<std::size_t, std::int64_t>> systems_of_grids_;
  std::vector<std::size_t> unset_systems_;
  std::int64_t default_system_ = 0;
  bool repeats_what_is_read_ = false;  ///< a following '=' entry repeats one that is read
  int depth_ = 0;
};

}  // namespace

ForeignMesh read_bulk_data(const std::string& path) { return BulkReader().run(path); }

}  // namespace hiac::formats::nastran

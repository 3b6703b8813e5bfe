#include "formats/ansys/cdb_commands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "formats/ansys/cdb_elements.hpp"
#include "formats/common/io/deck_numbers.hpp"
#include "formats/common/mesh/last_definitions.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::ansys {
namespace {

constexpr std::size_t kMostNodes = 64;
/// The number of nodes in one command.
constexpr std::size_t kInLine = 8;

/// Whether the command makes or changes nodes and elements; its first four letters are significant.
bool changes_mesh(std::string_view name) {
  constexpr std::array<std::string_view, 39> kAll{
      "FILL", "NSYM", "ESYM", "ENSY", "ENGE", "NSCA", "NMOD", "EMOD", "TRAN", "NDEL",
      "EDEL", "NUMM", "NUMC", "EMID", "MOVE", "CENT", "QUAD", "NKPT", "VMES", "AMES",
      "LMES", "KMES", "VSWE", "VEXT", "VDRA", "VROT", "FVME", "CDRE", "NREA", "EREA",
      "EINT", "EREF", "NREF", "EORI", "*DO",  "*DOW", "*REP", "*USE", "/INP"};
  return std::find(kAll.begin(), kAll.end(), name.substr(0, 4)) != kAll.end();
}

}  // namespace

void CdbCommands::refuse(std::size_t start, std::string_view what) const {
  const std::string_view line = cursor_.text().substr(start);
  cursor_.fail_at(start, fmt::format("{} expected ({} found)", what,
                                     shown(line.substr(0, line.find_first_of("\r\n")))));
}

std::int64_t CdbCommands::whole(CommaFields& fields, std::size_t start, std::string_view what,
                                std::optional<std::int64_t> otherwise) const {
  const std::string_view field = fields.at_end() ? std::string_view() : fields.field();
  if (field.empty() && otherwise) return *otherwise;
  const auto value = whole_number(field);
  if (!value) refuse(start, what);
  return *value;
}

double CdbCommands::real(CommaFields& fields, std::size_t start) const {
  if (fields.at_end()) return 0;
  const auto value = fields.real();
  if (!value) refuse(start, "a real number");
  return *value;
}

void CdbCommands::refuse_given(CommaFields& fields, std::size_t start,
                               std::string_view what) const {
  if (!fields.at_end() && real(fields, start) != 0) refuse(start, what);
}

void CdbCommands::command(const std::string& name, CommaFields fields, std::size_t start,
                          bool blocks) {
  const std::string four = name.substr(0, 4);
  try {
    if (four == "EMOR") return more_nodes(fields, start);
    CommaFields ahead = fields;
    const std::string version = upper(ahead.field());
    const bool written = version.starts_with('R');
    if (name == "EN" && written) return written_element(fields, start);
    if (name == "N" && written) return written_node(fields, start);
    flush();
    if (name == "N") return node(fields, start);
    if (name == "E" || name == "EN") return element(fields, start, name == "EN");
    if (name == "NGEN") return generate_nodes(fields, start);
    if (name == "EGEN") return generate_elements(fields, start);
    if (name == "TYPE") {
      type_.reset();
      type_ = whole(fields, start, "TYPE: a type number", 1);
    } else if (name == "CSYS") {
      system_.reset();
      system_ = whole(fields, start, "CSYS: a coordinate system", 0);
    } else if (name == "NSEL" || name == "ESEL") {
      selected_ = version != "ALL";
    } else if (four == "ALLS") {
      selected_ = false;
    }
  } catch (const InputError&) {
    if (!blocks) throw;
    pending_.reset();
    ++left_out_;
  }
  if (!blocks && not_read_.empty() && changes_mesh(name)) {
    not_read_ = name;
    not_read_at_ = start;
  }
}

/// N, NODE, X, Y, Z in the system of CSYS.
void CdbCommands::node(CommaFields& fields, std::size_t start) {
  for (; known_nodes_ < model_.mesh.node_numbers.size(); ++known_nodes_)
    last_node_ = std::clamp(model_.mesh.node_numbers[known_nodes_], last_node_, kLargestNumber);
  const std::int64_t number = whole(fields, start, "N: a node number", last_node_ + 1);
  std::array<double, 3> point{};
  for (double& x : point) x = real(fields, start);
  if (!system_ || *system_ < 0 || *system_ > 2) refuse(start, "N: a system CSYS of 0, 1 or 2");
  if (system_ > 0) {
    constexpr double kDegree = std::numbers::pi / 180;
    const double elevation = system_ == 2 ? point[2] * kDegree : 0;
    const double radius = point[0];
    const double azimuth = point[1] * kDegree;
    point[0] = radius * std::cos(azimuth) * std::cos(elevation);
    point[1] = radius * std::sin(azimuth) * std::cos(elevation);
    if (system_ == 2) point[2] = radius * std::sin(elevation);
  }
  any_nodes_ = true;
  model_.mesh.node_numbers.push_back(number);
  model_.mesh.xyz.insert(model_.mesh.xyz.end(), point.begin(), point.end());
}

/// N, R5.3, LOC, NODE, SOLID, PARM, X, Y, Z; N, R5.3, ANG, ... turns the node's own axes.
void CdbCommands::written_node(CommaFields& fields, std::size_t start) {
  flush();
  if (upper(fields.field()) != "R5.3") refuse(start, "N of version R5.3");
  const std::string kind = upper(fields.field());
  if (kind == "ANG") return;
  if (kind != "LOC") refuse(start, "N,R5.3,LOC or ANG");
  const std::int64_t number = whole(fields, start, "N: a node number");
  // the end of a block of nodes
  if (number == -1) return;
  fields.field();
  fields.field();
  // in a deck of blocks, a command that cannot be read is left out as a whole
  std::array<double, 3> point{};
  for (double& x : point) x = real(fields, start);
  any_nodes_ = true;
  model_.mesh.node_numbers.push_back(number);
  model_.mesh.xyz.insert(model_.mesh.xyz.end(), point.begin(), point.end());
}

/// EN, R5.5, ATTR, NUMN, MAT, TYPE, REAL, SECNUM, ESYS, NUMBER, SOLID, DEATH, EXCLUDE, followed by
/// EN, R5.5, NODE with eight nodes a line.
void CdbCommands::written_element(CommaFields& fields, std::size_t start) {
  if (upper(fields.field()) != "R5.5") refuse(start, "EN of version R5.5");
  const std::string kind = upper(fields.field());
  if (kind == "NODE") {
    if (!pending_ || pending_->expected == 0) refuse(start, "EN,R5.5,ATTR before EN,R5.5,NODE");
    if (pending_->nodes.size() == pending_->expected)
      refuse(start, fmt::format("EN: element {}: {} nodes", pending_->number, pending_->expected));
    for (std::size_t i = 0; i < kInLine && pending_->nodes.size() < pending_->expected; ++i) {
      if (fields.at_end()) break;
      pending_->nodes.push_back(whole(fields, start, "EN: a node number"));
    }
    return;
  }
  flush();
  if (kind != "ATTR") refuse(start, "EN,R5.5,ATTR or NODE");
  const std::int64_t count = whole(fields, start, "EN: a number of nodes");
  // the end of a block of elements
  if (count == -1) return;
  if (count < 1 || count > static_cast<std::int64_t>(kMostNodes))
    refuse(start, fmt::format("EN: 1 to {} nodes", kMostNodes));
  fields.field();
  const std::int64_t type = whole(fields, start, "EN: a type number");
  for (int skipped = 0; skipped < 3; ++skipped) fields.field();
  const std::int64_t number = whole(fields, start, "EN: an element number");
  pending_ = Pending{type, number, {}, static_cast<std::size_t>(count), start};
}

/// E, I, J, ..., P or EN, NUMBER, I, J, ..., P: an element of the type that TYPE set.
void CdbCommands::element(CommaFields& fields, std::size_t start, bool numbered) {
  for (; known_elements_ < model_.mesh.cell_numbers.size(); ++known_elements_)
    last_element_ =
        std::clamp(model_.mesh.cell_numbers[known_elements_], last_element_, kLargestNumber);
  const std::int64_t number = numbered
                                  ? whole(fields, start, "EN: an element number", last_element_ + 1)
                                  : last_element_ + 1;
  if (!type_) refuse(start, "E: a type that TYPE names by its number");
  Pending made{*type_, number, {}, 0, start};
  while (!fields.at_end() && made.nodes.size() < kInLine)
    made.nodes.push_back(whole(fields, start, "E: a node number", 0));
  if (!fields.field().empty()) refuse(start, "E: at most 8 nodes");
  if (made.nodes.empty()) refuse(start, "E: nodes");
  pending_ = std::move(made);
}

/// EMORE: the 9th to 16th, and 17th to 24th, nodes of the preceding element.
void CdbCommands::more_nodes(CommaFields& fields, std::size_t start) {
  if (!pending_ || pending_->expected > 0) refuse(start, "E or EN before EMORE");
  pending_->nodes.resize((pending_->nodes.size() + kInLine - 1) / kInLine * kInLine);
  if (pending_->nodes.size() >= kMostNodes)
    refuse(start, fmt::format("at most {} nodes", kMostNodes));
  for (std::size_t i = 0; i < kInLine && !fields.at_end(); ++i)
    pending_->nodes.push_back(whole(fields, start, "EMORE: a node number", 0));
}

void CdbCommands::flush() {
  if (!pending_) return;
  Pending made = std::move(*pending_);
  pending_.reset();
  if (made.nodes.size() < made.expected)
    refuse(made.start, fmt::format("EN: element {}: {} nodes ({} are there)", made.number,
                                   made.expected, made.nodes.size()));
  if (made.expected == 0) {
    const std::size_t own = library_nodes(model_.routine_of(made.type), model_.shape_of(made.type));
    if (own > 0 && made.nodes.size() > own &&
        std::any_of(made.nodes.begin() + static_cast<long>(own), made.nodes.end(),
                    [](std::int64_t node) { return node != 0; }))
      refuse(made.start, fmt::format("E: element {}: at most {} nodes", made.number, own));
    if (own > 0) made.nodes.resize(own);
  }
  for (std::int64_t& node : made.nodes)
    if (node == 0) node = kLeftOutNode;
  any_elements_ = true;
  model_.add_element(made.type, made.number, made.nodes);
}

void CdbCommands::take(std::size_t start, std::size_t numbers) {
  if (numbers > kMostMade - made_)
    refuse(start, fmt::format("at most {} numbers of nodes and elements made by NGEN and EGEN",
                              kMostMade));
  made_ += numbers;
}

void CdbCommands::refuse_large(std::int64_t number, std::size_t start) const {
  if (number < -kLargestNumber || number > kLargestNumber)
    refuse(start, fmt::format("numbers of nodes and elements of at most {}, not {},",
                              kLargestNumber, number));
}

std::int64_t CdbCommands::largest_element(std::size_t start) const {
  const std::vector<std::int64_t>& numbers = model_.mesh.cell_numbers;
  const auto largest = std::max_element(numbers.begin(), numbers.end());
  if (largest == numbers.end()) return 0;
  refuse_large(*largest, start);
  return *largest;
}

std::vector<std::size_t> CdbCommands::pattern(CommaFields& fields, std::size_t start,
                                              std::string_view command, bool elements) {
  const std::vector<std::int64_t>& numbers =
      elements ? model_.mesh.cell_numbers : model_.mesh.node_numbers;
  CommaFields ahead = fields;
  const bool all = upper(ahead.field()) == "ALL";
  std::int64_t first = 1;
  std::int64_t last = kLargestNumber;
  std::int64_t step = 1;
  if (all) {
    if (selected_)
      refuse(start, fmt::format("{} of numbers, not of what NSEL or ESEL chose,", command));
    fields.field();
    fields.field();
    fields.field();
  } else {
    first = whole(fields, start, fmt::format("{}: a number", command));
    last = whole(fields, start, fmt::format("{}: a number", command), first);
    step = whole(fields, start, fmt::format("{}: a step", command), 1);
    if (elements && first < 0) {
      // a negative number selects that many element numbers, up to the largest
      last = largest_element(start);
      first = last + first + 1;
    }
  }
  if (step == 0) step = 1;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] >= first && numbers[i] <= last && (numbers[i] - first) % step == 0)
      places.push_back(i);
  std::stable_sort(places.begin(), places.end(),
                   [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
  // of entries with the same number, the last is kept
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (i + 1 == places.size() || numbers[places[i]] != numbers[places[i + 1]])
      places[kept++] = places[i];
  places.resize(kept);
  if (places.empty()) refuse(start, fmt::format("{} of what is there by then", command));
  return places;
}

/// NGEN, ITIME, INC, NODE1, NODE2, NINC, DX, DY, DZ, SPACE
void CdbCommands::generate_nodes(CommaFields& fields, std::size_t start) {
  const std::int64_t times = whole(fields, start, "NGEN: a number of times", 1);
  const std::int64_t increment = whole(fields, start, "NGEN: an increment");
  const std::vector<std::size_t> from = pattern(fields, start, "NGEN", false);
  std::array<double, 3> step{};
  for (double& x : step) x = real(fields, start);
  const double space = fields.at_end() ? 1 : real(fields, start);
  if (space != 1 && space != 0) refuse(start, "NGEN: a SPACE of 1");
  if (system_ != 0) refuse(start, "NGEN: a system CSYS of 0");
  if (times < 2) return;
  take(start, 4 * from.size());
  take(start, 4 * from.size() * static_cast<std::size_t>(times - 1));
  ForeignMesh& mesh = model_.mesh;
  for (std::int64_t i = 1; i < times; ++i)
    for (const std::size_t place : from) {
      mesh.node_numbers.push_back(mesh.node_numbers[place] + i * increment);
      for (std::size_t c = 0; c < 3; ++c)
        mesh.xyz.push_back(mesh.xyz[3 * place + c] + static_cast<double>(i) * step[c]);
    }
}

/// EGEN, ITIME, NINC, IEL1, IEL2, IEINC, MINC, TINC, RINC, CINC, SINC, DX, DY, DZ: new elements get
/// the next free numbers.
void CdbCommands::generate_elements(CommaFields& fields, std::size_t start) {
  const std::int64_t times = whole(fields, start, "EGEN: a number of times", 1);
  const std::int64_t increment = whole(fields, start, "EGEN: an increment", 0);
  const std::vector<std::size_t> from = pattern(fields, start, "EGEN", true);
  fields.field();
  refuse_given(fields, start, "EGEN: a TINC of 0");
  for (int skipped = 0; skipped < 3; ++skipped) fields.field();
  for (int c = 0; c < 3; ++c) refuse_given(fields, start, "EGEN: a DX, DY and DZ of 0");
  if (times < 2) return;
  ForeignMesh& mesh = model_.mesh;
  std::vector<std::size_t> begins(mesh.cell_count() + 1);
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell)
    begins[cell + 1] = begins[cell] + mesh.types[mesh.cell_types[cell]].nodes;
  std::size_t numbers = 0;
  for (const std::size_t place : from) {
    numbers += 2 + begins[place + 1] - begins[place];
    for (std::size_t n = begins[place]; n < begins[place + 1]; ++n)
      if (mesh.cell_nodes[n] != kLeftOutNode) refuse_large(mesh.cell_nodes[n], start);
  }
  take(start, numbers);
  take(start, numbers * static_cast<std::size_t>(times - 1));
  std::int64_t next = largest_element(start);
  for (std::int64_t i = 1; i < times; ++i)
    for (const std::size_t place : from) {
      mesh.cell_numbers.push_back(++next);
      mesh.cell_types.push_back(mesh.cell_types[place]);
      for (std::size_t n = begins[place]; n < begins[place + 1]; ++n) {
        const std::int64_t node = mesh.cell_nodes[n];
        mesh.cell_nodes.push_back(node == kLeftOutNode ? node : node + i * increment);
      }
    }
}

void CdbCommands::finish(bool blocks) {
  flush();
  if (!blocks && !not_read_.empty())
    cursor_.fail_at(
        not_read_at_,
        fmt::format("{} makes or changes nodes or elements that the file does not list, "
                    "which is not supported",
                    not_read_));
  ForeignMesh& mesh = model_.mesh;
  if (any_nodes_) keep_last_points(mesh.node_numbers, mesh.xyz);
  if (any_elements_)
    keep_last_cells(mesh.cell_numbers, mesh.cell_types, mesh.cell_nodes, mesh.types);
  if (left_out_ > 0)
    mesh.notes.push_back(fmt::format(
        "left out {} commands on nodes, elements or types that do not name them by numbers",
        left_out_));
}

}  // namespace hiac::formats::ansys

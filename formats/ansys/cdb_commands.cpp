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

void CdbCommands::command(const std::string& name, CommaFields comma_fields, std::size_t start,
                          bool blocks) {
  const std::string four = name.substr(0, 4);
  CommandFields fields(comma_fields, cursor_, start);
  try {
    if (four == "EMOR") return more_nodes(fields);
    const std::string version = fields.peek();
    const bool written = version.starts_with('R');
    if (name == "EN" && written) return written_element(fields);
    if (name == "N" && written) return written_node(fields);
    flush();
    if (name == "N") return node(fields);
    if (name == "E" || name == "EN") return element(fields, name == "EN");
    if (name == "NGEN") return generation_.nodes(fields, selected_, system_ == 0);
    if (name == "EGEN") return generation_.elements(fields, selected_);
    if (name == "TYPE") {
      type_.reset();
      type_ = fields.whole("TYPE: a type number", 1);
    } else if (name == "CSYS") {
      system_.reset();
      system_ = fields.whole("CSYS: a coordinate system", 0);
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
void CdbCommands::node(CommandFields& fields) {
  for (; known_nodes_ < model_.mesh.node_numbers.size(); ++known_nodes_)
    last_node_ = std::clamp(model_.mesh.node_numbers[known_nodes_], last_node_, kLargestNumber);
  const std::int64_t number = fields.whole("N: a node number", last_node_ + 1);
  std::array<double, 3> point{};
  for (double& x : point) x = fields.real();
  if (!system_ || *system_ < 0 || *system_ > 2) fields.refuse("N: a system CSYS of 0, 1 or 2");
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
void CdbCommands::written_node(CommandFields& fields) {
  flush();
  if (fields.word() != "R5.3") fields.refuse("N of version R5.3");
  const std::string kind = fields.word();
  if (kind == "ANG") return;
  if (kind != "LOC") fields.refuse("N,R5.3,LOC or ANG");
  const std::int64_t number = fields.whole("N: a node number");
  // the end of a block of nodes
  if (number == -1) return;
  fields.skip(2);
  // in a deck of blocks, a command that cannot be read is left out as a whole
  std::array<double, 3> point{};
  for (double& x : point) x = fields.real();
  any_nodes_ = true;
  model_.mesh.node_numbers.push_back(number);
  model_.mesh.xyz.insert(model_.mesh.xyz.end(), point.begin(), point.end());
}

/// EN, R5.5, ATTR, NUMN, MAT, TYPE, REAL, SECNUM, ESYS, NUMBER, SOLID, DEATH, EXCLUDE, followed by
/// EN, R5.5, NODE with eight nodes a line.
void CdbCommands::written_element(CommandFields& fields) {
  if (fields.word() != "R5.5") fields.refuse("EN of version R5.5");
  const std::string kind = fields.word();
  if (kind == "NODE") {
    if (!pending_ || pending_->expected == 0) fields.refuse("EN,R5.5,ATTR before EN,R5.5,NODE");
    if (pending_->nodes.size() == pending_->expected)
      fields.refuse(fmt::format("EN: element {}: {} nodes", pending_->number, pending_->expected));
    for (std::size_t i = 0; i < kInLine && pending_->nodes.size() < pending_->expected; ++i) {
      if (fields.at_end()) break;
      pending_->nodes.push_back(fields.whole("EN: a node number"));
    }
    return;
  }
  flush();
  if (kind != "ATTR") fields.refuse("EN,R5.5,ATTR or NODE");
  const std::int64_t count = fields.whole("EN: a number of nodes");
  // the end of a block of elements
  if (count == -1) return;
  if (count < 1 || count > static_cast<std::int64_t>(kMostNodes))
    fields.refuse(fmt::format("EN: 1 to {} nodes", kMostNodes));
  fields.skip(1);
  const std::int64_t type = fields.whole("EN: a type number");
  fields.skip(3);
  const std::int64_t number = fields.whole("EN: an element number");
  pending_ = Pending{type, number, {}, static_cast<std::size_t>(count), fields.start()};
}

/// E, I, J, ..., P or EN, NUMBER, I, J, ..., P: an element of the type that TYPE set.
void CdbCommands::element(CommandFields& fields, bool numbered) {
  for (; known_elements_ < model_.mesh.cell_numbers.size(); ++known_elements_)
    last_element_ =
        std::clamp(model_.mesh.cell_numbers[known_elements_], last_element_, kLargestNumber);
  const std::int64_t number =
      numbered ? fields.whole("EN: an element number", last_element_ + 1) : last_element_ + 1;
  if (!type_) fields.refuse("E: a type that TYPE names by its number");
  Pending made{*type_, number, {}, 0, fields.start()};
  while (!fields.at_end() && made.nodes.size() < kInLine)
    made.nodes.push_back(fields.whole("E: a node number", 0));
  if (!fields.word().empty()) fields.refuse("E: at most 8 nodes");
  if (made.nodes.empty()) fields.refuse("E: nodes");
  pending_ = std::move(made);
}

/// EMORE: the 9th to 16th, and 17th to 24th, nodes of the preceding element.
void CdbCommands::more_nodes(CommandFields& fields) {
  if (!pending_ || pending_->expected > 0) fields.refuse("E or EN before EMORE");
  pending_->nodes.resize((pending_->nodes.size() + kInLine - 1) / kInLine * kInLine);
  if (pending_->nodes.size() >= kMostNodes)
    fields.refuse(fmt::format("at most {} nodes", kMostNodes));
  for (std::size_t i = 0; i < kInLine && !fields.at_end(); ++i)
    pending_->nodes.push_back(fields.whole("EMORE: a node number", 0));
}

void CdbCommands::flush() {
  if (!pending_) return;
  Pending made = std::move(*pending_);
  pending_.reset();
  if (made.nodes.size() < made.expected)
    refuse_command(cursor_, made.start,
                   fmt::format("EN: element {}: {} nodes ({} are there)", made.number,
                               made.expected, made.nodes.size()));
  if (made.expected == 0) {
    const std::size_t own = library_nodes(model_.routine_of(made.type), model_.shape_of(made.type));
    if (own > 0 && made.nodes.size() > own &&
        std::any_of(made.nodes.begin() + static_cast<long>(own), made.nodes.end(),
                    [](std::int64_t node) { return node != 0; }))
      refuse_command(cursor_, made.start,
                     fmt::format("E: element {}: at most {} nodes", made.number, own));
    if (own > 0) made.nodes.resize(own);
  }
  for (std::int64_t& node : made.nodes)
    if (node == 0) node = kLeftOutNode;
  any_elements_ = true;
  model_.add_element(made.type, made.number, made.nodes);
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

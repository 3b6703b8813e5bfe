#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/ansys/cdb_generation.hpp"
#include "formats/ansys/cdb_model.hpp"
#include "formats/ansys/command_fields.hpp"
#include "formats/common/io/comma_fields.hpp"
#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::ansys {

/// Nodes and elements that are defined by single commands: N and EN as CDWRITE writes them with the
/// option UNBLOCKED (Programmer's Reference, "Coded database file commands": N,R5.3,LOC and
/// EN,R5.5), and those of users' decks (Command Reference): N, E, EN, EMORE, TYPE, CSYS, NGEN,
/// EGEN. A deck that has any of these is refused if another command makes or changes the mesh, and
/// the message names it. In a deck of blocks, which may hold commands with parameters, such
/// commands are left out, with a note.
class CdbCommands {
 public:
  CdbCommands(CdbModel& model, const TextCursor& cursor)
      : model_(model), cursor_(cursor), generation_(model) {}

  /// Executes the command whose line begins at `start`; `name` is in capitals. `blocks`: the deck
  /// has defined nodes or elements in blocks. Throws InputError naming the line.
  void command(const std::string& name, CommaFields fields, std::size_t start, bool blocks);

  /// To be called at the end of the deck, `blocks` as above: completes the last element, refuses
  /// what is not supported, and keeps the last of several nodes or elements with one number.
  void finish(bool blocks);

  /// Counts a command that is left out.
  void leave_out() { ++left_out_; }

  [[nodiscard]] bool any_nodes() const { return any_nodes_; }
  [[nodiscard]] bool any_elements() const { return any_elements_; }

 private:
  /// An element to which further commands may add nodes.
  struct Pending {
    std::int64_t type;
    std::int64_t number;
    std::vector<std::int64_t> nodes;
    std::size_t expected;  ///< the required number of nodes; 0: any number
    std::size_t start;
  };

  void node(CommandFields& fields);
  void written_node(CommandFields& fields);
  void element(CommandFields& fields, bool numbered);
  void written_element(CommandFields& fields);
  void more_nodes(CommandFields& fields);
  void flush();

  CdbModel& model_;
  const TextCursor& cursor_;
  CdbGeneration generation_;
  bool any_nodes_ = false;
  bool any_elements_ = false;
  bool selected_ = false;        ///< NSEL or ESEL chose some
  std::string not_read_;         ///< the first command that changes a mesh and is not read
  std::size_t not_read_at_ = 0;  ///< the position of that command
  std::optional<std::int64_t> system_ = 0;  ///< CSYS; none: given by a parameter
  std::optional<std::int64_t> type_ = 1;    ///< TYPE
  std::int64_t last_node_ = 0;              ///< the largest number
  std::int64_t last_element_ = 0;           ///< the largest number
  std::size_t known_nodes_ = 0;             ///< how many of the mesh last_node_ takes into account
  std::size_t known_elements_ = 0;
  std::size_t left_out_ = 0;
  std::optional<Pending> pending_;
};

}  // namespace hiac::formats::ansys

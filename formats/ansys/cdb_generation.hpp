#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "formats/ansys/cdb_model.hpp"
#include "formats/ansys/command_fields.hpp"

namespace hiac::formats::ansys {

/// The commands by which users' decks repeat nodes and elements (Command Reference): NGEN and EGEN.
/// Throws InputError naming the line.
class CdbGeneration {
 public:
  explicit CdbGeneration(CdbModel& model) : model_(model) {}

  /// NGEN. `selected`: NSEL or ESEL chose some. `cartesian`: the coordinate system is 0.
  void nodes(CommandFields& fields, bool selected, bool cartesian);
  /// EGEN: new elements get the next free numbers.
  void elements(CommandFields& fields, bool selected);

 private:
  /// The places of nodes or elements that a first number, a last number and a step select, or all
  /// of them.
  std::vector<std::size_t> pattern(CommandFields& fields, bool selected, std::string_view command,
                                   bool elements) const;
  [[nodiscard]] std::int64_t largest_element(const CommandFields& fields) const;
  /// Counts numbers that are made; refuses more than a deck may make.
  void take(const CommandFields& fields, std::size_t numbers);

  CdbModel& model_;
  std::size_t made_ = 0;
};

}  // namespace hiac::formats::ansys

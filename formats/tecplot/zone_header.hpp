#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "formats/common/io/text_cursor.hpp"
#include "formats/tecplot/tecplot_tokens.hpp"
#include "formats/tecplot/tecplot_zones.hpp"

namespace hiac::formats::tecplot {

/// The NAME=VALUE pairs between the word ZONE of an ASCII data file and the zone's data.
class ZoneHeader {
 public:
  /// Reads the pairs up to the first number, which begins the data, or to the next ZONE. Throws
  /// InputError naming the line.
  ZoneHeader(TextCursor& cursor, Tokens& tokens);

  /// The value of a name in capitals; null when the header does not have it.
  [[nodiscard]] const std::string* value(const std::string& name) const;
  /// A count, 0 when the header does not have it. Throws InputError when the file cannot hold it.
  [[nodiscard]] std::size_t count(const std::string& name) const { return count(name, name, 0); }

  /// The zone without its data: name, time, element, sizes, and the location of each of `variables`
  /// variables, whose values are empty. Throws InputError for what is not supported.
  [[nodiscard]] Zone zone(std::size_t variables) const;
  /// Whether values are stored variable by variable, not point by point.
  [[nodiscard]] bool is_block() const { return packing() == "BLOCK"; }

  /// Throws InputError naming the line of the header.
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  void read(Tokens& tokens, TextCursor& cursor);
  /// The first of two names that the header has.
  [[nodiscard]] std::size_t count(const std::string& name, const std::string& other,
                                  std::size_t otherwise) const;
  /// F or DATAPACKING, without the FE by which older files mark finite elements.
  [[nodiscard]] std::string packing() const;
  void set_element(Zone& zone) const;
  void set_sizes(Zone& zone) const;
  void set_grid_sizes(Zone& zone) const;

  const TextCursor& cursor_;
  std::size_t start_;
  std::map<std::string, std::string> pairs_;
};

}  // namespace hiac::formats::tecplot

#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "formats/abaqus/inp_lines.hpp"
#include "formats/abaqus/inp_model.hpp"

namespace hiac::formats::abaqus {

/// How much a deck's keywords have generated so far. A few data lines can ask for any amount.
struct Made {
  std::size_t numbers = 0;    ///< of nodes and elements: their numbers, coordinates, nodes
  std::size_t looked_at = 0;  ///< numbers of sets that were looked up
};

/// A keyword that generates nodes or elements from existing ones (Abaqus Keywords Reference: *NGEN,
/// *NFILL, *NCOPY, *ELGEN, *ELCOPY), and the objects that it works on.
struct Generation {
  const Keyword& keyword;
  TextCursor& cursor;
  Part& part;
  const std::vector<ForeignType>& types;
  bool system;  ///< a *SYSTEM is in effect
  Made& made;
};

/// Whether `keyword` is such a keyword, or *NMAP, which is refused.
bool makes_mesh(std::string_view keyword);

/// Reads the keyword's data lines and generates the nodes or elements. Throws InputError naming the
/// line if it cannot be parsed, if it names something that does not exist, if more than 16 million
/// numbers are generated in all, or for what is not supported: *NMAP, *NFILL SINGULAR, *NCOPY POLE,
/// and coordinates that *SYSTEM would move.
void generate(const Generation& generation);

/// Where several nodes or elements have one number, keeps the last, as Abaqus does.
void keep_last_definitions(Part& part, const std::vector<ForeignType>& types);

/// Counts numbers that are about to be generated. Throws InputError naming the line when there are
/// too many.
void take(const Generation& generation, std::string_view line, std::size_t numbers);

/// Throws the InputError that names what is not supported.
[[noreturn]] void not_supported(const Generation& generation, std::string_view what);

/// A whole number of a data line, which may be written as a real (2.0); `otherwise`, if given, when
/// the field is empty or missing. At most 999999999 in absolute value, as in Abaqus.
std::int64_t whole_in(CommaFields& fields, const TextCursor& cursor, std::string_view line,
                      std::string_view what, std::optional<std::int64_t> otherwise = std::nullopt);

/// The whole number of a required parameter.
std::int64_t whole_parameter(const Generation& generation, std::string_view parameter);

/// `number`, from which other node or element numbers are counted. Throws InputError when it is
/// larger than Abaqus allows.
std::int64_t checked_number(const Generation& generation, std::int64_t number);

/// The keyword's own line, for messages.
std::string_view keyword_line(const Generation& generation);

/// *NGEN, *NFILL and *NCOPY.
void generate_nodes(const Generation& generation);

}  // namespace hiac::formats::abaqus

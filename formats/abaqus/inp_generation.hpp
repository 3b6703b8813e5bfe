#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "formats/abaqus/inp_lines.hpp"
#include "formats/abaqus/inp_model.hpp"

namespace hiac::formats::abaqus {

/// What a deck's keywords have made so far. Their data lines are few and may ask for anything.
struct Made {
  std::size_t numbers = 0;    ///< of nodes and elements: their numbers, coordinates, nodes
  std::size_t looked_at = 0;  ///< numbers of sets that were tried
};

/// A keyword that makes nodes or elements from those that there are (Abaqus Keywords Reference:
/// *NGEN, *NFILL, *NCOPY, *ELGEN, *ELCOPY), and what it works on.
struct Generation {
  const Keyword& keyword;
  TextCursor& cursor;
  Part& part;
  const std::vector<ForeignType>& types;
  bool system;  ///< a *SYSTEM is in effect
  Made& made;
};

/// Whether that is the name of such a keyword, or of *NMAP, which is refused.
bool makes_mesh(std::string_view keyword);

/// Reads the keyword's data lines and makes what they say. Throws InputError naming the line, where
/// it is not understood, names what there is not, makes more than 16 million numbers in all, or
/// asks for what is not read: *NMAP, *NFILL SINGULAR, *NCOPY POLE; what *SYSTEM would move.
void generate(const Generation& generation);

/// Of nodes and elements with one number keeps the last, as Abaqus does.
void keep_last_definitions(Part& part, const std::vector<ForeignType>& types);

/// Counts numbers that are about to be made. Throws InputError naming the line when it is too many.
void take(const Generation& generation, std::string_view line, std::size_t numbers);

/// Refuses the keyword by name.
[[noreturn]] void not_supported(const Generation& generation, std::string_view what);

/// A whole number of a data line, which may be written as a real (2.0); `otherwise` where the field
/// is empty or not there, if that is given. At most 999999999 in size, as in Abaqus.
std::int64_t whole_in(CommaFields& fields, const TextCursor& cursor, std::string_view line,
                      std::string_view what, std::optional<std::int64_t> otherwise = std::nullopt);

/// The whole number that a parameter has to give.
std::int64_t whole_parameter(const Generation& generation, std::string_view parameter);

/// The number of a node or element from which others are counted. Throws InputError where it is
/// larger than Abaqus takes.
std::int64_t checked_number(const Generation& generation, std::int64_t number);

/// The keyword's own line, for messages.
std::string_view keyword_line(const Generation& generation);

/// *NGEN, *NFILL and *NCOPY.
void generate_nodes(const Generation& generation);

}  // namespace hiac::formats::abaqus

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace hiac {

/// Edits of a specification in its text: what is not edited stays where it is, byte for byte,
/// comments included.
///
/// A key is one as overrides have it (specification.hpp): `camera.fov`, `isosurface.0.value`,
/// `volume.color.points.2`; elements of lists are counted from 0. What the text says afterwards is
/// what the override KEY=VALUE makes of what it said before. Values are TOML (toml_text in
/// spec_key.hpp writes them).
///
/// All throw InputError if the text is no TOML, and UsageError with the key if the key is malformed
/// or leads below a plain value or to an element that a list does not have, or if the value is no
/// TOML.

/// Sets a key. A value that stands in the text is replaced; a new one comes behind the last key of
/// its table; a table that does not exist is added behind its relatives. Throws UsageError if the
/// key is a table or a list of tables with headers.
std::string with_key(std::string_view text, std::string_view key, std::string_view value);

/// Removes a key, with the comment behind it on its line. A key that does not exist is none to
/// remove. Throws UsageError if it is a table with a header.
std::string without_key(std::string_view text, std::string_view key);

/// Puts a value before an element of a list in brackets; the number of elements adds it at the end.
std::string with_element(std::string_view text, std::string_view element, std::string_view value);

/// Adds a table (`volume.color`) or an element of a list of tables (`isosurface.1`, where there is
/// one), with at least one key. Throws UsageError if it exists.
std::string with_table(std::string_view text, std::string_view table,
                       std::span<const std::pair<std::string, std::string>> keys);

/// Removes a table and all tables below it: the lines from the header to the last key, comments
/// between them included. A table that does not exist is none to remove.
std::string without_table(std::string_view text, std::string_view table);

}  // namespace hiac

#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "formats/vtk/legacy/legacy_words.hpp"
#include "formats/vtk/number_type.hpp"

namespace hiac::formats::vtk {

/// The next word as the type of an array. Throws through `words` when it is none, or one that VTK's
/// reader does not accept here: texts and bits where numbers are expected (`numeric`).
NumberType read_legacy_type(LegacyWords& words, bool numeric);

/// The position of an array's values in a legacy file: bytes [begin, end).
struct LegacyValues {
  std::size_t begin = 0;
  std::size_t end = 0;
  bool has_not_finite = false;  ///< ASCII values that are nan or inf
};

/// Walks through `count` values from the position of `words`. Throws through `words` when values
/// are missing, or a word is not a number of the type; values that are not finite are recorded if
/// they are allowed.
LegacyValues walk_legacy_values(LegacyWords& words, const NumberType& type, std::size_t count,
                                bool may_be_not_finite);

/// The same for an array, which may hold texts and may be followed by METADATA.
LegacyValues walk_legacy_array(LegacyWords& words, const NumberType& type, std::size_t tuples,
                               std::size_t components, bool may_be_not_finite);

/// A word of an ASCII array that says nan or inf.
struct NotFiniteWord {
  std::size_t at;      ///< first byte of the word
  std::size_t length;  ///< of the word
  std::size_t index;   ///< of the value in its array
  double value;
};

/// Calls `found` for every such word of an array of real numbers that lies in text[begin, end).
void for_each_not_finite(std::string_view text, std::size_t begin, std::size_t end,
                         const std::function<void(const NotFiniteWord&)>& found);

}  // namespace hiac::formats::vtk

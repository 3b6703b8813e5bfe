#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace hiac::formats::vtk {

/// The type of the elements of an array in a VTK file.
struct NumberType {
  enum class Family : std::uint8_t { signed_integer, unsigned_integer, real, bit, text, variant };
  Family family;
  std::size_t bytes;  ///< of one element in binary data; 0 for bits and texts
};

/// The type with the name `name` in a legacy file ("float", "vtkIdType", ...; any case).
std::optional<NumberType> legacy_number_type(std::string_view name);

/// The type with the name `name` in an XML file ("Float64", "UInt8", "String", ...).
std::optional<NumberType> xml_number_type(std::string_view name);

/// The kinds of words in an ASCII array.
enum class AsciiNumber : std::uint8_t {
  fine,        ///< a number of the type that a C++ stream reads
  not_finite,  ///< nan or inf, which C++ streams do not read
  malformed    ///< no number, or none that the type can hold
};

/// Classifies a word; `value` is the value of a real-valued word (also when it is not finite).
AsciiNumber judge_ascii_number(std::string_view word, const NumberType& type, double& value);

}  // namespace hiac::formats::vtk

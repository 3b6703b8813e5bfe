#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace hiac::formats::vtk {

/// What the elements of an array in a VTK file are.
struct NumberType {
  enum class Family : std::uint8_t { signed_integer, unsigned_integer, real, bit, text, variant };
  Family family;
  std::size_t bytes;  ///< of one element in binary data; 0 for bits and texts
};

/// The type that a legacy file calls `name` ("float", "vtkIdType", ...; any case).
std::optional<NumberType> legacy_number_type(std::string_view name);

/// The type that an XML file calls `name` ("Float64", "UInt8", "String", ...).
std::optional<NumberType> xml_number_type(std::string_view name);

/// What one word of an ASCII array is.
enum class AsciiNumber : std::uint8_t {
  fine,        ///< a number of the type that a C++ stream reads
  not_finite,  ///< nan or inf, which C++ streams do not read
  malformed    ///< no number, or none that the type can hold
};

/// Judges a word; `value` is what a real-valued word says (also when not finite).
AsciiNumber judge_ascii_number(std::string_view word, const NumberType& type, double& value);

}  // namespace hiac::formats::vtk

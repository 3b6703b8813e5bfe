#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/vtk/number_type.hpp"

namespace hiac::formats::vtk {

/// How an XML file stores binary data: attributes of its root element.
struct XmlStorage {
  enum class Compressor : std::uint8_t { none, zlib, lz4, lzma };
  bool big_endian = false;
  std::size_t header_bytes = 4;  ///< of one word of an array's header
  Compressor compressor = Compressor::none;
};

/// One array of an XML file: the position of its data and their encoding.
struct XmlArray {
  enum class Encoding : std::uint8_t { ascii, base64, raw };
  std::string name;
  NumberType type{};
  std::size_t components = 1;
  Encoding encoding{};
  std::string_view data;  ///< from its first byte to the end of the section that holds it
  bool has_not_finite = false;
};

/// Checks that the array's data contain `values` numbers (texts: at least that many bytes) and are
/// complete: all words exist and are numbers, or the headers are consistent with each other and
/// with the bytes. If `may_be_not_finite`, records values that are not finite. Throws
/// InputError(subject, ...).
void check_xml_array(XmlArray& array, std::size_t values, const XmlStorage& storage,
                     bool may_be_not_finite, const std::string& subject);

/// `count` integers of a checked array from number `first` on. Throws InputError(subject, ...) when
/// they cannot be decompressed.
std::vector<std::int64_t> read_xml_integers(const XmlArray& array, std::size_t first,
                                            std::size_t count, const XmlStorage& storage,
                                            const std::string& subject);

/// `count` numbers of a checked array of any type but text, from the first on. Throws
/// InputError(subject, ...) when they cannot be decompressed.
std::vector<double> read_xml_reals(const XmlArray& array, std::size_t count,
                                   const XmlStorage& storage, const std::string& subject);

}  // namespace hiac::formats::vtk

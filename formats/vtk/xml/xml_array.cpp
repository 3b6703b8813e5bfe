// Based on: "VTK XML Formats" (VTK file formats documentation), and the behaviour of the reader
// (vtkXMLDataParser of VTK 9.1), which trusts the headers that are checked here.
#include "formats/vtk/xml/xml_array.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <limits>

#include <fmt/format.h>
#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include "formats/common/io/printable.hpp"
#include "formats/vtk/legacy/legacy_words.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

using Compressor = XmlStorage::Compressor;
using Encoding = XmlArray::Encoding;
using Bytes = std::vector<unsigned char>;

[[noreturn]] void fail(const XmlArray& array, const std::string& what, const std::string& subject) {
  throw InputError(subject, printable(fmt::format("array '{}': {}", array.name, what)));
}

[[noreturn]] void fail_short(const XmlArray& array, std::size_t expected, std::size_t found,
                             std::string_view unit, const std::string& subject) {
  fail(array,
       fmt::format("the data end too soon ({} {} expected, {} found)", expected, unit, found),
       subject);
}

/// The value of a base64 digit; -1 for other characters.
int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

constexpr std::size_t base64_length(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

/// Part of an array's data: one run of bytes, raw or in one base64 stream.
class ByteRun {
 public:
  ByteRun(const XmlArray& array, std::size_t at, const std::string& subject)
      : array_(array),
        text_(array.data.substr(std::min(at, array.data.size()))),
        subject_(subject) {}

  /// The number of characters that encode `bytes` bytes in the file.
  [[nodiscard]] std::size_t length(std::size_t bytes) const {
    return array_.encoding == Encoding::base64 ? base64_length(bytes) : bytes;
  }

  /// Throws unless there are `bytes` bytes.
  void require(std::size_t bytes) const {
    if (bytes > text_.size() || length(bytes) > text_.size())
      fail_short(array_, bytes, text_.size(), "bytes", subject_);
    if (array_.encoding != Encoding::base64) return;
    const std::string_view digits = text_.substr(0, length(bytes));
    const std::size_t plain = bytes / 3 * 4 + (bytes % 3 == 0 ? 0 : bytes % 3 + 1);
    for (std::size_t i = 0; i < digits.size(); ++i)
      if (i < plain ? base64_value(digits[i]) < 0 : digits[i] == '<')
        fail_short(array_, plain, i, "base64 digits", subject_);
  }

  /// The bytes [first, first + count), which must exist.
  [[nodiscard]] Bytes read(std::size_t first, std::size_t count) const {
    Bytes result;
    result.reserve(count);
    if (array_.encoding != Encoding::base64) {
      const std::string_view part = text_.substr(first, count);
      result.assign(part.begin(), part.end());
      return result;
    }
    for (std::size_t i = first; i < first + count; ++i) {
      const std::size_t digit = i / 3 * 4 + i % 3;
      const int high = base64_value(text_[digit]);
      const int low = base64_value(text_[digit + 1]);
      const int shift = 2 * static_cast<int>(i % 3);
      result.push_back(static_cast<unsigned char>((high << (2 + shift)) | (low >> (4 - shift))));
    }
    return result;
  }

 private:
  const XmlArray& array_;
  std::string_view text_;
  const std::string& subject_;
};

std::uint64_t word_of(const unsigned char* bytes, std::size_t size, bool big_endian) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < size; ++i) word = word << 8 | bytes[big_endian ? i : size - 1 - i];
  return word;
}

/// The header of compressed data: block sizes.
struct Blocks {
  std::size_t size = 0;  ///< of a block, uncompressed
  std::size_t last = 0;  ///< of the last one
  std::vector<std::size_t> compressed;
  std::size_t data_at = 0;  ///< the start of the first block in the array's data

  [[nodiscard]] std::size_t total() const {
    return compressed.empty() ? 0 : (compressed.size() - 1) * size + last;
  }
};

/// Compressed data do not expand more than this: deflate's limit is 1032, LZ4's 255. A block that
/// declares more is damaged, and no memory is allocated for it.
std::size_t largest_expansion(Compressor compressor) {
  switch (compressor) {
    case Compressor::zlib:
      return 1040;
    case Compressor::lz4:
      return 256;
    case Compressor::lzma:
      return 16384;
    case Compressor::none:
      break;
  }
  return 1;
}

Blocks read_blocks(const XmlArray& array, const XmlStorage& storage, const std::string& subject) {
  const std::size_t word = storage.header_bytes;
  const ByteRun header(array, 0, subject);
  header.require(3 * word);
  const Bytes first = header.read(0, 3 * word);
  const std::uint64_t count = word_of(&first[0], word, storage.big_endian);
  Blocks blocks;
  blocks.size = word_of(&first[word], word, storage.big_endian);
  const std::uint64_t partial = word_of(&first[2 * word], word, storage.big_endian);
  if (count > array.data.size())
    fail(array, fmt::format("wrong number of compressed blocks ({})", count), subject);
  if (count > 0 && (blocks.size == 0 || blocks.size >> 40 != 0 || partial > blocks.size))
    fail(array,
         fmt::format("wrong size of compressed blocks ({}, the last {})", blocks.size, partial),
         subject);
  blocks.last = partial == 0 ? blocks.size : partial;
  header.require((3 + count) * word);
  const Bytes sizes = header.read(3 * word, count * word);
  std::size_t sum = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const std::uint64_t size = word_of(&sizes[b * word], word, storage.big_endian);
    const std::size_t expanded = b + 1 < count ? blocks.size : blocks.last;
    if (size > array.data.size() || expanded > largest_expansion(storage.compressor) * size + 4096)
      fail(array,
           fmt::format("wrong size of compressed block {} ({} bytes for {})", b, size, expanded),
           subject);
    blocks.compressed.push_back(size);
    sum += size;
  }
  blocks.data_at = header.length((3 + count) * word);
  if (sum > 0) ByteRun(array, blocks.data_at, subject).require(sum);
  return blocks;
}

vtkSmartPointer<vtkDataCompressor> new_compressor(Compressor compressor) {
  switch (compressor) {
    case Compressor::lz4:
      return vtkSmartPointer<vtkLZ4DataCompressor>::New();
    case Compressor::lzma:
      return vtkSmartPointer<vtkLZMADataCompressor>::New();
    case Compressor::zlib:
    case Compressor::none:
      break;
  }
  return vtkSmartPointer<vtkZLibDataCompressor>::New();
}

/// The uncompressed bytes [first, first + count).
Bytes read_compressed(const XmlArray& array, const XmlStorage& storage, std::size_t first,
                      std::size_t count, const std::string& subject) {
  const Blocks blocks = read_blocks(array, storage, subject);
  const ByteRun data(array, blocks.data_at, subject);
  const auto compressor = new_compressor(storage.compressor);
  Bytes result;
  std::size_t at = 0;
  for (std::size_t b = 0; b < blocks.compressed.size() && b * blocks.size < first + count; ++b) {
    const std::size_t begin = b * blocks.size;
    const std::size_t expanded = b + 1 < blocks.compressed.size() ? blocks.size : blocks.last;
    if (begin + expanded > first) {
      const Bytes packed = data.read(at, blocks.compressed[b]);
      Bytes block(expanded);
      if (packed.empty() ||
          compressor->Uncompress(packed.data(), packed.size(), block.data(), expanded) != expanded)
        fail(array, fmt::format("compressed block {} is damaged", b), subject);
      const std::size_t from = std::max(first, begin) - begin;
      const std::size_t to = std::min(first + count - begin, expanded);
      result.insert(result.end(), block.begin() + static_cast<long>(from),
                    block.begin() + static_cast<long>(to));
    }
    at += blocks.compressed[b];
  }
  return result;
}

/// The bytes [first, first + count) of a checked array's binary data.
Bytes read_binary(const XmlArray& array, std::size_t first, std::size_t count,
                  const XmlStorage& storage, const std::string& subject) {
  return storage.compressor == Compressor::none
             ? ByteRun(array, 0, subject).read(storage.header_bytes + first, count)
             : read_compressed(array, storage, first, count, subject);
}

void check_ascii(XmlArray& array, std::size_t values, bool may_be_not_finite,
                 const std::string& subject) {
  LegacyWords words(array.data, {});
  const NumberType type = array.type.family == NumberType::Family::text
                              ? NumberType{NumberType::Family::unsigned_integer, 1}
                              : array.type;
  std::size_t count = 0;
  double value = 0;
  for (std::string_view word = words.word(); !word.empty(); word = words.word(), ++count) {
    const AsciiNumber verdict = judge_ascii_number(word, type, value);
    if (verdict == AsciiNumber::fine) continue;
    if (verdict == AsciiNumber::not_finite && may_be_not_finite && count < values) {
      array.has_not_finite = true;
      continue;
    }
    fail(array,
         fmt::format("wrong value {} (a number of its type expected, '{}' found)", count,
                     word.substr(0, 40)),
         subject);
  }
  if (count < values) fail_short(array, values, count, "values", subject);
}

}  // namespace

void check_xml_array(XmlArray& array, std::size_t values, const XmlStorage& storage,
                     bool may_be_not_finite, const std::string& subject) {
  if (array.encoding == Encoding::ascii)
    return check_ascii(array, values, may_be_not_finite, subject);
  const std::size_t width = array.type.family == NumberType::Family::text ? 1 : array.type.bytes;
  if (values > std::numeric_limits<std::size_t>::max() / 16)
    fail(array, "too many values", subject);
  const std::size_t expected = values * width;
  if (expected == 0) return;
  if (storage.compressor != Compressor::none) {
    const std::size_t total = read_blocks(array, storage, subject).total();
    if (total < expected) fail_short(array, expected, total, "bytes", subject);
    return;
  }
  const ByteRun run(array, 0, subject);
  run.require(storage.header_bytes);
  const Bytes header = run.read(0, storage.header_bytes);
  const std::uint64_t total = word_of(header.data(), header.size(), storage.big_endian);
  if (total < expected) fail_short(array, expected, total, "bytes", subject);
  if (total > array.data.size()) fail_short(array, total, array.data.size(), "bytes", subject);
  run.require(storage.header_bytes + total);
}

std::vector<std::int64_t> read_xml_integers(const XmlArray& array, std::size_t first,
                                            std::size_t count, const XmlStorage& storage,
                                            const std::string& subject) {
  std::vector<std::int64_t> result;
  if (array.encoding == Encoding::ascii) {
    IntegerStream stream(array.data, 0, array.type, false);
    for (std::size_t i = 0; i < first; ++i) stream.next();
    for (std::size_t i = 0; i < count; ++i) result.push_back(stream.next());
    return result;
  }
  const std::size_t width = array.type.bytes;
  const Bytes bytes = read_binary(array, first * width, count * width, storage, subject);
  const std::size_t unused = 64 - 8 * width;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t word = word_of(&bytes[i * width], width, storage.big_endian);
    result.push_back(array.type.family == NumberType::Family::unsigned_integer
                         ? static_cast<std::int64_t>(word)
                         : static_cast<std::int64_t>(word << unused) >> unused);
  }
  return result;
}

std::vector<double> read_xml_reals(const XmlArray& array, std::size_t count,
                                   const XmlStorage& storage, const std::string& subject) {
  std::vector<double> result;
  if (array.type.family != NumberType::Family::real) {
    for (const std::int64_t whole : read_xml_integers(array, 0, count, storage, subject))
      result.push_back(static_cast<double>(whole));
    return result;
  }
  result.reserve(count);
  if (array.encoding == Encoding::ascii) {
    LegacyWords words(array.data, {});
    while (result.size() < count) {
      double value = 0;
      judge_ascii_number(words.word(), array.type, value);
      result.push_back(value);
    }
    return result;
  }
  const std::size_t width = array.type.bytes;
  const Bytes bytes = read_binary(array, 0, count * width, storage, subject);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t word = word_of(&bytes[i * width], width, storage.big_endian);
    result.push_back(width == sizeof(float) ? static_cast<double>(std::bit_cast<float>(
                                                  static_cast<std::uint32_t>(word)))
                                            : std::bit_cast<double>(word));
  }
  return result;
}

}  // namespace hiac::formats::vtk

#include "formats/plot3d/sections.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "formats/common/io/mapped_file.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::plot3d {
namespace {

constexpr std::size_t kMostBlocks = 1'000'000;
constexpr std::size_t kMostVariables = 1000;
/// Old systems pad the last block of a file with zeros.
constexpr std::size_t kFileBlock = 512;

/// The next word of a text, between blanks and commas; empty at the end. Removes it from the text.
std::string_view next_word(std::string_view& text) {
  const auto blank = [](char c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); };
  const auto* const word = std::find_if_not(text.begin(), text.end(), blank);
  const auto* const end = std::find_if(word, text.end(), blank);
  text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  return {word, end};
}

/// A number that a text repeats.
struct Repeated {
  std::size_t times;
  double number;
};

/// The numbers of a word: Fortran writes "3*1.5" for three equal numbers, and a D for the exponent.
/// Nothing when the word is not a number.
std::optional<Repeated> numbers_of(std::string_view word) {
  Repeated result{1, 0};
  if (const std::size_t star = word.find('*'); star != std::string_view::npos) {
    const auto [next, error] = std::from_chars(word.data(), word.data() + star, result.times);
    if (error != std::errc() || next != word.data() + star) return std::nullopt;
    word.remove_prefix(star + 1);
  }
  word = without_plus(word);
  std::array<char, 64> buffer{};
  if (word.size() >= buffer.size() || word.empty()) return std::nullopt;
  std::transform(word.begin(), word.end(), buffer.begin(),
                 [](char c) { return c == 'D' || c == 'd' ? 'e' : c; });
  const char* last = buffer.data() + word.size();
  const auto [next, error] = std::from_chars(buffer.data(), last, result.number);
  if (error != std::errc() || next != last) return std::nullopt;
  return result;
}

/// How a file's numbers are stored.
struct Encoding {
  bool text = false;
  bool swap = false;      ///< the other byte order than this machine's
  std::size_t real = 4;   ///< bytes of a real number; 1 in a text, where words are counted
  std::size_t whole = 4;  ///< bytes of a whole number; 1 in a text
};

/// A file's contents without record marks: the bytes or, for a text, its numbers.
class Contents {
 public:
  Contents(const std::string& path, bool swap, bool marks, bool text)
      : path_(path), file_(path), swap_(swap), text_(text) {
    if (text)
      fits_ = read_words();
    else if (marks)
      fits_ = strip_marks();
    else
      bytes_ = file_.text();
  }

  /// Whether the file can be read in this encoding at all.
  [[nodiscard]] bool fits() const { return fits_; }
  /// In bytes; for a text, in words.
  [[nodiscard]] std::size_t size() const { return text_ ? words_.size() : bytes_.size(); }
  [[nodiscard]] std::size_t records() const { return records_; }

  /// Whether the contents end there, apart from zeros up to the end of a block.
  [[nodiscard]] bool end_at(std::size_t expected) const {
    if (expected == size()) return true;
    if (text_ || records_ > 0 || expected > size() || size() % kFileBlock != 0 ||
        size() - expected >= kFileBlock)
      return false;
    return bytes_.find_first_not_of('\0', expected) == std::string_view::npos;
  }

  [[nodiscard]] std::int64_t whole(std::size_t at) const {
    if (text_) return std::llround(std::clamp(words_[at], -1e15, 1e15));
    return value<std::int32_t>(at);
  }
  [[nodiscard]] double real(std::size_t at, std::size_t size) const {
    if (text_) return words_[at];
    return size == 4 ? double{value<float>(at)} : value<double>(at);
  }

 private:
  template <typename T>
  [[nodiscard]] T value(std::size_t at) const {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + at, raw.size());
    if (swap_) std::reverse(raw.begin(), raw.end());
    T result;
    std::memcpy(&result, raw.data(), sizeof result);
    return result;
  }

  /// Every record is preceded and followed by its length; the records fill the file.
  bool strip_marks() {
    bytes_ = file_.text();
    const std::string_view all = file_.text();
    std::vector<std::pair<std::size_t, std::size_t>> parts;
    for (std::size_t at = 0; at < all.size();) {
      if (all.size() - at < 8) return false;
      const std::int64_t length = value<std::int32_t>(at);
      if (length < 0 || static_cast<std::size_t>(length) > all.size() - at - 8) return false;
      const auto count = static_cast<std::size_t>(length);
      if (value<std::int32_t>(at + 4 + count) != length) return false;
      parts.emplace_back(at + 4, count);
      at += 8 + count;
    }
    for (const auto& [begin, count] : parts) stripped_.append(all.substr(begin, count));
    records_ = parts.size();
    bytes_ = stripped_;
    return true;
  }

  /// Whether all words are numbers.
  bool read_words() {
    const std::string_view all = file_.text();
    std::string_view rest = all;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
      const auto numbers = numbers_of(word);
      if (!numbers || numbers->times > all.size()) return false;
      // so many words in a file of this size are not a grid
      if (words_.size() + numbers->times > 64 * all.size()) return false;
      words_.insert(words_.end(), numbers->times, numbers->number);
    }
    return true;
  }

  std::string path_;
  MappedFile file_;
  bool swap_;
  bool text_;
  bool fits_ = true;
  std::size_t records_ = 0;
  std::string stripped_;
  std::string_view bytes_;
  std::vector<double> words_;
};

/// The contents of a file's first numbers.
struct Header {
  std::vector<Extents> blocks;
  std::vector<std::size_t> further;  ///< a fourth number of every block, of function files
  std::size_t end = 0;               ///< where the data begin
  std::size_t points = 0;            ///< of all blocks
};

/// Reads the number of blocks, unless it is omitted for a single block, and their extents.
std::optional<Header> header_of(const Contents& contents, bool several, bool function,
                                std::size_t whole) {
  Header header;
  std::size_t count = 1;
  const std::size_t width = function ? 4 : 3;
  if (several) {
    if (contents.size() < whole) return std::nullopt;
    const std::int64_t blocks = contents.whole(0);
    if (blocks < 1 || static_cast<std::size_t>(blocks) > kMostBlocks) return std::nullopt;
    count = static_cast<std::size_t>(blocks);
    header.end = whole;
  }
  if (count > (contents.size() - header.end) / (width * whole)) return std::nullopt;
  for (std::size_t b = 0; b < count; ++b) {
    Extents extents{};
    std::size_t points = 1;
    for (std::size_t d = 0; d < width; ++d, header.end += whole) {
      const std::int64_t number = contents.whole(header.end);
      if (number < 1 || static_cast<std::size_t>(number) > contents.size()) return std::nullopt;
      if (d == 3) {
        header.further.push_back(static_cast<std::size_t>(number));
        continue;
      }
      extents[d] = static_cast<std::size_t>(number);
      if (points > contents.size() / extents[d]) return std::nullopt;
      points *= extents[d];
    }
    header.blocks.push_back(extents);
    header.points += points;
    if (header.points > contents.size()) return std::nullopt;
  }
  return header;
}

/// Whether the text begins with that many numbers.
bool begins_with_numbers(std::string_view text, std::size_t count) {
  for (std::size_t found = 0; found < count;) {
    const auto numbers = numbers_of(next_word(text));
    if (!numbers) return false;
    found += std::min(numbers->times, count);
  }
  return true;
}

std::size_t points_in(const Extents& extents) { return extents[0] * extents[1] * extents[2]; }

/// Tries every encoding of the file; `read(contents, encoding, several)` returns nothing when the
/// file's size does not fit.
template <typename Read>
auto read_fitting(const std::string& path, std::string_view what, const Read& read) {
  for (const bool text : {false, true}) {
    for (const bool marks : {true, false}) {
      for (const bool swap : {false, true}) {
        if (text && (marks || swap)) continue;
        const Contents contents(path, swap, marks, text);
        if (!contents.fits()) continue;
        for (const bool several : {true, false})
          for (const std::size_t real : {4, 8}) {
            if (text && real == 8) continue;
            const Encoding encoding =
                text ? Encoding{true, false, 1, 1} : Encoding{false, swap, real, 4};
            if (auto found = read(contents, encoding, several)) return std::move(*found);
          }
      }
    }
  }
  throw InputError(path, fmt::format("is no whole PLOT3D {} (its size fits no dialect)", what));
}

/// Reads a block's data, plane by plane: `columns` reals per point and, if present, IBLANK.
void read_planes(const Contents& contents, const Encoding& encoding, const Extents& extents,
                 std::size_t columns, bool planes, std::size_t& at, std::vector<double>& values,
                 std::vector<std::int32_t>* iblank) {
  const std::size_t points = points_in(extents);
  const std::size_t slices = planes ? extents[2] : 1;
  const std::size_t slice = points / slices;
  values.resize(columns * points);
  if (iblank != nullptr) iblank->resize(points);
  for (std::size_t s = 0; s < slices; ++s) {
    for (std::size_t c = 0; c < columns; ++c)
      for (std::size_t p = 0; p < slice; ++p, at += encoding.real)
        values[c * points + s * slice + p] = contents.real(at, encoding.real);
    for (std::size_t p = 0; iblank != nullptr && p < slice; ++p, at += encoding.whole)
      (*iblank)[s * slice + p] = static_cast<std::int32_t>(contents.whole(at));
  }
}

/// Whether the number of records implies that every plane is a record.
bool in_planes(const Contents& contents, const Header& header, bool several,
               std::size_t records_a_block) {
  std::size_t planes = several ? 2 : 1;
  std::size_t whole = planes;
  for (const Extents& extents : header.blocks) {
    planes += records_a_block - 1 + extents[2];
    whole += records_a_block;
  }
  return contents.records() == planes && planes != whole;
}

std::optional<Grid> grid_in(const Contents& contents, const Encoding& encoding, bool several) {
  const auto header = header_of(contents, several, false, encoding.whole);
  if (!header) return std::nullopt;
  for (const bool blanked : {false, true}) {
    const std::size_t a_point = 3 * encoding.real + (blanked ? encoding.whole : 0);
    if (!contents.end_at(header->end + header->points * a_point)) continue;
    Grid grid;
    grid.blocks = header->blocks;
    const bool planes = in_planes(contents, *header, several, 1);
    std::size_t at = header->end;
    for (const Extents& extents : grid.blocks) {
      grid.coordinates.emplace_back();
      if (blanked) grid.iblank.emplace_back();
      read_planes(contents, encoding, extents, 3, planes, at, grid.coordinates.back(),
                  blanked ? &grid.iblank.back() : nullptr);
    }
    return grid;
  }
  return std::nullopt;
}

/// OVERFLOW writes the number of variables after the extents; the count of numbers before each
/// block's data follows from the file's size.
std::optional<Solution> overflow_in(const Contents& contents, const Encoding& encoding,
                                    const Header& header) {
  if (contents.size() < header.end + 2 * encoding.whole) return std::nullopt;
  const std::int64_t count = contents.whole(header.end);
  if (count < 5 || count > static_cast<std::int64_t>(kMostVariables)) return std::nullopt;
  const auto variables = static_cast<std::size_t>(count);
  const std::size_t begin = header.end + 2 * encoding.whole;
  const std::size_t data = header.points * variables * encoding.real;
  if (contents.size() < begin || data > contents.size() - begin) return std::nullopt;
  const std::size_t rest = contents.size() - begin - data;
  const std::size_t before = rest / header.blocks.size();
  if (before * header.blocks.size() != rest || before < 13 * encoding.real ||
      before > 64 * encoding.real)
    return std::nullopt;
  Solution solution;
  std::size_t at = begin;
  for (const Extents& extents : header.blocks) {
    at += before;
    solution.variables.push_back(variables);
    solution.values.emplace_back();
    read_planes(contents, encoding, extents, variables, false, at, solution.values.back(), nullptr);
  }
  return solution;
}

std::optional<Solution> q_in(const Contents& contents, const Encoding& encoding, bool several,
                             const std::vector<Extents>& blocks) {
  constexpr std::size_t kVariables = 5;
  constexpr std::size_t kConditions = 4;  // Mach number, angle of attack, Reynolds number, time
  const auto header = header_of(contents, several, false, encoding.whole);
  if (!header || header->blocks != blocks) return std::nullopt;
  const std::size_t expected =
      header->end + (kConditions * blocks.size() + kVariables * header->points) * encoding.real;
  if (!contents.end_at(expected)) return overflow_in(contents, encoding, *header);
  const bool planes = in_planes(contents, *header, several, 2);
  Solution solution;
  std::size_t at = header->end;
  for (const Extents& extents : blocks) {
    at += kConditions * encoding.real;
    solution.variables.push_back(kVariables);
    solution.values.emplace_back();
    read_planes(contents, encoding, extents, kVariables, planes, at, solution.values.back(),
                nullptr);
  }
  return solution;
}

std::optional<Solution> function_in(const Contents& contents, const Encoding& encoding,
                                    bool several, const std::vector<Extents>& blocks) {
  const auto header = header_of(contents, several, true, encoding.whole);
  if (!header || header->blocks != blocks) return std::nullopt;
  std::size_t expected = header->end;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (header->further[b] > kMostVariables) return std::nullopt;
    expected += points_in(blocks[b]) * header->further[b] * encoding.real;
  }
  if (!contents.end_at(expected)) return std::nullopt;
  const bool planes = in_planes(contents, *header, several, 1);
  Solution solution;
  std::size_t at = header->end;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    solution.variables.push_back(header->further[b]);
    solution.values.emplace_back();
    read_planes(contents, encoding, blocks[b], header->further[b], planes, at,
                solution.values.back(), nullptr);
  }
  return solution;
}

}  // namespace

Grid read_grid(const std::string& path) { return read_fitting(path, "grid", grid_in); }

Solution read_q(const std::string& path, const std::vector<Extents>& blocks) {
  return read_fitting(path, "Q file of the grid",
                      [&](const Contents& contents, const Encoding& encoding, bool several) {
                        return q_in(contents, encoding, several, blocks);
                      });
}

Solution read_function(const std::string& path, const std::vector<Extents>& blocks) {
  return read_fitting(path, "function file of the grid",
                      [&](const Contents& contents, const Encoding& encoding, bool several) {
                        return function_in(contents, encoding, several, blocks);
                      });
}

bool may_be_grid(std::string_view head) {
  // a small count in the first four bytes, in either byte order, or the extents in a text
  if (head.size() < 12) return false;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(head[i]); };
  const bool little = byte(3) == 0 && byte(2) == 0 && (byte(0) != 0 || byte(1) != 0);
  const bool big = byte(0) == 0 && byte(1) == 0 && (byte(2) != 0 || byte(3) != 0);
  return little || big || begins_with_numbers(head, 3);
}

}  // namespace hiac::formats::plot3d

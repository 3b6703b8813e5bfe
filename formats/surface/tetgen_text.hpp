#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace hiac::formats {

/// The non-empty lines of one of TetGen's text files: their words, without comments after '#'.
class TetgenLines {
 public:
  /// Throws InputError when the file cannot be opened.
  explicit TetgenLines(const std::string& path);

  /// The words of the next line; throws InputError naming what was expected when the file ends.
  std::span<const std::string> next(const char* expected);
  /// The same; no words at the end of the file.
  std::span<const std::string> next_or_none();

  /// The words of the line last read.
  [[nodiscard]] std::span<const std::string> words() const { return words_; }
  /// A word of the line last read as a number, or InputError with the line.
  [[nodiscard]] double real(std::size_t word, const char* what) const;
  [[nodiscard]] std::uint64_t whole(std::size_t word, const char* what) const;
  /// The same; `otherwise` when the line has no such word.
  [[nodiscard]] std::uint64_t whole_or(std::size_t word, const char* what,
                                       std::uint64_t otherwise) const;
  /// Three numbers from a word on.
  [[nodiscard]] std::array<double, 3> point(std::size_t word, const char* what) const;

  /// Throws InputError naming the line last read.
  [[noreturn]] void fail(const std::string& message) const;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::ifstream file_;
  std::size_t line_ = 0;
  std::vector<std::string> words_;
};

/// TetGen's list of nodes: the number of the first node, positions, and attributes node by node.
struct TetgenNodes {
  std::uint64_t first = 0;
  std::vector<std::array<double, 3>> points;
  std::size_t attribute_count = 0;
  std::vector<double> attributes;
};

/// Reads the list whose first line (count, dimension, attributes, markers) comes next. An empty
/// list is left to the caller. Throws InputError.
TetgenNodes read_tetgen_nodes(TetgenLines& lines);

}  // namespace hiac::formats

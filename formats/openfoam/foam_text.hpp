#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace hiac::formats::openfoam {

/// A place in one of OpenFOAM's files that moves forward, word by word. Comments count as blanks.
/// Errors name the file and the line; in binary files the byte.
class FoamText {
 public:
  /// `text` must outlive this; `path` is the file's name.
  FoamText(std::string_view text, std::string path) : text_(text), path_(std::move(path)) {}

  /// Whether errors name the byte.
  void set_binary(bool binary) { binary_ = binary; }
  [[nodiscard]] bool binary() const { return binary_; }

  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] std::size_t left() const { return text_.size() - at_; }
  void move_to(std::size_t at) { at_ = at; }

  /// The next character that is not blank; the place moves to it. 0 at the end.
  char peek();
  /// Moves past that character. Throws InputError when another comes next.
  void expect(char c);
  /// The next word, or a text in quotes with them; empty at a bracket or a semicolon.
  std::string_view word();
  double real();
  std::int64_t whole();
  /// A count of items that take at least `bytes_each`. Throws InputError when the file is too short
  /// for them.
  std::size_t count(std::size_t bytes_each);
  /// The next bytes, unchanged.
  std::string_view raw(std::size_t bytes);

  /// Skips the dictionary that begins here.
  void skip_dictionary();
  /// Moves past the semicolon of the entry whose keyword has been read, or past its dictionary.
  void skip_entry();
  /// Moves to the end of the line.
  void skip_line();
  /// Moves past one character, which there must be.
  void advance() { ++at_; }
  /// Whether that character comes anywhere from here on.
  [[nodiscard]] bool has_ahead(char c) const {
    return text_.find(c, at_) != std::string_view::npos;
  }

  [[noreturn]] void fail(const std::string& problem) const;

 private:
  void skip_space();

  std::string_view text_;
  std::string path_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

}  // namespace hiac::formats::openfoam

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hiac::tools {

/// A place for a number in a name: %d, %4d, %04d. Numbers have at least `digits` digits, with zeros
/// in front.
struct NumberPlace {
  std::size_t begin, end;  ///< of the whole directive
  std::size_t digits;
};

/// All such places; whatever else begins with % is text.
std::vector<NumberPlace> number_places(const std::string& path);

/// The name with a number in one of its places.
std::string with_number(const std::string& path, const NumberPlace& place, std::size_t number);

/// A name of which one file a number exists: run-%04d.zoo.
class NumberPattern {
 public:
  /// Throws UsageError unless the text has exactly one place for a number and no other %. `option`
  /// begins the message.
  NumberPattern(const std::string& option, std::string text);

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::string path_of(std::size_t number) const {
    return with_number(text_, place_, number);
  }

  /// The numbers of the files that exist, ascending. Throws UsageError if the number is not in the
  /// file's name but in a folder's, and InputError if there is no file.
  [[nodiscard]] std::vector<std::size_t> existing() const;

 private:
  [[nodiscard]] std::optional<std::size_t> number_in(const std::string& path) const;

  std::string option_, text_;
  NumberPlace place_{};
};

}  // namespace hiac::tools

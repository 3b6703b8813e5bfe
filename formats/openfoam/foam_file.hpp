#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/input_text.hpp"

namespace hiac::formats::openfoam {

/// A field's values, and how many components it has.
struct FieldValues {
  std::size_t components = 1;
  std::vector<double> values;
};

/// One file of a case: its header is read, then one thing after the other. Errors name the file and
/// the line (in binary parts the byte).
class FoamFile {
 public:
  /// Opens NAME or NAME.gz. Throws InputError when there is neither.
  explicit FoamFile(const std::string& path);

  [[nodiscard]] const std::string& class_name() const { return class_; }

  /// A list of whole numbers.
  std::vector<std::int64_t> labels();
  /// A list of lists of whole numbers: for every face where it begins in `nodes`, and the end.
  void faces(std::vector<std::size_t>& starts, std::vector<std::int64_t>& nodes);
  /// A list of points.
  std::vector<double> points();
  /// The values of `internalField` for `count` cells or points.
  FieldValues internal_field(std::size_t count);
  /// The exponents of `dimensions` as a unit: "m s^-1"; empty when there are none.
  std::string unit();

  /// Whether there is such a file, packed or not.
  static bool exists(const std::string& path);

 private:
  [[noreturn]] void fail(const std::string& problem) const;
  void skip_space();
  [[nodiscard]] char peek();
  void expect(char c);
  std::string_view word();
  double real();
  std::int64_t whole();
  std::size_t count(std::size_t bytes_each);
  /// Moves behind the keyword at the beginning of an entry; false where there is none.
  bool find_entry(std::string_view keyword);
  void read_header();
  /// `amount` numbers between brackets, each tuple in brackets where `width` is above 1.
  std::vector<double> reals(std::size_t amount, std::size_t width);
  std::string_view raw(std::size_t bytes);

  InputText input_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t body_ = 0;  ///< behind the header
  std::string class_;
  bool binary_ = false;
  std::size_t label_bytes_ = 4;
  std::size_t scalar_bytes_ = 8;
};

}  // namespace hiac::formats::openfoam

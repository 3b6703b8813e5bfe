#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/io/input_text.hpp"
#include "formats/openfoam/foam_text.hpp"

namespace hiac::formats::openfoam {

/// A field's values, and its number of components.
struct FieldValues {
  std::size_t components = 1;
  std::vector<double> values;
};

/// A patch of a mesh's boundary: this many faces from start_face on. A patch between parts of a
/// decomposed case (type "processor") also names the part on the other side.
struct Patch {
  std::string type;
  std::int64_t faces = 0;
  std::int64_t start_face = 0;
  std::int64_t neighbour = -1;
};

/// One file of a case: its header is read first, then one item after the other. Errors name the
/// file and the line (in binary parts the byte).
class FoamFile {
 public:
  /// Opens NAME or NAME.gz. Throws InputError when neither exists.
  explicit FoamFile(const std::string& path);

  [[nodiscard]] const std::string& class_name() const { return class_; }

  /// A list of whole numbers. A list of equal numbers stores one of them, and may have at most
  /// `most_equal` entries.
  std::vector<std::int64_t> labels(std::size_t most_equal);
  /// A list of lists of whole numbers: for every face its start in `nodes`, followed by the end.
  void faces(std::vector<std::size_t>& starts, std::vector<std::int64_t>& nodes);
  /// A list of patches.
  std::vector<Patch> patches();
  /// A list of points.
  std::vector<double> points();
  /// The values of `internalField` for `count` cells or points; none when code or a macro that the
  /// file does not define gives them ($pressure of an included file).
  std::optional<FieldValues> internal_field(std::size_t count);
  /// The exponents of `dimensions` as a unit: "m s^-1"; empty when there are none.
  std::string unit();

  /// Adds the note on what follows the list that has been read, comments aside.
  void note_rest(std::vector<std::string>& notes);

  /// Whether that file exists, packed or not.
  static bool exists(const std::string& path);
  /// Whether the file begins like OpenFOAM's files, with comments and "FoamFile".
  static bool is_one(const std::string& path);

 private:
  /// Moves past the keyword at the beginning of an entry; false when there is no such entry.
  bool find_entry(std::string_view keyword);
  void read_header();
  /// The number of entries of a list; none when no number precedes the list.
  std::optional<std::size_t> list_size(std::size_t bytes_each, std::size_t most_equal);
  /// A list of tuples between brackets, or one tuple between braces if all are equal. A tuple has
  /// brackets of its own if `width` is above 1.
  std::vector<double> reals(std::size_t width, std::size_t most_equal);
  void read_tuple(std::size_t width, std::vector<double>& values);
  /// A number or a tuple of numbers; empty for anything else.
  std::vector<double> uniform_value();

  InputText input_;
  FoamText text_;
  std::size_t body_ = 0;  ///< the position after the header
  std::string class_;
  std::size_t label_bytes_ = 4;
  std::size_t scalar_bytes_ = 8;
};

}  // namespace hiac::formats::openfoam

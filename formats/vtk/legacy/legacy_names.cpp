// Based on: vtkDataReader::DecodeString of VTK 9.1.
#include "formats/vtk/legacy/legacy_names.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <vector>

#include <fmt/format.h>

#include "formats/common/io/printable.hpp"
#include "formats/vtk/array_names.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

struct Decoded {
  std::string name;
  bool as_meant = true;  ///< two hexadecimal digits follow every '%'
};

/// Legacy files write a blank in a name as "%20", and likewise other characters.
Decoded decoded(const std::string& name) {
  Decoded result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] != '%') {
      result.name += name[i];
      continue;
    }
    const char* const digits = name.data() + i + 1;
    unsigned value = 0;
    const char* const end =
        std::from_chars(digits, name.data() + std::min(i + 3, name.size()), value, 16).ptr;
    result.as_meant &= end == digits + 2 && value != 0;
    // VTK leaves out a '%' too near to the end, but not in names of one or two characters
    if (name.size() > 2 && i + 2 >= name.size()) continue;
    if (value == 0) break;  // what is no number is 0 for VTK, and ends the name
    result.name += static_cast<char>(value);
    i += 2;
  }
  return result;
}

/// VTK decodes such a name beyond its end, where names before it have left their characters.
bool is_undefined(const std::string& name) {
  return name.size() == 2 && name[0] == '%' &&
         std::isxdigit(static_cast<unsigned char>(name[1])) != 0 && name[1] != '0';
}

}  // namespace

void name_arrays(LegacyLayout& layout, const std::string& subject) {
  for (LegacyArray& array : layout.attributes) {
    if (is_undefined(array.name))
      throw InputError(
          subject,
          fmt::format("the name '{}' of an array ends in the middle of a code", array.name));
    const Decoded name = decoded(array.name);
    array.read_as = name.name;
    if (!name.as_meant)
      layout.notes.push_back(printable(fmt::format(
          "a '%' in the name '{}' begins no code: it is read as '{}'", array.name, name.name)));
  }
  for (const bool on_points : {true, false}) {
    std::vector<LegacyArray*> arrays;
    std::vector<std::string> names;
    for (LegacyArray& array : layout.attributes) {
      if (array.on_points != on_points) continue;
      arrays.push_back(&array);
      names.push_back(array.read_as);
    }
    const std::vector<bool> replaced = replaced_names(names, layout.notes);
    for (std::size_t i = 0; i < arrays.size(); ++i) arrays[i]->replaced = replaced[i];
  }
}

}  // namespace hiac::formats::vtk

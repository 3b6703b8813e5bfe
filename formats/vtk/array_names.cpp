#include "formats/vtk/array_names.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "formats/common/io/printable.hpp"

namespace hiac::formats::vtk {

std::vector<bool> replaced_names(const std::vector<std::string>& names,
                                 std::vector<std::string>& notes) {
  std::vector<bool> replaced(names.size());
  std::set<std::string> later;
  for (std::size_t i = names.size(); i-- > 0;) replaced[i] = !later.insert(names[i]).second;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!replaced[i]) continue;
    std::string note =
        fmt::format("several arrays have the name '{}': the last is read", printable(names[i]));
    if (std::find(notes.begin(), notes.end(), note) == notes.end())
      notes.push_back(std::move(note));
  }
  return replaced;
}

}  // namespace hiac::formats::vtk

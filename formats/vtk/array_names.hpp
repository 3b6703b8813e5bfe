#pragma once

#include <string>
#include <vector>

namespace hiac::formats::vtk {

/// Of several arrays with one name, the last is read. Says of each name whether a later array has
/// it, too, and adds a note for each name that several have, if `notes` does not tell it yet.
std::vector<bool> replaced_names(const std::vector<std::string>& names,
                                 std::vector<std::string>& notes);

}  // namespace hiac::formats::vtk

#pragma once

#include <string>
#include <vector>

namespace hiac::formats::plot3d {

/// The files of one step; a name is empty when there is no such file.
struct StepFiles {
  double time = 0;
  std::string grid;
  std::string q;
  std::string function;
};

/// The steps in the order of their times, and the names of the functions.
struct FileSet {
  std::vector<StepFiles> steps;
  std::vector<std::string> function_names;
};

/// The files that a .p3d index names, or a grid file and its companions with the same stem: "a.xyz"
/// with "a.q" and "a.f", "axyz.bin" with "aq.bin" and "af.bin". Throws InputError naming the index
/// when it is malformed.
FileSet files_of(const std::string& path);

/// Whether the file begins like an index.
bool may_be_index(std::string_view head);

}  // namespace hiac::formats::plot3d

#pragma once

#include <string>
#include <vector>

namespace hiac::formats::plot3d {

/// The files of one step; empty names where there is none.
struct StepFiles {
  double time = 0;
  std::string grid;
  std::string q;
  std::string function;
};

/// What belongs together: the steps in the order of their times, and the functions' names.
struct FileSet {
  std::vector<StepFiles> steps;
  std::vector<std::string> function_names;
};

/// The files that a .p3d index names, or a grid file and what stands beside it under the same name:
/// "a.xyz" with "a.q" and "a.f", "axyz.bin" with "aq.bin" and "af.bin". Throws InputError naming
/// the index where it is malformed.
FileSet files_of(const std::string& path);

/// Whether the file begins as an index does.
bool may_be_index(std::string_view head);

}  // namespace hiac::formats::plot3d

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::ensight {

/// A time set: its steps' times and the numbers that stand for the stars in file names.
struct TimeSet {
  long number = 1;
  std::vector<double> times;
  std::vector<long> file_numbers;

  /// The last step whose time is not above the given one; the first where all are.
  [[nodiscard]] std::size_t step_at(double time) const;
};

/// A variable: its files, one a part of a complex one.
struct Variable {
  std::string name;
  FieldLocation location;
  std::size_t components;
  std::optional<long> time_set;
  std::vector<std::string> files;
};

struct CaseFile {
  bool version_6 = false;  ///< not Gold
  std::string geometry;
  std::optional<long> geometry_time_set;
  std::vector<Variable> variables;
  std::vector<TimeSet> time_sets;
  std::vector<std::string> notes;

  /// The time set with that number; without a number the first one for a file with stars in its
  /// name. Nothing where there is none.
  [[nodiscard]] const TimeSet* time_set(std::optional<long> number, std::string_view file) const;
};

/// Throws InputError naming the file and the line.
CaseFile read_case_file(const std::string& path);

/// The file of a step: stars in the name replaced by the step's number, in the case's folder.
std::string file_of_step(const std::string& case_path, const std::string& name, const TimeSet* set,
                         std::size_t step);

}  // namespace hiac::formats::ensight

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::ensight {

/// A time set: the times of its steps, and the numbers that replace the stars in file names.
struct TimeSet {
  long number = 1;
  std::vector<double> times;
  std::vector<long> file_numbers;

  /// The last step whose time is not later than the given one; the first if all are later.
  [[nodiscard]] std::size_t step_at(double time) const;
};

/// A variable with its files, one for each part of a complex variable.
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

  /// The time set with that number; without a number, the first one if the file's name has stars.
  /// Nothing when there is none.
  [[nodiscard]] const TimeSet* time_set(std::optional<long> number, std::string_view file) const;
};

/// Throws InputError naming the file and the line.
CaseFile read_case_file(const std::string& path);

/// The file of a step, in the case's folder: the step's number replaces the stars in the name.
std::string file_of_step(const std::string& case_path, const std::string& name, const TimeSet* set,
                         std::size_t step);

}  // namespace hiac::formats::ensight

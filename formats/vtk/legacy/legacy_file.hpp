#pragma once

#include <string>
#include <vector>

#include <vtkSmartPointer.h>

class vtkDataSet;

namespace hiac::formats::vtk {

/// A dataset and the notes on how it was read.
struct LegacyDataset {
  vtkSmartPointer<vtkDataSet> dataset;
  std::string title;
  std::vector<std::string> notes;
};

/// Checks a legacy file and reads it with VTK, for a process that may crash (reading_process.hpp).
/// Throws InputError naming the file.
LegacyDataset read_legacy_file(const std::string& path);

}  // namespace hiac::formats::vtk

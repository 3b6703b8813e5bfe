#pragma once

#include <span>
#include <string>
#include <vector>

#include <vtkSmartPointer.h>

#include "formats/common/mesh/format.hpp"

class vtkDataArray;
class vtkDataSet;
class vtkFieldData;

namespace hiac::formats::vtk {

/// The tuples of an array that are taken into a mesh.
struct TupleChoice {
  std::size_t total = 0;  ///< how many the array must have
  bool all = true;
  std::span<const std::uint32_t> chosen;  ///< their numbers, unless all are chosen
};

/// The array's numbers in double precision. An array of doubles of which all tuples are taken
/// shares its storage with the result.
SharedArray<double> values_of(const vtkSmartPointer<vtkDataArray>& array,
                              const TupleChoice& choice);

/// Moves the dataset's point and cell data into `mesh`: an array is released as soon as it is
/// converted. Arrays that are not numeric are left out with a note. Throws InputError(subject, ...)
/// when an array does not fit the points or cells.
void move_fields(vtkDataSet& dataset, const TupleChoice& points, const TupleChoice& cells,
                 const std::string& subject, ZooMesh& mesh, std::vector<std::string>& notes);

/// Adds the dataset's own data to the metadata: its time under "time", texts and short rows of
/// numbers under their names. Longer arrays are left out with a note.
void add_metadata(vtkFieldData& data, ZooMesh& mesh, std::vector<std::string>& notes);

/// The time in the dataset's own data, if there is one.
std::vector<double> times_of(vtkFieldData& data);

/// All point and cell data with their ranges.
std::vector<FieldSummary> summarize_fields(vtkDataSet& dataset);

}  // namespace hiac::formats::vtk

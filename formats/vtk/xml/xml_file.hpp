#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <vtkSmartPointer.h>

#include "formats/common/io/mapped_file.hpp"
#include "formats/common/mesh/format.hpp"
#include "formats/vtk/message_capture.hpp"
#include "formats/vtk/xml/xml_layout.hpp"
#include "formats/vtk/xml/xml_steps.hpp"

class vtkDataSet;
class vtkXMLDataReader;

namespace hiac::formats::vtk {

/// A checked XML file of one dataset and VTK's reader of it, for a process that may crash
/// (reading_process.hpp). Every function throws InputError naming the file.
class XmlFile {
 public:
  /// `type`: "UnstructuredGrid", "StructuredGrid", "ImageData" or "RectilinearGrid". Of the options
  /// only those of time and step are looked at; throws UsageError where there is no such step.
  XmlFile(const std::string& path, const std::string& type, const ReadOptions& options);
  ~XmlFile();

  [[nodiscard]] std::size_t piece_count() const { return layout_.pieces.size(); }
  /// The whole text of the file.
  [[nodiscard]] std::string_view file_text() const { return file_.text(); }
  /// Nothing where the file declares no steps.
  [[nodiscard]] const std::optional<XmlStep>& step() const { return step_; }
  /// What the check of the file found.
  [[nodiscard]] const std::vector<std::string>& notes() const { return layout_.notes; }
  /// VTK's warnings so far.
  [[nodiscard]] std::vector<std::string> warnings() const { return messages_.warnings(); }

  /// The whole dataset; all pieces of an unstructured grid in one. The reader keeps nothing of it.
  vtkSmartPointer<vtkDataSet> read_whole();
  /// One piece of an unstructured grid. The reader keeps nothing of it.
  vtkSmartPointer<vtkDataSet> read_piece(std::size_t index);

 private:
  [[nodiscard]] std::string_view text() const;
  void check_read(vtkDataSet* dataset, std::size_t points, std::size_t cells) const;
  [[nodiscard]] std::size_t place_of(std::string_view part) const;
  MemoryFile& copy();
  void hide_replaced();
  void hide_not_finite();
  void restore_not_finite(const XmlPiece& piece, vtkDataSet& dataset, std::size_t first_point,
                          std::size_t first_cell) const;
  void require_finite() const;
  vtkSmartPointer<vtkDataSet> take_output();

  MessageCapture messages_;  // first: checking the layout decompresses with VTK
  std::string path_;
  MappedFile file_;
  std::optional<XmlStep> step_;
  XmlLayout layout_;
  vtkSmartPointer<vtkXMLDataReader> reader_;
  std::unique_ptr<MemoryFile> copy_;
};

}  // namespace hiac::formats::vtk

#include <vtkDataSet.h>

#include "formats/common/mesh/gate.hpp"
#include "formats/vtk/from_vtk.hpp"
#include "formats/vtk/legacy/legacy_file.hpp"
#include "formats/vtk/packed_dataset.hpp"
#include "formats/vtk/reading_process.hpp"
#include "formats/vtk/vtk_formats.hpp"
#include "hiac/base/process/isolated_process.hpp"

namespace hiac::formats {
namespace {

/// What VTK reads in another process.
vtk::LegacyDataset read_legacy(const std::string& path) {
  const auto process = vtk::reading_process();
  PackedAnswer answer = process->answer(path, vtk::legacy_request());
  PackReader in(answer.bytes(), path);
  vtk::LegacyDataset legacy;
  legacy.dataset = vtk::unpack_dataset(in, answer);
  if (legacy.dataset == nullptr) in.fail();
  legacy.title = in.text();
  legacy.notes = vtk::unpack_texts(in);
  return legacy;
}

Reading read_legacy_mesh(const std::string& path, const ReadOptions& options) {
  vtk::LegacyDataset legacy = read_legacy(path);
  Reading reading = vtk::mesh_from_vtk(legacy.dataset, options, path);
  if (!legacy.title.empty() && legacy.title != "vtk output")
    reading.mesh.metadata.emplace_back("title", legacy.title);
  finish_reading(reading, path);
  reading.notes.insert(reading.notes.begin(), legacy.notes.begin(), legacy.notes.end());
  return reading;
}

Inventory inspect_legacy(const std::string& path) {
  vtk::LegacyDataset legacy = read_legacy(path);
  Inventory inventory = vtk::inventory_from_vtk(*legacy.dataset, path);
  inventory.format = "vtk";
  inventory.notes = std::move(legacy.notes);
  return inventory;
}

}  // namespace

Format vtk_legacy_format() {
  Format format;
  format.name = "vtk";
  format.extensions = {".vtk"};
  format.kinds = "tet4-20 pyr5,13 prism6,15 wedge7 brick8,20";
  format.fields = "node, cell";
  format.time_steps = "one";
  format.recognizes = [](std::string_view head) {
    return head.starts_with("# vtk DataFile Version");
  };
  format.read = read_legacy_mesh;
  format.inspect = inspect_legacy;
  return format;
}

}  // namespace hiac::formats

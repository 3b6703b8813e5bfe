#include "formats/vtkhdf/vtkhdf.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "formats/common/io/isolated.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/common/mesh/steps.hpp"
#include "formats/common/mesh/structured.hpp"
#include "formats/common/pieces/merge_pieces.hpp"
#include "formats/common/pieces/piece_field.hpp"
#include "formats/hdf5/hdf5_file.hpp"
#include "formats/hdf5/hdf5_model.hpp"
#include "formats/vtk/cell_types.hpp"
#include "formats/vtkhdf/vtkhdf_writer.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

using hdf5::File;
using hdf5::Slab;

const std::string kRoot = "/VTKHDF";
const std::string kSteps = "/VTKHDF/Steps";
const std::string kGhosts = "vtkGhostType";

/// A range of entries in a dataset: its first entry and its length.
struct Run {
  std::uint64_t begin = 0;
  std::uint64_t count = 0;
};

/// The rows of a dataset in `run`, with all further dimensions complete.
Slab rows(const File& file, const std::string& dataset, const Run& run) {
  Slab slab;
  slab.count = file.info(dataset).shape;
  if (slab.count.empty()) file.fail(dataset, "is a single value (an array expected)");
  slab.begin.assign(slab.count.size(), 0);
  slab.begin[0] = run.begin;
  slab.count[0] = run.count;
  return slab;
}

class HdfReader {
 public:
  HdfReader(const std::string& path, const ReadOptions& options)
      : file_(std::make_shared<File>(path)), options_(options) {
    type_ = file_->text_attribute(kRoot, "Type").value_or(type_by_contents());
    if (file_->is_group(kSteps)) times_ = file_->reals(kSteps + "/Values");
    if (const auto step = requested_step(options_, times_, path))
      step_ = *step;
    else if (!times_.empty())
      step_ = times_.size() - 1;
  }

  /// Reads the times and the parts of the step, without their cells.
  ForeignMesh outline() {
    ForeignMesh mesh;
    mesh.times = times_;
    const std::size_t count = type_ == "UnstructuredGrid" ? part_count() : 1;
    for (std::size_t part = 0; part < count; ++part)
      mesh.blocks.push_back({fmt::format("part {}", part), {}});
    return mesh;
  }

  ForeignMesh part(std::size_t number) {
    mesh_.times = times_;
    if (type_ == "UnstructuredGrid")
      read_grid(number);
    else if (type_ == "ImageData")
      read_image();
    else
      file_->fail(kRoot,
                  fmt::format("is of type '{}' (UnstructuredGrid or ImageData expected)", type_));
    return std::move(mesh_);
  }

 private:
  /// The type of a file that does not state it, such as early files of version 1.0.
  [[nodiscard]] std::string type_by_contents() const {
    const bool grid = file_->has(kRoot + "/Connectivity") && file_->has(kRoot + "/Types");
    return grid ? "UnstructuredGrid" : "";
  }

  /// The step's entry in one of the lists of offsets; 0 when there is no such list.
  [[nodiscard]] std::uint64_t at_step(const std::string& list) const {
    const std::string dataset = kSteps + "/" + list;
    if (times_.empty() || !file_->has(dataset)) return 0;
    const std::vector<std::int64_t> offsets = file_->integers(dataset);
    // some lists have a column per topology
    const std::size_t width = std::max<std::size_t>(offsets.size() / times_.size(), 1);
    if (offsets.size() < times_.size() || offsets[step_ * width] < 0)
      file_->fail(dataset, "has no offset of every step");
    return static_cast<std::uint64_t>(offsets[step_ * width]);
  }

  [[nodiscard]] std::size_t part_count() const {
    const std::size_t all = file_->info(kRoot + "/NumberOfPoints").size();
    const std::size_t first = at_step("PartOffsets");
    std::size_t count = all;
    if (!times_.empty())
      count = file_->has(kSteps + "/NumberOfParts") ? at_step("NumberOfParts") : 1;
    if (first > all || count > all - first)
      file_->fail(kSteps, fmt::format("names part {} of {}", first + count, all));
    return count;
  }

  /// The range of the chosen part at this step, from the part's counts and the step's offset.
  [[nodiscard]] Run run_of(const std::string& counts, const std::string& step_offsets,
                           std::size_t part, std::uint64_t extra) const {
    const std::vector<std::int64_t> numbers = file_->integers(kRoot + "/" + counts);
    const std::size_t first = times_.empty() ? 0 : at_step("PartOffsets");
    if (first + part >= numbers.size()) file_->fail(kRoot + "/" + counts, "has too few parts");
    Run run{at_step(step_offsets), 0};
    for (std::size_t p = 0; p <= part; ++p) {
      const std::int64_t number = numbers[first + p];
      if (number < 0 || number > std::int64_t{1} << 40)
        file_->fail(kRoot + "/" + counts, fmt::format("{} expected to be a count", number));
      run.count = static_cast<std::uint64_t>(number);
      if (p < part) run.begin += run.count + extra;
    }
    return run;
  }

  void read_grid(std::size_t part) {
    const Run points = run_of("NumberOfPoints", "PointOffsets", part, 0);
    const Run cells = run_of("NumberOfCells", "CellOffsets", part, 0);
    const Run entries = run_of("NumberOfConnectivityIds", "ConnectivityIdOffsets", part, 0);
    Run ends = run_of("NumberOfCells", "CellOffsets", part, 1);
    ends.begin += times_.empty() ? 0 : at_step("PartOffsets");
    ++ends.count;
    mesh_.xyz = file_->reals(kRoot + "/Points", rows(*file_, kRoot + "/Points", points));
    if (mesh_.xyz.size() != 3 * points.count)
      file_->fail(kRoot + "/Points", "does not have three coordinates a point");
    const auto integers = [&](const std::string& name, const Run& run) {
      return file_->integers(kRoot + "/" + name, rows(*file_, kRoot + "/" + name, run));
    };
    add_cells(integers("Types", cells), integers("Offsets", ends),
              integers("Connectivity", entries), ghosts_of(cells));
    read_fields("PointData", FieldLocation::node, points, {});
    read_fields("CellData", FieldLocation::cell, cells, {});
  }

  [[nodiscard]] std::vector<std::int64_t> ghosts_of(const Run& cells) const {
    const std::string dataset = kRoot + "/CellData/" + kGhosts;
    if (!file_->has(dataset)) return {};
    return file_->integers(dataset, rows(*file_, dataset, field_run("CellData", kGhosts, cells)));
  }

  void add_cells(const std::vector<std::int64_t>& types, const std::vector<std::int64_t>& offsets,
                 std::vector<std::int64_t> nodes, const std::vector<std::int64_t>& ghosts) {
    for (std::size_t i = 0; i < types.size(); ++i) {
      if (offsets[i + 1] < offsets[i] ||
          offsets[i + 1] - offsets[0] > static_cast<std::int64_t>(nodes.size()))
        file_->fail(kRoot + "/Offsets", fmt::format("of cell {} does not fit (between {} and {} "
                                                    "expected, {} found)",
                                                    i, offsets[i], nodes.size(), offsets[i + 1]));
      const auto count = static_cast<std::size_t>(offsets[i + 1] - offsets[i]);
      const auto type = static_cast<int>(types[i]);
      const bool ghost = !ghosts.empty() && ghosts[i] != 0;
      mesh_.cell_types.push_back(ghost ? mesh_.type_place("ghost", count, kNoVolume)
                                       : mesh_.type_place(vtk::cell_type_name(type), count,
                                                          vtk::conversion_of(type, count)));
    }
    if (!types.empty()) nodes.resize(static_cast<std::size_t>(offsets.back() - offsets.front()));
    mesh_.cell_nodes = std::move(nodes);
  }

  /// The rows of a field: from the field's own offset if it has one, otherwise where its mesh
  /// begins.
  [[nodiscard]] Run field_run(const std::string& group, const std::string& name,
                              const Run& mesh) const {
    const std::string own = group + "Offsets/" + name;
    if (times_.empty() || !file_->has(kSteps + "/" + own)) return mesh;
    const std::string list = group == "PointData" ? "PointOffsets" : "CellOffsets";
    return {at_step(own) + (mesh.begin - at_step(list)), mesh.count};
  }

  /// `extents`: for an image, the points or cells along z, y, x.
  void read_fields(const std::string& group, FieldLocation location, const Run& run,
                   const std::vector<std::uint64_t>& extents) {
    if (!file_->is_group(kRoot + "/" + group)) return;
    for (const std::string& name : file_->children(kRoot + "/" + group)) {
      if (name == kGhosts) continue;
      const std::string dataset = kRoot + "/" + group + "/" + name;
      const hdf5::DatasetInfo info = file_->info(dataset);
      if (info.type == "text" || info.type == "other" || info.shape.empty()) {
        mesh_.notes.push_back(fmt::format("field '{}' holds no numbers: left out", name));
        continue;
      }
      const Slab slab = extents.empty() ? rows(*file_, dataset, field_run(group, name, run))
                                        : image_slab(dataset, info.shape, extents);
      const std::uint64_t size = std::accumulate(slab.count.begin(), slab.count.end(),
                                                 std::uint64_t{1}, std::multiplies<>());
      ForeignField field;
      field.name = name;
      field.location = location;
      field.type = info.type;
      field.components =
          run.count == 0 ? 1
                         : static_cast<std::uint32_t>(std::max<std::uint64_t>(size / run.count, 1));
      if (!times_.empty()) field.step = step_;
      field.values = [file = file_, dataset, slab] { return file->reals(dataset, slab); };
      mesh_.fields.push_back(std::move(field));
    }
  }

  [[nodiscard]] Slab image_slab(const std::string& dataset, const std::vector<std::uint64_t>& shape,
                                const std::vector<std::uint64_t>& extents) const {
    const std::size_t leading = times_.empty() ? 0 : 1;
    if (shape.size() < leading + 3 || shape.size() > leading + 4 ||
        !std::equal(extents.begin(), extents.end(), shape.begin() + static_cast<long>(leading)))
      file_->fail(dataset, fmt::format("does not fit the image ({} x {} x {} values expected)",
                                       extents[2], extents[1], extents[0]));
    Slab slab{std::vector<std::uint64_t>(shape.size(), 0), shape};
    if (leading == 1) {
      slab.begin[0] = step_;
      slab.count[0] = 1;
    }
    return slab;
  }

  void read_image() {
    const std::vector<double> extent = file_->real_attribute(kRoot, "WholeExtent");
    const std::vector<double> origin = file_->real_attribute(kRoot, "Origin");
    const std::vector<double> spacing = file_->real_attribute(kRoot, "Spacing");
    std::vector<double> direction = file_->real_attribute(kRoot, "Direction");
    if (direction.empty()) direction = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (extent.size() != 6 || origin.size() != 3 || spacing.size() != 3 || direction.size() != 9)
      file_->fail(kRoot, "lacks the WholeExtent, Origin or Spacing of its image");
    std::array<std::int64_t, 3> counts{};
    for (std::size_t d = 0; d < 3; ++d)
      counts[d] =
          static_cast<std::int64_t>(std::clamp(extent[2 * d + 1] - extent[2 * d] + 1, 0.0, 1e9));
    const StructuredBlock block = structured_block(counts, std::size_t{1} << 31, file_->path());
    if (!has_image_field(block)) file_->fail(kRoot, "has no field over its image");
    mesh_.xyz.reserve(3 * block.point_count());
    for (std::size_t k = 0; k < block.points[2]; ++k)
      for (std::size_t j = 0; j < block.points[1]; ++j)
        for (std::size_t i = 0; i < block.points[0]; ++i) {
          const std::array<double, 3> at{(extent[0] + static_cast<double>(i)) * spacing[0],
                                         (extent[2] + static_cast<double>(j)) * spacing[1],
                                         (extent[4] + static_cast<double>(k)) * spacing[2]};
          for (std::size_t r = 0; r < 3; ++r)
            mesh_.xyz.push_back(origin[r] + direction[3 * r] * at[0] +
                                direction[3 * r + 1] * at[1] + direction[3 * r + 2] * at[2]);
        }
    add_bricks(mesh_, block, 0, {}, "");
    const auto& n = block.points;
    read_fields("PointData", FieldLocation::node, {0, block.point_count()}, {n[2], n[1], n[0]});
    if (block.cell_count() > 0)
      read_fields("CellData", FieldLocation::cell, {0, block.cell_count()},
                  {n[2] - 1, n[1] - 1, n[0] - 1});
  }

  /// A few numbers can declare an image of any size: its fields prove that it exists.
  [[nodiscard]] bool has_image_field(const StructuredBlock& block) const {
    for (const std::string group : {"PointData", "CellData"}) {
      if (!file_->is_group(kRoot + "/" + group)) continue;
      for (const std::string& name : file_->children(kRoot + "/" + group))
        if (file_->info(kRoot + "/" + group + "/" + name).size() >= block.cell_count()) return true;
    }
    return false;
  }

  std::shared_ptr<File> file_;
  ReadOptions options_;
  std::string type_;
  std::vector<double> times_;
  std::size_t step_ = 0;
  ForeignMesh mesh_;
};

ForeignMesh foreign_part(const std::string& path, const ReadOptions& options, std::size_t part) {
  return read_isolated(path, "the HDF5 library", [&](const std::string& file) {
    return HdfReader(file, options).part(part);
  });
}

ForeignMesh outline(const std::string& path, const ReadOptions& options) {
  return read_isolated(path, "the HDF5 library",
                       [&](const std::string& file) { return HdfReader(file, options).outline(); });
}

Reading read_vtkhdf(const std::string& path, const ReadOptions& options) {
  const std::size_t parts = outline(path, options).blocks.size();
  std::vector<Reading> pieces;
  for (std::size_t part = 0; part < parts; ++part) {
    pieces.push_back(assemble(foreign_part(path, options, part), options, path));
    if (PieceMarking::is_on() && parts > 1) mark_piece(pieces.back().mesh, part);
  }
  if (pieces.empty()) throw InputError(path, "holds no cells");
  return merge_pieces(std::move(pieces), path);
}

Inventory inspect_vtkhdf(const std::string& path) {
  const std::size_t parts = outline(path, {}).blocks.size();
  Inventory all;
  for (std::size_t part = 0; part < parts; ++part) {
    const Inventory piece = inventory_of(foreign_part(path, {}, part), "vtkhdf", path);
    if (part == 0)
      all = piece;
    else
      add_piece(all, piece);
  }
  return all;
}

}  // namespace

Format vtkhdf_format() {
  Format format;
  format.name = "vtkhdf";
  format.extensions = {".vtkhdf", ".hdf"};
  format.kinds = "tet4-20 pyr5,13 prism6,15 wedge7 brick8,20";
  format.fields = "node, cell";
  format.time_steps = "several";
  format.recognizes = [](std::string_view) { return false; };
  format.contains = [](const std::string& path) { return hdf5::model_of(path) == "vtkhdf"; };
  format.read = read_vtkhdf;
  format.inspect = inspect_vtkhdf;
  format.write = write_vtkhdf;
  return format;
}

}  // namespace hiac::formats

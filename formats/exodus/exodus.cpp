#include "formats/exodus/exodus.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>

#include <fmt/format.h>

#include "formats/common/io/bytes_behind.hpp"
#include "formats/common/io/isolated.hpp"
#include "formats/common/io/one_line_errors.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/common/mesh/gate.hpp"
#include "formats/common/pieces/complete_fields.hpp"
#include "formats/common/pieces/merge_pieces.hpp"
#include "formats/common/pieces/piece_field.hpp"
#include "formats/exodus/classic_layout.hpp"
#include "formats/exodus/element_types.hpp"
#include "formats/exodus/netcdf_file.hpp"
#include "formats/exodus/run_pieces.hpp"
#include "formats/hdf5/external_files.hpp"
#include "formats/hdf5/hdf5_model.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/special_values.hpp"

namespace hiac::formats {
namespace {

using exodus::NetcdfFile;

/// An element block's cells.
struct Block {
  std::size_t number;  ///< from 1, as in the names of its variables
  std::size_t cells;
};

/// The field with the nodes' numbers in the whole mesh, of the pieces of a run.
constexpr std::string_view kNodeNumbers = "node_num_map";

using Lists = std::vector<std::vector<std::int64_t>>;

class ExodusReader {
 public:
  explicit ExodusReader(const std::string& path) : file_(std::make_shared<NetcdfFile>(path)) {
    if (!file_->has("connect1") && file_->dimension("num_nodes") == 0 &&
        file_->dimension("num_dim") == 0)
      throw InputError(path, "is a netCDF file without a mesh of the Exodus II model");
  }

  /// `of_run`: a piece of a parallel run, with the numbers that its nodes have in the whole mesh.
  ForeignMesh read(bool of_run) {
    read_coordinates();
    read_blocks();
    if (file_->has("time_whole")) mesh_.times = file_->reals("time_whole");
    add_node_fields();
    add_cell_fields();
    if (const auto title = file_->text_attribute("", "title"); title && !title->empty())
      mesh_.metadata.emplace_back("title", *title);
    if (of_run) add_node_numbers();
    note_left_out();
    note_bytes_behind(file_->bytes_behind(), "the netCDF file's data", mesh_.notes);
    return std::move(mesh_);
  }

 private:
  void read_coordinates() {
    points_ = file_->dimension("num_nodes");
    const std::size_t dimensions = file_->dimension("num_dim");
    if (dimensions > 3) file_->fail("num_dim", fmt::format("is {} (1 to 3 expected)", dimensions));
    constexpr std::array<const char*, 3> kNames{"coordx", "coordy", "coordz"};
    std::array<std::vector<double>, 3> axes;
    const bool together = points_ > 0 && file_->has("coord");
    for (std::size_t d = 0; d < dimensions && points_ > 0; ++d) {
      axes[d] = together ? file_->reals("coord", {d, 0}, {1, points_}) : file_->reals(kNames[d]);
      if (axes[d].size() != points_)
        file_->fail(kNames[d],
                    fmt::format("holds {} coordinates ({} expected)", axes[d].size(), points_));
    }
    mesh_.xyz.assign(3 * points_, 0);
    for (std::size_t d = 0; d < dimensions; ++d)
      for (std::size_t i = 0; i < points_; ++i) mesh_.xyz[3 * i + d] = axes[d][i];
    mesh_.first_node = 1;
  }

  void read_blocks() {
    const std::size_t count = file_->dimension("num_el_blk");
    const std::vector<std::string> names = file_->texts("eb_names");
    std::vector<std::int64_t> ids;
    if (file_->has("eb_prop1")) ids = file_->integers("eb_prop1");
    for (std::size_t b = 1; b <= count; ++b) {
      const std::size_t first = mesh_.cell_count();
      read_block(b);
      std::string name = b <= names.size() ? names[b - 1] : "";
      if (name.empty()) name = fmt::format("{}", b <= ids.size() ? ids[b - 1] : std::int64_t(b));
      mesh_.blocks.push_back({std::move(name), {{first, mesh_.cell_count()}}});
    }
  }

  void read_block(std::size_t number) {
    const std::string name = fmt::format("connect{}", number);
    const std::size_t first = mesh_.cell_count();
    if (file_->has(name))
      read_cells(name, number);
    else if (file_->has(fmt::format("facconn{}", number)))
      add_polyhedra(number);
    blocks_.push_back({number, mesh_.cell_count() - first});
  }

  void read_cells(const std::string& name, std::size_t number) {
    const std::vector<std::size_t> shape = file_->shape(name);
    const std::string element = file_->text_attribute(name, "elem_type").value_or("");
    if (shape.size() != 2) return add_polygons(element, number);
    const CellConversion conversion = exodus::conversion_of(element, shape[1]);
    const std::vector<std::int64_t> nodes = file_->integers(name);
    mesh_.cell_types.insert(mesh_.cell_types.end(), shape[0],
                            mesh_.type_place(element, shape[1], conversion));
    mesh_.cell_nodes.insert(mesh_.cell_nodes.end(), nodes.begin(), nodes.end());
  }

  /// "nsided": a separate variable holds the number of corners of each polygon.
  void add_polygons(const std::string& element, std::size_t number) {
    const std::string counts = fmt::format("ebepecnt{}", number);
    const std::size_t count = file_->has(counts) ? file_->integers(counts).size() : 0;
    mesh_.cell_types.insert(mesh_.cell_types.end(), count, mesh_.type_place(element, 0, kNoVolume));
  }

  /// Reads concatenated lists from the variable `name`, with their lengths from the variable
  /// `counts`; if `name` has two dimensions, each of its rows is a list.
  [[nodiscard]] Lists lists_in(const std::string& name, const std::string& counts) const {
    const std::vector<std::int64_t> all = file_->integers(name);
    const std::vector<std::size_t> shape = file_->shape(name);
    std::vector<std::int64_t> lengths;
    if (shape.size() == 2)
      lengths.assign(shape[0], static_cast<std::int64_t>(shape[1]));
    else
      lengths = file_->integers(counts);
    Lists lists;
    std::size_t at = 0;
    for (const std::int64_t length : lengths) {
      if (length < 0 || static_cast<std::uint64_t>(length) > all.size() - at)
        file_->fail(counts, fmt::format("does not fit '{}' ({} numbers)", name, all.size()));
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(at);
      lists.emplace_back(begin, begin + length);
      at += static_cast<std::size_t>(length);
    }
    return lists;
  }

  /// The faces of all face blocks, to which polyhedra refer by places counted from 1.
  void read_faces() {
    if (!faces_.empty()) return;
    for (std::size_t b = 1; b <= file_->dimension("num_fa_blk"); ++b) {
      const std::string name = fmt::format("fbconn{}", b);
      if (!file_->has(name)) continue;
      Lists block = lists_in(name, fmt::format("fbepecnt{}", b));
      faces_.insert(faces_.end(), std::make_move_iterator(block.begin()),
                    std::make_move_iterator(block.end()));
    }
    uses_.assign(faces_.size(), 0);
  }

  void add_polyhedra(std::size_t number) {
    read_faces();
    const std::string name = fmt::format("facconn{}", number);
    for (const auto& list : lists_in(name, fmt::format("ebepecnt{}", number))) {
      Lists own;
      for (const std::int64_t face : list) {
        if (face < 1 || static_cast<std::uint64_t>(face) > faces_.size())
          file_->fail(name, fmt::format("names face {} (1 to {} expected)", face, faces_.size()));
        const auto place = static_cast<std::size_t>(face) - 1;
        // otherwise a small file could demand much memory
        if (++uses_[place] > 2)
          file_->fail(name, fmt::format("names face {} more than twice", face));
        own.push_back(faces_[place]);
      }
      mesh_.add_polyhedron("nfaced (polyhedron)", own);
    }
  }

  [[nodiscard]] std::size_t steps() const { return mesh_.times.size(); }

  /// A variable has one name at all steps, though a file may leave it blank.
  static std::string name_of(const std::vector<std::string>& names, std::size_t variable) {
    return names[variable].empty() ? fmt::format("variable {}", variable + 1) : names[variable];
  }

  void add_node_fields() {
    const std::vector<std::string> names = file_->texts("name_nod_var");
    for (std::size_t v = 0; v < names.size(); ++v) {
      // old files have one array of all variables
      const std::string own = fmt::format("vals_nod_var{}", v + 1);
      const bool together = !file_->has(own) && file_->has("vals_nod_var");
      const std::string variable = together ? "vals_nod_var" : own;
      if (!file_->has(variable)) continue;
      for (std::size_t step = 0; step < steps(); ++step) {
        ForeignField field;
        field.name = name_of(names, v);
        field.step = step;
        field.type = file_->type(variable);
        field.values = [file = file_, variable, together, v, step, points = points_] {
          return together ? file->reals(variable, {step, v, 0}, {1, 1, points})
                          : file->reals(variable, {step, 0}, {1, points});
        };
        mesh_.fields.push_back(std::move(field));
      }
    }
  }

  /// Absent where the file has none.
  void add_node_numbers() {
    if (!file_->has("node_num_map")) return;
    mesh_.fields.push_back(
        field_of(std::string(kNodeNumbers), FieldLocation::node, 1, file_->reals("node_num_map")));
  }

  void add_cell_fields() {
    const std::vector<std::string> names = file_->texts("name_elem_var");
    for (std::size_t v = 0; v < names.size(); ++v) {
      const auto variable = [v](std::size_t block) {
        return fmt::format("vals_elem_var{}eb{}", v + 1, block);
      };
      const auto first = std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& block) {
        return block.cells > 0 && file_->has(variable(block.number));
      });
      if (first == blocks_.end()) continue;
      for (std::size_t step = 0; step < steps(); ++step) {
        ForeignField field;
        field.name = name_of(names, v);
        field.location = FieldLocation::cell;
        field.step = step;
        field.type = file_->type(variable(first->number));
        field.values = [file = file_, variable, step, blocks = blocks_] {
          std::vector<double> values;
          for (const Block& block : blocks) {
            const std::string name = variable(block.number);
            if (block.cells > 0 && file->has(name)) {
              const auto part = file->reals(name, {step, 0}, {1, block.cells});
              values.insert(values.end(), part.begin(), part.end());
            } else {
              values.insert(values.end(), block.cells, kNaN);
            }
          }
          return values;
        };
        mesh_.fields.push_back(std::move(field));
      }
    }
  }

  void note_left_out() {
    const std::size_t edges = file_->dimension("num_ed_blk");
    // the faces of polyhedra are read
    const std::size_t faces = faces_.empty() ? file_->dimension("num_fa_blk") : 0;
    if (edges + faces > 0)
      mesh_.notes.push_back(
          fmt::format("left out {} edge and {} face blocks with their fields", edges, faces));
    if (const std::size_t globals = file_->dimension("num_glo_var"); globals > 0)
      mesh_.notes.push_back(fmt::format("left out {} global variables", globals));
  }

  std::shared_ptr<NetcdfFile> file_;
  ForeignMesh mesh_;
  std::size_t points_ = 0;
  std::vector<Block> blocks_;
  Lists faces_;
  std::vector<std::uint8_t> uses_;  ///< of every face
};

ForeignMesh exodus_mesh(const std::string& path, bool of_run) {
  return read_isolated(path, "the netCDF library", [of_run](const std::string& file) {
    hdf5::require_local_links(file);
    return ExodusReader(file).read(of_run);
  });
}

/// The pieces of a parallel run as one mesh.
Reading read_run(const std::vector<std::string>& files, const ReadOptions& options,
                 const std::string& path) {
  std::vector<Reading> pieces;
  for (const std::string& file : files) {
    pieces.push_back(assemble_piece(exodus_mesh(file, true), options, file));
    if (PieceMarking::is_on()) mark_piece(pieces.back().mesh, pieces.size() - 1);
  }
  complete_fields(pieces, path);  // of blocks that a piece has no cells of
  Reading reading = merge_pieces(std::move(pieces), path, std::string(kNodeNumbers));
  std::erase_if(reading.mesh.fields, [](const Field& field) { return field.name == kNodeNumbers; });
  reading.mesh.metadata.emplace_back("pieces", fmt::format("{}", files.size()));
  reading.notes.insert(reading.notes.begin(),
                       fmt::format("read the {} pieces of a run", files.size()));
  finish_reading(reading, path);
  return reading;
}

Inventory inspect_run(const std::vector<std::string>& files) {
  Inventory all;
  for (const std::string& file : files) {
    Inventory piece = inventory_of(exodus_mesh(file, true), "exodus", file);
    std::erase_if(piece.fields,
                  [](const FieldSummary& field) { return field.name == kNodeNumbers; });
    if (file == files.front())
      all = std::move(piece);
    else
      add_piece(all, piece);
  }
  return all;
}

}  // namespace

Format exodus_format() {
  Format format;
  format.name = "exodus";
  format.extensions = {".e", ".exo", ".ex2", ".exii", ".exo2", ".gen", ".g"};
  format.kinds = "tet4,10 pyr5,13 prism6,15 brick8,20, polyhedra";
  format.fields = "node, cell";
  format.time_steps = "several";
  format.recognizes = [](std::string_view head) { return exodus::is_classic_netcdf(head); };
  // netCDF-4 files are HDF5 files
  format.contains = [](const std::string& path) { return hdf5::model_of(path) == "exodus"; };
  read_through(
      format, [](const std::string& path, const ReadOptions&) { return exodus_mesh(path, false); });
  format.read = [one = format.read](const std::string& path, const ReadOptions& options) {
    const std::vector<std::string> files = exodus::run_pieces(path);
    if (files.size() == 1) return one(path, options);
    return with_errors_of_one_line([&] { return read_run(files, options, path); });
  };
  format.inspect = [one = format.inspect](const std::string& path) {
    const std::vector<std::string> files = exodus::run_pieces(path);
    if (files.size() == 1) return one(path);
    return with_errors_of_one_line([&] { return inspect_run(files); });
  };
  return format;
}

}  // namespace hiac::formats

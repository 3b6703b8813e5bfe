#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "formats/common/cells/lattice.hpp"
#include "formats/common/io/number_index.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Rewrites the cells of a foreign mesh, one after the other: each cell is kept or replaced by
/// other cells, which may use new points that are weighted means of its points. The mesh's fields,
/// blocks and cell numbers are updated accordingly.
class MeshRewrite {
 public:
  /// `mesh` must outlive the rewrite. Throws as NumberIndex does.
  MeshRewrite(ForeignMesh& mesh, std::string subject);

  /// The node numbers of the cells as the mesh has them, until finish().
  [[nodiscard]] std::span<const std::int64_t> nodes_of(std::size_t cell) const;
  /// The place of the point with that number. Throws InputError naming the cell.
  [[nodiscard]] std::size_t place_of(std::int64_t number, std::size_t cell) const;

  /// The number of the point with this mean of points. The same places and `anchor` always give the
  /// same point, so that neighbours share the points on their faces. Two points that are means of
  /// the same points need different anchors.
  std::int64_t point(Weights places, std::size_t anchor);

  /// Keeps the next cell of the mesh as it is.
  void keep();
  /// Replaces the next cell of the mesh by the cells that are added until the next keep or replace.
  void replace();
  /// Adds a cell of that type. `entries`, for fields on corners: for every node, the mean of
  /// entries of the replaced cell that gives its values; empty when there are no such fields.
  void add(std::uint16_t type, std::span<const std::int64_t> nodes,
           std::span<const Weights> entries);

  /// Puts the new cells into the mesh, once all cells have been kept or replaced.
  void finish();

  [[nodiscard]] std::size_t made_points() const { return made_.size(); }

 private:
  void extend_points();
  void rewrite_fields();

  ForeignMesh& mesh_;
  std::string subject_;
  NumberIndex index_;
  std::vector<std::size_t> starts_{0};  ///< of the mesh's cells
  std::size_t next_ = 0;                ///< the cell of the mesh that comes next
  std::vector<std::size_t> firsts_;     ///< for every cell of the mesh its first new cell
  std::vector<std::size_t> parents_;    ///< for every new cell the cell of the mesh
  std::vector<std::uint16_t> types_;
  std::vector<std::int64_t> nodes_;
  ForeignPolyhedra polyhedra_;  ///< the polyhedra that stay
  std::size_t next_polyhedron_ = 0;
  std::vector<std::size_t> entry_ends_;  ///< of every new entry, in entry_weights_
  Weights entry_weights_;
  bool any_corner_field_ = false;
  std::map<std::vector<std::size_t>, std::size_t> known_;
  std::vector<Weights> made_;
  std::int64_t first_made_ = 0;  ///< number of the first made point
};

}  // namespace hiac::formats

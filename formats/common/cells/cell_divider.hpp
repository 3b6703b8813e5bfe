#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/cells/degenerate_cell.hpp"
#include "formats/common/cells/point_values.hpp"
#include "formats/common/cells/polyhedra.hpp"
#include "formats/common/mesh/mesh_rewrite.hpp"

namespace hiac::formats {

/// Rewrites cells that are described by their faces: polyhedra, and cells whose repeated corners
/// make no shape of the zoo. Those with the faces of a kind become that kind; others, with
/// ReadOptions::approximate, are divided into tetrahedra and pyramids between their faces and their
/// centre.
class CellDivider {
 public:
  /// The arguments must outlive the divider. `values`: at the mesh's points, the coordinates first.
  CellDivider(ForeignMesh& mesh, const ReadOptions& options, const std::string& subject,
              MeshRewrite& rewrite, const std::vector<PointValues>& values)
      : mesh_(mesh), options_(options), subject_(subject), rewrite_(rewrite), values_(values) {}

  /// Rewrites or keeps the next cell, which is the polyhedron at that place in the mesh's list.
  void turn_polyhedron(std::size_t cell, std::size_t polyhedron);
  /// Divides the next cell if its repeated corners make no shape of the zoo; false for other cells.
  bool divide_collapsed(std::size_t cell);

  /// Adds the notes on all cells that were rewritten.
  void add_notes();
  /// Why cells were kept.
  [[nodiscard]] const std::vector<std::string>& reasons() const { return reasons_; }

 private:
  void leave_polyhedron(const std::string& reason);
  /// The point at the mean of nodes; cells with the same nodes share it.
  std::int64_t centre_of(std::span<const std::int64_t> numbers, std::size_t cell);
  /// Records the range of values over the nodes that a centre is the mean of.
  void widen(const PointValues& values, const Weights& weights);
  void divide(std::size_t cell, const std::vector<FaceNodes>& faces);
  void note_divided(std::size_t count, std::string_view what);

  ForeignMesh& mesh_;
  const ReadOptions& options_;
  const std::string& subject_;
  MeshRewrite& rewrite_;
  const std::vector<PointValues>& values_;
  std::vector<std::string> reasons_;
  std::size_t recognized_ = 0;
  std::size_t divided_ = 0;
  std::size_t collapsed_ = 0;
  std::size_t flat_ = 0;
  TrueKinds true_kinds_;
  std::map<std::string, double> ranges_;
};

}  // namespace hiac::formats

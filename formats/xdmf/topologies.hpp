#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::xdmf {

/// A topology of one kind of cells. Quadratic cells have VTK's node order.
struct Topology {
  const char* name;
  std::int64_t number;  ///< in mixed topologies; 0: none
  std::size_t nodes;    ///< 0: as many as the file says
  int vtk_type;         ///< the VTK cell with that node order
};

/// The topology with that name, in any case and with any underscores ("Tet_10" is
/// "TETRAHEDRON_10").
std::optional<Topology> topology_named(const std::string& name);

/// Adds the cells of a mixed topology; its node numbers are relative to `first_point`. Throws
/// InputError(subject, ...) when its numbers do not form cells.
void add_mixed_cells(const std::vector<std::int64_t>& numbers, std::int64_t first_point,
                     const std::string& subject, ForeignMesh& mesh);

/// Adds cells of one kind with `nodes` nodes each.
void add_cells(const Topology& topology, std::size_t nodes,
               const std::vector<std::int64_t>& numbers, std::int64_t first_point,
               ForeignMesh& mesh);

}  // namespace hiac::formats::xdmf

#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::ansys {

/// The contents of an archive read so far.
struct CdbModel {
  ForeignMesh mesh;
  std::map<std::int64_t, std::int64_t> routines;  ///< by type number: the 186 of SOLID186
  std::map<std::int64_t, std::int64_t> shapes;    ///< by type number: key option 1
  std::map<std::pair<std::int64_t, std::size_t>, std::uint16_t> places;

  /// The routine of a type; the type's number when it is not defined.
  [[nodiscard]] std::int64_t routine_of(std::int64_t type) const;
  [[nodiscard]] std::int64_t shape_of(std::int64_t type) const;

  /// Adds an element of a type number. `nodes` may hold kLeftOutNode; meaningless mid-edge nodes
  /// are corrected (settle_collapsed_edges).
  void add_element(std::int64_t type, std::int64_t number, std::span<std::int64_t> nodes);
};

}  // namespace hiac::formats::ansys

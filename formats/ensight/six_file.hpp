#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::ensight {

/// A mesh in EnSight's older format, version 6, as text: one list of nodes, and parts whose
/// elements refer to it. Numbers are in columns: integers in 8, reals in 12, six a line.
class SixMesh {
 public:
  /// Adds the file's nodes, cells and parts (as blocks). Throws InputError with the line.
  void read(const std::string& path, ForeignMesh& mesh);

  /// The values of a variable's file for all nodes or cells; NaN where the file has none.
  [[nodiscard]] std::vector<double> values(const std::string& path, FieldLocation location,
                                           std::size_t width) const;

 private:
  /// The cells of one part that are listed under one element name.
  struct Section {
    std::size_t first;
    std::size_t count;
  };
  std::size_t points_ = 0;
  std::size_t cells_ = 0;
  std::map<std::string, std::map<std::string, Section>> parts_;  ///< by number and element's name
};

}  // namespace hiac::formats::ensight

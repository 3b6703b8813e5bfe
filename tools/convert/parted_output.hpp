#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// How a mesh is divided into the parts of a parted mesh (-o FILE.zparts).
struct Parting {
  std::optional<std::uint32_t> parts;  ///< of equal weight, as the partitioner makes them
  std::string field;                   ///< of cells, whose values are numbers of parts
  bool keep = false;                   ///< the pieces that the input is in

  void add_options(CLI::App& app);
  /// Throws UsageError where the output and these options do not belong together.
  void check_output(const std::string& output) const;
};

/// Whether an output is a parted mesh, as its extension says.
bool is_parted_output(const std::string& output);

/// For every cell the piece that it was read from, if these are known.
using Pieces = std::optional<std::vector<std::uint32_t>>;

/// Divides the mesh, claims the parts' files, writes them and the index, and tells how the parts
/// are. `input` names the mesh in messages.
void write_parts(Tool& tool, const Parting& parting, const ZooMesh& mesh, const Pieces& pieces,
                 const std::string& input, const std::string& output);

}  // namespace hiac::tools

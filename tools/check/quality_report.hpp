#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "hiac/check/quality/mesh_parts.hpp"
#include "hiac/check/quality/mesh_quality.hpp"

namespace hiac::tools {

/// What --quality has found out about a mesh.
struct Quality {
  MeshParts parts;
  std::vector<KindQuality> kinds;
};

/// Tables of the figures of every kind, for people.
std::string quality_table(const Quality& quality);

/// The same for programs.
nlohmann::ordered_json quality_json(const Quality& quality);

}  // namespace hiac::tools

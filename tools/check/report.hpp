#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "hiac/check/cycles.hpp"
#include "hiac/check/defect.hpp"
#include "hiac/check/mesh_convexity.hpp"
#include "hiac/check/regularity.hpp"
#include "hiac/check/repair.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "tools/check/quality_report.hpp"

namespace hiac::tools {

/// The cycles of one view.
struct ViewCycles {
  std::string view;  ///< "frame 3", "direction 0.1 0.2 0.9"
  std::vector<VisibilityGroup> groups;
};

/// All that a run has found out about a mesh.
struct Judgement {  // NOLINT(bugprone-exception-escape): the standard library's moves say so
  std::vector<Finding> findings;
  std::vector<ViewCycles> views;  ///< those asked about
  std::optional<MeshConvexity> convexity;
  std::optional<Certificate> certificate;
  std::optional<RepairCounts> repair;
  std::optional<Quality> quality;
  bool overlaps_asked = false;

  /// Whether cells are known to have inner points in common, so that no order of them is right.
  [[nodiscard]] bool cells_overlap() const;
};

/// A table of the findings, what makes the mesh invalid first, for people.
std::string judgement_table(const ZooMesh& mesh, const Judgement& judgement, std::size_t max_ids);

/// The same for programs; at most `max_ids` offenders of each finding and cells of each group.
nlohmann::ordered_json judgement_facts(const Judgement& judgement, std::size_t max_ids);

/// "3 inverted cells, 2 pairs of cells that overlap": what makes the mesh invalid.
std::string reasons(const Judgement& judgement);

}  // namespace hiac::tools

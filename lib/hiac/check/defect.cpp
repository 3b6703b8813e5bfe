#include "hiac/check/defect.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace hiac {
namespace {

using enum Severity;

constexpr std::array<DefectDescription, kDefectCount> kDefects{
    {{"node_index", "cells with a node that is not there", invalid, Offence::cell, ""},
     {"coordinate", "nodes whose coordinates are not finite", invalid, Offence::node, ""},
     {"adjacency", "faces whose stored neighbour is not theirs", invalid, Offence::face, ""},
     {"zero_volume", "cells without volume", invalid, Offence::cell, ""},
     {"inverted", "inverted cells", invalid, Offence::cell, ""},
     {"jacobian", "cells whose Jacobian is not positive throughout", invalid, Offence::cell, ""},
     {"overshared_face", "faces of cells that share one with two others or more", invalid,
      Offence::face, ""},
     {"folded_face", "pairs of cells on one side of their common face", invalid, Offence::cell_pair,
      ""},
     {"overlap", "pairs of cells that overlap", invalid, Offence::cell_pair,
      "depth, of the smaller cell's size"},
     {"jacobian_undecided", "cells whose Jacobian's sign is not decided", warning, Offence::cell,
      ""},
     {"possible_overlap", "pairs of cells, curved or with bent faces, whose overlap is undecided",
      warning, Offence::cell_pair, ""},
     {"grazing_overlap", "pairs of cells that overlap by rounding", warning, Offence::cell_pair,
      "depth, of the smaller cell's size"},
     {"repeated_node", "cells with one node twice", warning, Offence::cell, ""},
     {"duplicate_node", "nodes at the place of another", warning, Offence::node, ""},
     {"unused_node", "nodes of no cell", warning, Offence::node, ""},
     {"nonplanar_face", "cells with a face that is not planar", warning, Offence::cell,
      "deviation, of the face's size"},
     {"nonconvex_cell", "cells that are not convex", warning, Offence::cell, ""},
     {"torn_interface", "faces against another with nodes of its own", warning, Offence::face, ""},
     {"hanging_interface", "faces against parts of a larger one, or several", warning,
      Offence::face, ""},
     {"sliding_interface", "faces that others cover in part", warning, Offence::face, ""},
     {"cycle", "cells of visibility cycles", warning, Offence::group, ""},
     {"left_handed", "left-handed cells: the whole mesh is", note, Offence::cell, ""}}};

}  // namespace

const DefectDescription& description_of(Defect defect) {
  return kDefects[static_cast<std::size_t>(defect)];
}

double Finding::largest() const {
  double most = 0;
  for (const Offender& offender : offenders) most = std::max(most, offender.measure);
  return most;
}

void add_finding(std::vector<Finding>& findings, Defect defect, std::vector<Offender> offenders) {
  if (!offenders.empty()) findings.push_back({defect, std::move(offenders)});
}

bool any_invalid(std::span<const Finding> findings) {
  return std::ranges::any_of(findings, [](const Finding& finding) {
    return description_of(finding.defect).severity == Severity::invalid;
  });
}

}  // namespace hiac

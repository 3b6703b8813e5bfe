#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace hiac {

/// The effect of a finding on a picture of the mesh.
enum class Severity : std::uint8_t {
  note,     ///< for information only
  warning,  ///< drawn as it is, but often not what was intended
  invalid   ///< a picture would be wrong, or cannot be made
};

/// The defects that a mesh can have.
enum class Defect : std::uint8_t {
  node_index,
  coordinate,
  adjacency,
  zero_volume,
  inverted,
  jacobian,
  overshared_face,
  folded_face,
  overlap,
  jacobian_undecided,
  possible_overlap,
  grazing_overlap,
  repeated_node,
  duplicate_node,
  unused_node,
  nonplanar_face,
  nonconvex_cell,
  torn_interface,
  hanging_interface,
  sliding_interface,
  cycle,
  left_handed
};
inline constexpr std::size_t kDefectCount = static_cast<std::size_t>(Defect::left_handed) + 1;

/// The meaning of the numbers of a defect's offenders.
enum class Offence : std::uint8_t {
  node,       ///< a node; `other`, if there is one: the node that it is a copy of
  cell,       ///< a cell
  cell_pair,  ///< two cells
  face,       ///< a cell and the number of its face in its shape's table
  group       ///< a cell of a cycle, and the number of the view
};

struct DefectDescription {
  std::string_view key;    ///< for programs: "zero_volume"
  std::string_view title;  ///< for people: "cells without volume"
  Severity severity;
  Offence offence;
  std::string_view measure;  ///< the meaning of Offender::measure; empty if it is unused
};

/// Returns the description of a defect, from a table; does not throw.
const DefectDescription& description_of(Defect defect);

inline constexpr std::uint64_t kNobody = std::numeric_limits<std::uint64_t>::max();

/// One place where a mesh has a defect. Offence tells what the numbers mean.
struct Offender {
  std::uint64_t id;
  std::uint64_t other = kNobody;
  double measure = 0;

  bool operator==(const Offender&) const = default;
};

/// All places where a mesh has one defect, in ascending order; at least one.
struct Finding {
  Defect defect;
  std::vector<Offender> offenders;

  /// The largest measure.
  [[nodiscard]] double largest() const;
};

/// Appends a finding unless there are no offenders.
void add_finding(std::vector<Finding>& findings, Defect defect, std::vector<Offender> offenders);

/// Returns whether any of the findings makes the mesh invalid.
bool any_invalid(std::span<const Finding> findings);

}  // namespace hiac

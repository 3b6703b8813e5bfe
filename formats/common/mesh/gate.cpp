#include "formats/common/mesh/gate.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/common/cells/node_order.hpp"
#include "formats/common/io/bytes_behind.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

void check_coordinates(std::span<const double> xyz, const UsedPoints& used,
                       const std::string& subject) {
  for (std::size_t i = 0; i < xyz.size(); ++i) {
    if (std::isfinite(xyz[i])) continue;
    const std::size_t node = i / 3;
    throw InputError(subject,
                     fmt::format("point {}: coordinate {} is not finite ({} found)",
                                 used.all ? node : used.chosen[node], "xyz"[i % 3], xyz[i]));
  }
}

}  // namespace

void pass_gate(Reading& reading, const UsedPoints& used, const std::string& subject) {
  check_coordinates(reading.mesh.xyz.view(), used, subject);
  check_edge_nodes(reading.mesh, subject, reading.notes);
  validate(reading.mesh, subject);
}

void finish_reading(Reading& reading, const std::string& subject) {
  if (reading.mesh.cell_count() > 0) {
    note_bytes_behind_container(subject, reading.notes);
    auto& metadata = reading.mesh.metadata;
    const bool named = std::any_of(metadata.begin(), metadata.end(),
                                   [](const auto& entry) { return entry.first == "source"; });
    // a mesh that was exported before keeps its original name
    if (!named)
      metadata.emplace(metadata.begin(), "source",
                       std::filesystem::path(subject).filename().string());
    return;
  }
  throw InputError(subject, reading.notes.empty() ? "holds no cells"
                                                  : fmt::format("holds no volume cells ({})",
                                                                fmt::join(reading.notes, "; ")));
}

}  // namespace hiac::formats

#include "formats/zoo/zoo_format.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/fields/location_name.hpp"
#include "hiac/mesh/zoo_layout.hpp"

namespace hiac::formats {
namespace {

Reading read_zoo(const std::string& path, const ReadOptions& options) {
  return reading_of(read_zoo_file(path), options, path);
}

Inventory inspect_zoo(const std::string& path) { return inventory_of(read_zoo_file(path).mesh); }

std::vector<std::string> write_zoo(const std::string& path, const ZooMesh& mesh) {
  write_zoo_file(path, {mesh, {}});
  return {};
}

}  // namespace

Reading reading_of(ZooFile&& file, const ReadOptions& options, const std::string& subject) {
  if (options.block || options.time || options.step.value_or(0) != 0)
    throw UsageError(fmt::format("{}: {} is a zoo container, which holds one mesh at one time",
                                 options.block  ? "block"
                                 : options.time ? "time"
                                                : "step",
                                 subject));
  Reading reading{std::move(file.mesh), {}};
  for (const ExtraChunk& chunk : file.extras)
    reading.notes.push_back(
        fmt::format("left out the chunk '{}', which belongs to the mesh as it "
                    "was",
                    chunk.type));
  return reading;
}

Inventory inventory_of(const ZooMesh& mesh) {
  Inventory inventory;
  inventory.format = "zoo";
  inventory.points = mesh.node_count();
  std::array<std::size_t, kKindCount> counts{};
  for (const CellKind kind : mesh.kinds) ++counts[static_cast<std::size_t>(kind)];
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const std::string name(kind_name(static_cast<CellKind>(k)));
    if (counts[k] > 0) inventory.cells.push_back({name, counts[k], name});
  }
  for (const auto& [key, text] : mesh.metadata) {
    double time = 0;
    if (key == "time" &&
        std::from_chars(text.data(), text.data() + text.size(), time).ec == std::errc())
      inventory.times.push_back(time);
  }
  for (const Field& field : mesh.fields) {
    FieldSummary summary;
    summary.name = field.name;
    summary.location = location_name(field.location);
    summary.type = "double";
    summary.components = field.components;
    summary.tuples = field.values.size() / field.components;
    summarize_values(field.values.view(), summary);
    inventory.fields.push_back(std::move(summary));
  }
  return inventory;
}

Format zoo_format() {
  Format format;
  format.name = "zoo";
  format.extensions = {".zoo"};
  format.kinds = "all fifteen";
  format.fields = "node, cell, corner";
  format.time_steps = "one";
  format.recognizes = [](std::string_view head) {
    const std::string_view magic(reinterpret_cast<const char*>(zoo_layout::kMagic.data()),
                                 zoo_layout::kMagic.size());
    return head.starts_with(magic);
  };
  format.read = read_zoo;
  format.inspect = inspect_zoo;
  format.write = write_zoo;
  return format;
}

}  // namespace hiac::formats

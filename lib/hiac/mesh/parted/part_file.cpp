#include "hiac/mesh/parted/part_file.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/mesh_hash.hpp"

namespace hiac {
namespace {

using Corner = std::array<double, 3>;

/// The box around all nodes; low is above high where there are none.
std::pair<Corner, Corner> box_of(const ZooMesh& mesh) {
  Corner low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < mesh.xyz.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], mesh.xyz[i]);
    high[i % 3] = std::max(high[i % 3], mesh.xyz[i]);
  }
  return {low, high};
}

/// The numbers of a chunk, one for each of `count` nodes or cells.
SharedArray<std::uint64_t> numbers_in(const std::vector<ExtraChunk>& chunks, std::string_view type,
                                      std::uint64_t count, const std::string& subject) {
  const ExtraChunk* found = nullptr;
  for (const ExtraChunk& chunk : chunks) {
    if (chunk.type != type) continue;
    if (found != nullptr)
      throw InputError(subject, fmt::format("chunk {} is there twice (one expected)", type));
    found = &chunk;
  }
  if (found == nullptr)
    throw InputError(subject, fmt::format("is no part of a parted mesh (a chunk {} expected, none "
                                          "found)",
                                          type));
  const auto bytes = found->payload.view();
  if (bytes.size() % sizeof(std::uint64_t) != 0 || bytes.size() / sizeof(std::uint64_t) != count)
    throw InputError(subject, fmt::format("chunk {}: wrong size ({} numbers of 8 bytes expected, "
                                          "{} bytes found)",
                                          type, count, bytes.size()));
  // payloads start at multiples of 64 bytes
  return {{reinterpret_cast<const std::uint64_t*>(bytes.data()), count},
          std::make_shared<SharedArray<std::uint8_t>>(found->payload)};
}

void check_numbers(std::span<const std::uint64_t> numbers, std::uint64_t total, const char* what,
                   const std::string& subject) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && numbers[i] <= numbers[i - 1])
      throw InputError(subject, fmt::format("{} {}: the global numbers do not rise (above {} "
                                            "expected, {} found)",
                                            what, i, numbers[i - 1], numbers[i]));
    if (numbers[i] >= total)
      throw InputError(subject, fmt::format("{} {}: the global number is out of range (below {} "
                                            "expected, {} found)",
                                            what, i, total, numbers[i]));
  }
}

void require_equal(const std::string& subject, const std::string& index, std::string_view what,
                   const std::string& expected, const std::string& found) {
  if (expected != found)
    throw InputError(subject, fmt::format("is not the part that {} describes: another {} ({} "
                                          "expected, {} found)",
                                          index, what, expected, found));
}

std::string text_of(const Corner& low, const Corner& high) {
  return fmt::format("{} {} {} to {} {} {}", low[0], low[1], low[2], high[0], high[1], high[2]);
}

}  // namespace

MeshPart read_mesh_part(const PartedIndex& index, std::size_t part) {
  const PartInfo& wanted = index.parts.at(part);
  const std::string path = index.path_of(part);
  ZooFile file = read_zoo_file(path);
  MeshPart result;
  result.mesh = std::move(file.mesh);
  const auto require = [&](std::string_view what, const auto& expected, const auto& found) {
    require_equal(path, index.path, what, fmt::format("{}", expected), fmt::format("{}", found));
  };
  require("number of cells", wanted.cells, result.mesh.cell_count());
  require("number of nodes", wanted.nodes, result.mesh.node_count());
  result.global_nodes = numbers_in(file.extras, kGlobalNodesChunk, wanted.nodes, path);
  result.global_cells = numbers_in(file.extras, kGlobalCellsChunk, wanted.cells, path);
  require("hash", wanted.hash, content_hash(result.mesh));
  require("hash of the global numbers", wanted.numbers_hash,
          numbers_hash(result.global_nodes.view(), result.global_cells.view()));
  check_numbers(result.global_nodes.view(), index.nodes, "node", path);
  check_numbers(result.global_cells.view(), index.cells, "cell", path);
  const auto [low, high] = box_of(result.mesh);
  if (low != wanted.low || high != wanted.high)
    require("box", text_of(wanted.low, wanted.high), text_of(low, high));
  return result;
}

ZooFile zoo_file_of(const MeshPart& part) {
  const auto chunk = [](const char* type, const SharedArray<std::uint64_t>& numbers) {
    const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(numbers.data()),
                                              8 * numbers.size());
    return ExtraChunk{type, {bytes, std::make_shared<SharedArray<std::uint64_t>>(numbers)}};
  };
  return {
      part.mesh,
      {chunk(kGlobalNodesChunk, part.global_nodes), chunk(kGlobalCellsChunk, part.global_cells)}};
}

PartInfo part_info(const MeshPart& part, const std::string& file) {
  const auto [low, high] = box_of(part.mesh);
  return {file,
          part.mesh.cell_count(),
          part.mesh.node_count(),
          low,
          high,
          content_hash(part.mesh),
          numbers_hash(part.global_nodes.view(), part.global_cells.view())};
}

}  // namespace hiac

#include "hiac/mesh/parted/part_agreement.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

/// A field's tuple at a node, or its coordinates, as bytes.
std::span<const double> tuple(std::span<const double> values, std::size_t width, NodeId node) {
  return values.subspan(width * node, width);
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

/// A hash of a node's coordinates and values that is never 0, which stands for no node.
std::uint64_t fingerprint(const ZooMesh& mesh, NodeId node) {
  std::uint64_t hash = XXH3_64bits(mesh.position(node).data(), 3 * sizeof(double));
  for (const Field& field : mesh.fields) {
    if (field.location != FieldLocation::node) continue;
    const auto values = tuple(field.values.view(), field.components, node);
    hash = XXH3_64bits_withSeed(values.data(), values.size_bytes(), hash);
  }
  return std::max<std::uint64_t>(hash, 1);
}

/// The place of a global number in a part, if it is there.
std::optional<NodeId> place_of(const SharedArray<std::uint64_t>& numbers, std::uint64_t number) {
  const auto found = std::ranges::lower_bound(numbers.view(), number);
  if (found == numbers.end() || *found != number) return std::nullopt;
  return static_cast<NodeId>(found - numbers.begin());
}

class Agreement {
 public:
  Agreement(const PartedIndex& index, std::span<const MeshPart> parts)
      : index_(index), parts_(parts) {}

  void check() {
    check_fields();
    check_cells();
    check_nodes();
  }

 private:
  [[noreturn]] void refuse(std::size_t part, const std::string& message) const {
    throw InputError(index_.path_of(part), message);
  }

  void check_fields() const {
    const auto same = [](const Field& a, const Field& b) {
      return a.name == b.name && a.unit == b.unit && a.location == b.location &&
             a.components == b.components;
    };
    for (std::size_t k = 1; k < parts_.size(); ++k)
      if (!std::ranges::equal(parts_[k].mesh.fields, parts_[0].mesh.fields, same))
        refuse(k, fmt::format("does not carry the same fields as {}", index_.parts[0].file));
  }

  /// As the parts' cells add up to those of the whole, none is missing where none is there twice.
  void check_cells() const {
    std::vector<bool> seen(index_.cells, false);
    for (std::size_t k = 0; k < parts_.size(); ++k)
      for (const std::uint64_t cell : parts_[k].global_cells) {
        if (seen[cell]) refuse_cell(k, cell);
        seen[cell] = true;
      }
  }
  [[noreturn]] void refuse_cell(std::size_t part, std::uint64_t cell) const {
    std::size_t other = 0;
    while (!place_of(parts_[other].global_cells, cell)) ++other;
    refuse(part, fmt::format("cell {} of the whole mesh is in {}, too (each cell in one part "
                             "expected)",
                             cell, index_.parts[other].file));
  }

  void check_nodes() const {
    std::vector<std::uint64_t> known(index_.nodes, 0);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const MeshPart& part = parts_[k];
      for (NodeId node = 0; node < part.mesh.node_count(); ++node) {
        const std::uint64_t number = part.global_nodes[node];
        const std::uint64_t own = fingerprint(part.mesh, node);
        if (known[number] != 0 && known[number] != own) refuse_node(k, node, number);
        known[number] = own;
      }
    }
    const auto missing = std::ranges::find(known, 0U);
    if (missing != known.end())
      throw InputError(index_.path, fmt::format("node {} of the whole mesh is in no part",
                                                missing - known.begin()));
  }
  [[noreturn]] void refuse_node(std::size_t part, NodeId node, std::uint64_t number) const {
    std::size_t other = 0;
    while (!place_of(parts_[other].global_nodes, number)) ++other;
    const ZooMesh& a = parts_[part].mesh;
    const ZooMesh& b = parts_[other].mesh;
    const NodeId there = *place_of(parts_[other].global_nodes, number);
    std::string what = "other coordinates";
    if (same_bits(a.position(node), b.position(there)))
      for (std::size_t f = 0; f < a.fields.size(); ++f) {
        const Field& field = a.fields[f];
        if (field.location == FieldLocation::node &&
            !same_bits(tuple(field.values.view(), field.components, node),
                       tuple(b.fields[f].values.view(), field.components, there)))
          what = fmt::format("another value of the field '{}'", field.name);
      }
    refuse(part, fmt::format("node {} of the whole mesh has {} than in {}", number, what,
                             index_.parts[other].file));
  }

  const PartedIndex& index_;
  std::span<const MeshPart> parts_;
};

}  // namespace

void check_agreement(const PartedIndex& index, std::span<const MeshPart> parts) {
  Agreement(index, parts).check();
}

}  // namespace hiac

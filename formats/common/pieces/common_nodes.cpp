#include "formats/common/pieces/common_nodes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace hiac::formats {
namespace {

/// Copies of one number in several files differ by at most this fraction of the largest one: files
/// may be written with few digits.
constexpr double kFewDigits = 1e-5;

class Finder {
 public:
  Finder(const ZooMesh& mesh, std::span<const std::size_t> offsets)
      : mesh_(mesh), offsets_(offsets) {
    result_.first.resize(mesh.node_count());
    std::iota(result_.first.begin(), result_.first.end(), NodeId{0});
  }

  CommonNodes run(const std::string& numbers) {
    const Field* field = number_field(numbers);
    if (field == nullptr || !find_by_numbers(*field)) find_by_places();
    return std::move(result_);
  }

 private:
  [[nodiscard]] const Field* number_field(const std::string& numbers) const {
    const std::array<std::string_view, 4> names{numbers, "GlobalNodeId", "GlobalNodeIds",
                                                "GlobalPointIds"};
    for (const std::string_view name : names)
      for (const Field& field : mesh_.fields)
        if (!name.empty() && field.name == name && field.location == FieldLocation::node &&
            field.components == 1)
          return &field;
    return nullptr;
  }

  [[nodiscard]] std::size_t piece_of(NodeId node) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(offsets_, node) - offsets_.begin());
  }

  /// Calls group(nodes) for the nodes of equal keys, which ascend. `less` compares nodes' keys.
  template <typename Less, typename Group>
  void for_each_group(const Less& less, const Group& group) const {
    std::vector<NodeId> order = result_.first;
    std::ranges::stable_sort(order, less);
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
      while (end < order.size() && !less(order[begin], order[end])) ++end;
      group(std::span<const NodeId>(order).subspan(begin, end - begin));
    }
  }

  /// Whether all are of different pieces; node numbers ascend, so nodes of one piece are
  /// neighbours.
  [[nodiscard]] bool of_different_pieces(std::span<const NodeId> nodes) const {
    return std::ranges::adjacent_find(nodes, [&](NodeId a, NodeId b) {
             return piece_of(a) == piece_of(b);
           }) == nodes.end();
  }

  void find_by_places() {
    result_.by = "their equal coordinates and values";
    for_each_group(
        [&](NodeId a, NodeId b) {
          return std::ranges::lexicographical_compare(mesh_.position(a), mesh_.position(b));
        },
        [&](std::span<const NodeId> nodes) {
          if (!of_different_pieces(nodes)) return;
          for (const NodeId other : nodes.subspan(1))
            if (values_agree(nodes[0], other, false)) result_.first[other] = nodes[0];
        });
  }

  /// False, with a note, where these are not the numbers that nodes have in the whole mesh.
  bool find_by_numbers(const Field& field) {
    const auto refuse = [&](std::string_view why) {
      result_.notes.push_back(
          fmt::format("'{}' does not number the nodes of all pieces, as {}: joined by places",
                      field.name, why));
      std::iota(result_.first.begin(), result_.first.end(), NodeId{0});
      return false;
    };
    const auto whole = [](double number) { return std::floor(number) == number; };
    if (!std::ranges::all_of(field.values.view(), whole)) return refuse("not all are whole");
    measure();
    bool repeated = false, far = false;
    std::size_t apart = 0;
    for_each_group([&](NodeId a, NodeId b) { return field.values[a] < field.values[b]; },
                   [&](std::span<const NodeId> nodes) {
                     if (!of_different_pieces(nodes)) repeated = true;
                     for (const NodeId other : nodes.subspan(1)) {
                       if (!places_agree(nodes[0], other)) far = true;
                       if (values_agree(nodes[0], other, true))
                         result_.first[other] = nodes[0];
                       else
                         ++apart;
                     }
                   });
    if (repeated) return refuse("a piece has one twice");
    if (far) return refuse("one stands for different places");
    result_.by = fmt::format("their '{}'", field.name);
    if (apart > 0)
      result_.notes.push_back(
          fmt::format("{} nodes of equal '{}' have different values in the pieces and stay apart",
                      apart, field.name));
    if (changed_ > 0)
      result_.notes.push_back(
          fmt::format("coordinates or values of common nodes differ by up to {:.3g} of the largest "
                      "one: those of the first piece count",
                      changed_));
    return true;
  }

  /// The largest absolute values of coordinates and of every field, which are scales.
  void measure() {
    const auto largest = [](std::span<const double> values) {
      double most = 0;
      for (const double value : values)
        if (std::isfinite(value)) most = std::max(most, std::abs(value));
      return most;
    };
    extent_ = largest(mesh_.xyz.view());
    for (const Field& field : mesh_.fields) scales_.push_back(largest(field.values.view()));
  }

  bool close(double a, double b, double scale) {
    if (std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b)) return true;
    if (!(std::abs(a - b) <= kFewDigits * scale)) return false;
    if (scale > 0) changed_ = std::max(changed_, std::abs(a - b) / scale);
    return true;
  }

  bool places_agree(NodeId a, NodeId b) {
    const auto p = mesh_.position(a), q = mesh_.position(b);
    for (std::size_t c = 0; c < 3; ++c)
      if (!close(p[c], q[c], extent_)) return false;
    return true;
  }

  bool values_agree(NodeId a, NodeId b, bool nearly) {
    for (std::size_t f = 0; f < mesh_.fields.size(); ++f) {
      const Field& field = mesh_.fields[f];
      if (field.location != FieldLocation::node) continue;
      const std::size_t width = field.components;
      for (std::size_t c = 0; c < width; ++c)
        if (!close(field.values[a * width + c], field.values[b * width + c],
                   nearly ? scales_[f] : -1))
          return false;
    }
    return true;
  }

  const ZooMesh& mesh_;
  std::span<const std::size_t> offsets_;
  double extent_ = 0;
  std::vector<double> scales_;  // by field
  double changed_ = 0;          // the largest difference of what is joined, relative to its scale
  CommonNodes result_;
};

}  // namespace

CommonNodes common_nodes(const ZooMesh& mesh, std::span<const std::size_t> offsets,
                         const std::string& numbers) {
  return Finder(mesh, offsets).run(numbers);
}

}  // namespace hiac::formats

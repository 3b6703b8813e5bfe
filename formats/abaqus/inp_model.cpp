#include "formats/abaqus/inp_model.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "formats/common/io/number_index.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::abaqus {
namespace {

/// Instances of generated parts have at most this many numbers: a short deck can ask for any
/// amount.
constexpr std::size_t kMostNumbers = 32'000'000;

/// A part with its name, its placement and the sets of its elements.
struct Piece {
  Part* part;
  std::string name;
  Placement placement;
  std::vector<const NumberSets*> sets;
};

void add_cell(std::vector<IndexRange>& cells, std::size_t cell) {
  if (!cells.empty() && cells.back().end == cell)
    ++cells.back().end;
  else
    cells.push_back({cell, cell + 1});
}

/// Adds the cells of a set; numbers that no cell has are ignored.
void add_set(const std::vector<NumberRange>& set, const NumberIndex& index, std::size_t first_cell,
             const std::vector<std::int64_t>& numbers, std::vector<IndexRange>& cells) {
  for (const NumberRange& range : set) {
    // a range may be far longer than the mesh
    const auto wide =
        static_cast<std::uint64_t>(range.last) - static_cast<std::uint64_t>(range.first);
    if (wide / static_cast<std::uint64_t>(range.step) > numbers.size()) {
      for (std::size_t cell = 0; cell < numbers.size(); ++cell)
        if (numbers[cell] >= range.first && numbers[cell] <= range.last &&
            (numbers[cell] - range.first) % range.step == 0)
          add_cell(cells, first_cell + cell);
      continue;
    }
    for (std::int64_t number = range.first;; number += range.step) {
      const std::size_t cell = index.find(number);
      if (cell != NumberIndex::kNone) add_cell(cells, first_cell + cell);
      if (range.last - number < range.step) break;
    }
  }
}

class Merger {
 public:
  Merger(Model& model, const std::string& subject) : model_(model), subject_(subject) {
    mesh_.types = model.types;
    mesh_.notes = std::move(model.notes);
  }

  ForeignMesh run() {
    const std::vector<Piece> pieces = find_pieces();
    check_size(pieces);
    if (pieces.size() == 1 && !pieces.front().placement.moved)
      take_over(pieces.front());
    else
      for (const Piece& piece : pieces) append(piece, pieces.size() > 1);
    for (auto& [key, block] : blocks_) mesh_.blocks.push_back(std::move(block));
    return std::move(mesh_);
  }

 private:
  std::vector<Piece> find_pieces() const {
    std::vector<Piece> pieces;
    for (const Instance& instance : model_.instances) {
      const auto part = std::find_if(
          model_.parts.begin(), model_.parts.end(),
          [&](const Part& other) { return upper(other.name) == upper(instance.part); });
      if (part == model_.parts.end())
        throw InputError(subject_, fmt::format("instance '{}': there is no part '{}'",
                                               instance.name, instance.part));
      pieces.push_back({&*part, instance.name, instance.placement, {&part->sets, &instance.sets}});
    }
    if (model_.instances.empty())
      for (Part& part : model_.parts) pieces.push_back({&part, part.name, {}, {&part.sets}});
    if (pieces.empty() || !model_.root.cell_types.empty())
      pieces.push_back({&model_.root, "", {}, {&model_.root.sets}});
    return pieces;
  }

  void check_size(const std::vector<Piece>& pieces) const {
    std::size_t numbers = 0;
    for (const Piece& piece : pieces)
      if (piece.part->made)
        numbers += piece.part->xyz.size() + piece.part->cell_nodes.size() +
                   piece.part->cell_numbers.size();
    if (numbers > kMostNumbers)
      throw InputError(subject_,
                       fmt::format("its instances of what keywords make are too large ({} "
                                   "numbers at most expected, {} found)",
                                   kMostNumbers, numbers));
  }

  /// A single piece: its arrays are moved, not copied.
  void take_over(const Piece& piece) {
    add_blocks(piece, 0);
    Part& part = *piece.part;
    mesh_.node_numbers = std::move(part.node_numbers);
    mesh_.xyz = std::move(part.xyz);
    mesh_.cell_numbers = std::move(part.cell_numbers);
    mesh_.cell_types = std::move(part.cell_types);
    mesh_.cell_nodes = std::move(part.cell_nodes);
  }

  void append(const Piece& piece, bool several) {
    const Part& part = *piece.part;
    const NumberIndex index(part.node_numbers);
    const std::size_t first_node = mesh_.point_count();
    const std::size_t first_cell = mesh_.cell_count();
    for (std::size_t node = 0; node < part.node_numbers.size(); ++node) {
      const auto point =
          piece.placement.moved
              ? placed(piece.placement, &part.xyz[3 * node])
              : std::array{part.xyz[3 * node], part.xyz[3 * node + 1], part.xyz[3 * node + 2]};
      mesh_.xyz.insert(mesh_.xyz.end(), point.begin(), point.end());
    }
    for (const std::int64_t number : part.cell_nodes) {
      if (number == kLeftOutNode) {
        mesh_.cell_nodes.push_back(number);
        continue;
      }
      const std::size_t place = index.find(number);
      if (place == NumberIndex::kNone)
        throw InputError(subject_, fmt::format("'{}': an element names node {}, which there is not",
                                               piece.name, number));
      mesh_.cell_nodes.push_back(static_cast<std::int64_t>(first_node + place));
    }
    mesh_.cell_types.insert(mesh_.cell_types.end(), part.cell_types.begin(), part.cell_types.end());
    mesh_.cell_numbers.insert(mesh_.cell_numbers.end(), part.cell_numbers.begin(),
                              part.cell_numbers.end());
    add_blocks(piece, first_cell);
    if (several && !piece.name.empty() && !part.cell_types.empty())
      block(piece.name).push_back({first_cell, mesh_.cell_count()});
  }

  void add_blocks(const Piece& piece, std::size_t first_cell) {
    const NumberIndex index(piece.part->cell_numbers);
    for (const NumberSets* sets : piece.sets)
      for (const auto& [key, set] : *sets)
        add_set(set.ranges, index, first_cell, piece.part->cell_numbers, block(set.name));
  }

  std::vector<IndexRange>& block(const std::string& name) {
    ForeignBlock& found = blocks_[upper(name)];
    if (found.name.empty()) found.name = name;
    return found.cells;
  }

  Model& model_;
  const std::string& subject_;
  ForeignMesh mesh_;
  std::map<std::string, ForeignBlock> blocks_;
};

}  // namespace

ForeignMesh mesh_of(Model&& model, const std::string& subject) {
  return Merger(model, subject).run();
}

}  // namespace hiac::formats::abaqus

#include "formats/vtk/legacy/legacy_cells.hpp"

#include <fmt/format.h>
#include <vtkCellType.h>

namespace hiac::formats::vtk {
namespace {

constexpr NumberType kTypeNumber{NumberType::Family::signed_integer, 4};

/// Walks through the cells in step with their types.
class CellWalk {
 public:
  CellWalk(const LegacyWords& words, const LegacyCells& cells, std::size_t points)
      : words_(words),
        cells_(cells),
        points_(points),
        types_(words.text(), cells.types_at, kTypeNumber, words.binary()),
        offsets_(words.text(), cells.offsets_at, cells.offset_type, words.binary()),
        entries_(words.text(), cells.entries_at, cells.entry_type, words.binary()) {}

  void run() {
    if (cells_.has_offsets) check_offset(0, 0);
    for (cell_ = 0; cell_ < cells_.count; ++cell_) {
      const std::int64_t type = types_.next();
      if (type < 0 || type > 255)
        fail(types_, fmt::format("unknown type (0 to 255 expected, {} found)", type));
      const std::size_t length = cell_length();
      if (type == VTK_POLYHEDRON)
        check_faces(length);
      else
        check_nodes(length);
    }
    const std::size_t total = used_ + (cells_.has_offsets ? 0 : cells_.count);
    if (total != cells_.entries)
      words_.fail_at(entries_.at(), fmt::format("the cells do not fill their list ({} numbers "
                                                "expected, {} found)",
                                                cells_.entries, total));
  }

 private:
  /// The number of entries of the next cell; they remain in the list.
  std::size_t cell_length() {
    if (cells_.has_offsets) {
      const std::size_t before = used_;
      const std::size_t end = check_offset(cell_ + 1, before);
      used_ = end;
      return end - before;
    }
    const std::size_t taken = used_ + cell_ + 1;
    if (taken > cells_.entries) fail(entries_, "is missing from the list of cells");
    const std::int64_t length = entries_.next();
    if (length < 0 || static_cast<std::uint64_t>(length) > cells_.entries - taken)
      fail(entries_, fmt::format("wrong number of nodes (0 to {} expected, {} found)",
                                 cells_.entries - taken, length));
    used_ += static_cast<std::size_t>(length);
    return static_cast<std::size_t>(length);
  }

  std::size_t check_offset(std::size_t index, std::size_t low) {
    const std::int64_t offset = offsets_.next();
    const std::size_t high = index == 0 ? 0 : cells_.entries;
    if (offset < 0 || static_cast<std::uint64_t>(offset) < low ||
        static_cast<std::uint64_t>(offset) > high)
      fail(offsets_,
           fmt::format("wrong offset {} ({} to {} expected, {} found)", index, low, high, offset));
    return static_cast<std::size_t>(offset);
  }

  void check_nodes(std::size_t length) {
    for (std::size_t i = 0; i < length; ++i) {
      const std::int64_t node = entries_.next();
      if (node < 0 || static_cast<std::uint64_t>(node) >= points_)
        fail(entries_, fmt::format("no such point (0 to {} expected, {} found)",
                                   static_cast<std::int64_t>(points_) - 1, node));
    }
  }

  /// A polyhedron: its number of faces, then for each face its number of nodes and its nodes.
  void check_faces(std::size_t length) {
    std::size_t left = length;
    const std::size_t faces = face_number(left, left);
    for (std::size_t f = 0; f < faces; ++f) {
      const std::size_t corners = face_number(left, left);
      if (corners > left) fail(entries_, "the list of its faces is too short");
      check_nodes(corners);
      left -= corners;
    }
    if (left != 0) fail(entries_, fmt::format("the list of its faces is too long by {}", left));
  }

  std::size_t face_number(std::size_t& left, std::size_t high) {
    if (left == 0) fail(entries_, "the list of its faces is too short");
    --left;
    const std::int64_t number = entries_.next();
    if (number < 0 || static_cast<std::uint64_t>(number) > high)
      fail(entries_, fmt::format("wrong list of faces (0 to {} expected, {} found)", high, number));
    return static_cast<std::size_t>(number);
  }

  [[noreturn]] void fail(const IntegerStream& where, const std::string& what) const {
    words_.fail_at(where.at(), fmt::format("cell {}: {}", cell_, what));
  }

  const LegacyWords& words_;
  const LegacyCells& cells_;
  std::size_t points_;
  IntegerStream types_;
  IntegerStream offsets_;
  IntegerStream entries_;
  std::size_t cell_ = 0;
  std::size_t used_ = 0;  ///< entries of the cells so far, their counts not counted
};

}  // namespace

void check_legacy_cells(const LegacyWords& words, const LegacyCells& cells, std::size_t points) {
  CellWalk(words, cells, points).run();
}

}  // namespace hiac::formats::vtk

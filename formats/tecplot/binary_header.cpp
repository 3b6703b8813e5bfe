#include "formats/tecplot/binary_header.hpp"

#include <array>
#include <bit>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "formats/tecplot/binary_items.hpp"

namespace hiac::formats::tecplot {
namespace {

/// The last version whose zones may be packed point by point.
constexpr int kLastPacked = 111;
constexpr std::int32_t kOrdered = 0;
// the marks before other records of the header
constexpr float kLabelsMark = 599;
constexpr float kUserMark = 699;
constexpr float kAuxiliaryMark = 799;
constexpr float kVariableAuxiliaryMark = 899;
constexpr float kEndMark = 357;

struct ElementType {
  std::string_view name;
  std::size_t nodes;
  std::size_t faces;
};
constexpr std::array<ElementType, 8> kElements{{{"ORDERED", 0, 0},
                                                {"LINESEG", 2, 2},
                                                {"TRIANGLE", 3, 3},
                                                {"QUADRILATERAL", 4, 4},
                                                {"TETRAHEDRON", 4, 4},
                                                {"BRICK", 8, 6},
                                                {"POLYGON", 0, 0},
                                                {"POLYHEDRON", 0, 0}}};
/// From this type on, elements are described by their faces.
constexpr std::int32_t kPolygon = 6;

class HeaderReader {
 public:
  HeaderReader(ByteStream& stream, int version) : stream_(stream), version_(version) {}

  BinaryHeader read() {
    constexpr std::int32_t kSwapped = 0x01000000;
    const auto one = stream_.read<std::int32_t>("the byte order");
    if (one == kSwapped) {
      stream_.set_order(std::endian::native == std::endian::little ? std::endian::big
                                                                   : std::endian::little);
    } else if (one != 1) {
      stream_.fail(fmt::format("1 expected as the mark of the byte order ({} found)", one));
    }
    const std::int32_t type = version_ > 108 ? read_integer(stream_, "the type of file") : 0;
    if (type == 2) stream_.fail("a file of solutions alone (one with the grid expected)");
    header_.file.title = read_text(stream_, "the title");
    const std::size_t variables = read_count(stream_, "the number of variables", 4);
    for (std::size_t v = 0; v < variables; ++v)
      header_.file.variables.push_back(read_text(stream_, "a variable"));
    while (read_header_record()) {
    }
    return std::move(header_);
  }

 private:
  bool read_header_record() {
    const auto mark = stream_.read<float>("a mark of the header");
    if (mark == kEndMark) return false;
    if (mark == kZoneMark) {
      read_zone_header();
    } else if (mark == kLabelsMark) {
      for (std::size_t n = read_count(stream_, "the number of labels", 4); n > 0; --n)
        read_text(stream_, "a label");
    } else if (mark == kUserMark) {
      read_text(stream_, "a user's record");
    } else if (mark == kAuxiliaryMark || mark == kVariableAuxiliaryMark) {
      if (mark == kVariableAuxiliaryMark) read_integer(stream_, "a variable's number");
      read_auxiliary();
    } else {
      stream_.fail(
          fmt::format("a zone, auxiliary data or the header's end expected (the mark {} "
                      "found; texts and geometries are not read)",
                      mark));
    }
    return true;
  }

  void read_auxiliary() {
    read_text(stream_, "auxiliary data");
    read_integer(stream_, "the format of auxiliary data");
    read_text(stream_, "auxiliary data");
  }

  void read_zone_header() {
    Zone zone;
    ZoneLayout layout;
    zone.name = read_text(stream_, "the zone's name");
    if (zone.name.empty()) zone.name = fmt::format("zone {}", header_.file.zones.size() + 1);
    read_integer(stream_, "the parent zone");
    const std::int32_t strand = read_integer(stream_, "the strand");
    const auto time = stream_.read<double>("the solution time");
    // zones without a strand exist at all times
    if (strand > 0 || strand == -2 || time != 0) zone.time = time;
    read_integer(stream_, "the zone's colour");
    const std::int32_t type = read_integer(stream_, "the zone's type");
    if (type < 0 || static_cast<std::size_t>(type) >= kElements.size())
      stream_.fail(
          fmt::format("zone '{}': type {} is not known (0 to 7 expected)", zone.name, type));
    if (version_ <= kLastPacked) layout.by_points = read_integer(stream_, "the packing") == 1;
    zone.cell_centered.resize(header_.file.variables.size());
    if (read_integer(stream_, "whether locations follow") != 0)
      for (std::size_t v = 0; v < header_.file.variables.size(); ++v)
        zone.cell_centered[v] = read_integer(stream_, "a variable's location") == 1;
    layout.raw_neighbors = read_integer(stream_, "whether neighbours follow") != 0;
    layout.neighbors = read_integer(stream_, "the number of neighbours");
    if (layout.neighbors != 0) {
      layout.neighbor_mode = read_integer(stream_, "the kind of neighbours");
      if (type != kOrdered) read_integer(stream_, "whether neighbours are complete");
    }
    const ElementType& element = kElements[static_cast<std::size_t>(type)];
    zone.ordered = type == kOrdered;
    layout.faces = element.faces;
    if (zone.ordered)
      read_dimensions(zone);
    else
      read_sizes(zone, element, type >= kPolygon, layout);
    while (read_integer(stream_, "whether auxiliary data follow") != 0) read_auxiliary();
    header_.file.zones.push_back(std::move(zone));
    header_.layouts.push_back(layout);
  }

  void read_dimensions(Zone& zone) {
    zone.nodes = 1;
    zone.elements = 1;
    for (std::size_t& points : zone.dimensions) {
      points = read_extent(stream_, "an extent of the zone");
      zone.elements *= points > 1 ? points - 1 : 1;
      zone.nodes *= points;
      limit(zone, zone.nodes, "nodes");
    }
    if (zone.nodes == 0) zone.elements = 0;
  }

  void read_sizes(Zone& zone, const ElementType& element, bool by_faces, ZoneLayout& layout) {
    zone.element = element.name;
    zone.nodes_per_element = element.nodes;
    zone.nodes = read_extent(stream_, "the number of nodes");
    layout.by_faces = by_faces;
    if (by_faces) {
      layout.zone_faces = read_extent(stream_, "the number of faces");
      layout.face_nodes = read_extent(stream_, "the number of the faces' nodes");
      layout.outer_faces = read_extent(stream_, "the number of boundary faces");
      layout.connections = read_extent(stream_, "the number of boundary connections");
    }
    zone.elements = read_extent(stream_, "the number of elements");
    limit(zone, zone.nodes, "nodes");
    limit(zone, zone.elements, "elements");
    for (int i = 0; i < 3; ++i) read_integer(stream_, "a dimension of the cells");
  }

  /// Coordinates take at least a byte per node, elements more. Shared or passive ones take none,
  /// but then another zone has at least as many.
  void limit(const Zone& zone, std::size_t count, std::string_view what) {
    if (count > stream_.size())
      stream_.fail(
          fmt::format("zone '{}': more {} than the file holds ({} found)", zone.name, what, count));
  }

  ByteStream& stream_;
  int version_;
  BinaryHeader header_;
};

}  // namespace

BinaryHeader read_binary_header(ByteStream& stream, int version) {
  return HeaderReader(stream, version).read();
}

}  // namespace hiac::formats::tecplot

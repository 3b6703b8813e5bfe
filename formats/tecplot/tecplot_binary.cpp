#include "formats/tecplot/tecplot_binary.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "formats/common/io/byte_stream.hpp"
#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::tecplot {
namespace {

constexpr std::string_view kMagic = "#!TDV";
constexpr int kOldest = 107;
constexpr int kNewest = 112;
/// The last version whose zones may be packed point by point.
constexpr int kLastPacked = 111;
constexpr std::int32_t kOrdered = 0;
constexpr std::int32_t kNone = -1;

// the marks before records of the header
constexpr float kZoneMark = 299;
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

/// The parts of a zone's header that are needed to read its data.
struct ZoneHeader {
  std::size_t faces = 0;  ///< of an element
  bool by_points = false;
  bool raw_neighbors = false;
  std::int64_t neighbors = 0;
  std::int32_t neighbor_mode = 0;
  bool by_faces = false;        ///< polygons or polyhedra; the zone then has
  std::size_t zone_faces = 0;   ///< faces,
  std::size_t face_nodes = 0;   ///< nodes of all faces,
  std::size_t outer_faces = 0;  ///< faces connected with other zones, and one more,
  std::size_t connections = 0;  ///< and these connections
};

class Reader {
 public:
  explicit Reader(const InputText& text) : stream_(text.text(), text.path()) {
    const std::string_view version = text.text().substr(0, 8).substr(kMagic.size());
    version_ = static_cast<int>(to_integer(version).value_or(0));
    if (version_ < kOldest || version_ > kNewest)
      stream_.fail(fmt::format("a version from {} to {} expected ('{}' found)", kOldest, kNewest,
                               shown(version)));
    stream_.move_to(8);
  }

  TecplotFile read() {
    constexpr std::int32_t kSwapped = 0x01000000;
    const auto one = stream_.read<std::int32_t>("the byte order");
    if (one == kSwapped) {
      stream_.set_order(std::endian::native == std::endian::little ? std::endian::big
                                                                   : std::endian::little);
    } else if (one != 1) {
      stream_.fail(fmt::format("1 expected as the mark of the byte order ({} found)", one));
    }
    const std::int32_t type = version_ > 108 ? integer("the type of file") : 0;
    if (type == 2) stream_.fail("a file of solutions alone (one with the grid expected)");
    file_.title = text("the title");
    const std::size_t variables = count("the number of variables", 4);
    for (std::size_t v = 0; v < variables; ++v) file_.variables.push_back(text("a variable"));
    while (read_header_record()) {
    }
    for (std::size_t z = 0; z < file_.zones.size(); ++z) read_data(z);
    return std::move(file_);
  }

 private:
  std::int32_t integer(std::string_view what) { return stream_.read<std::int32_t>(what); }

  /// A count of items that take at least `bytes` each.
  std::size_t count(std::string_view what, std::size_t bytes) {
    const std::int32_t value = integer(what);
    if (value < 0 ||
        static_cast<std::size_t>(value) > stream_.left() / std::max<std::size_t>(bytes, 1))
      stream_.fail(fmt::format("{}: {} is more than the file holds", what, value));
    return static_cast<std::size_t>(value);
  }
  /// The extent of a zone; its size is checked when the data are read.
  std::size_t extent(std::string_view what) {
    const std::int32_t value = integer(what);
    if (value < 0) stream_.fail(fmt::format("{}: not a count ({} found)", what, value));
    return static_cast<std::size_t>(value);
  }

  /// A text that stores an integer for every character, ended by a zero.
  std::string text(std::string_view what) {
    std::string result;
    while (const std::int32_t c = integer(what)) result += static_cast<char>(c);
    return result;
  }

  bool read_header_record() {
    const auto mark = stream_.read<float>("a mark of the header");
    if (mark == kEndMark) return false;
    if (mark == kZoneMark) {
      read_zone_header();
    } else if (mark == kLabelsMark) {
      for (std::size_t n = count("the number of labels", 4); n > 0; --n) text("a label");
    } else if (mark == kUserMark) {
      text("a user's record");
    } else if (mark == kAuxiliaryMark || mark == kVariableAuxiliaryMark) {
      if (mark == kVariableAuxiliaryMark) integer("a variable's number");
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
    text("auxiliary data");
    integer("the format of auxiliary data");
    text("auxiliary data");
  }

  void read_zone_header() {
    Zone zone;
    ZoneHeader header;
    zone.name = text("the zone's name");
    if (zone.name.empty()) zone.name = fmt::format("zone {}", file_.zones.size() + 1);
    integer("the parent zone");
    const std::int32_t strand = integer("the strand");
    const auto time = stream_.read<double>("the solution time");
    // zones without a strand exist at all times
    if (strand > 0 || strand == -2 || time != 0) zone.time = time;
    integer("the zone's colour");
    const std::int32_t type = integer("the zone's type");
    if (type < 0 || static_cast<std::size_t>(type) >= kElements.size())
      stream_.fail(
          fmt::format("zone '{}': type {} is not known (0 to 7 expected)", zone.name, type));
    if (version_ <= kLastPacked) header.by_points = integer("the packing") == 1;
    zone.cell_centered.resize(file_.variables.size());
    if (integer("whether locations follow") != 0)
      for (std::size_t v = 0; v < file_.variables.size(); ++v)
        zone.cell_centered[v] = integer("a variable's location") == 1;
    header.raw_neighbors = integer("whether neighbours follow") != 0;
    header.neighbors = integer("the number of neighbours");
    if (header.neighbors != 0) {
      header.neighbor_mode = integer("the kind of neighbours");
      if (type != kOrdered) integer("whether neighbours are complete");
    }
    const ElementType& element = kElements[static_cast<std::size_t>(type)];
    zone.ordered = type == kOrdered;
    header.faces = element.faces;
    if (zone.ordered)
      read_dimensions(zone);
    else
      read_sizes(zone, element, type >= kPolygon, header);
    while (integer("whether auxiliary data follow") != 0) read_auxiliary();
    file_.zones.push_back(std::move(zone));
    headers_.push_back(header);
  }

  void read_dimensions(Zone& zone) {
    zone.nodes = 1;
    zone.elements = 1;
    for (std::size_t& points : zone.dimensions) {
      points = extent("an extent of the zone");
      zone.elements *= points > 1 ? points - 1 : 1;
      zone.nodes *= points;
      limit(zone, zone.nodes, "nodes");
    }
    if (zone.nodes == 0) zone.elements = 0;
  }

  void read_sizes(Zone& zone, const ElementType& element, bool by_faces, ZoneHeader& header) {
    zone.element = element.name;
    zone.nodes_per_element = element.nodes;
    zone.nodes = extent("the number of nodes");
    header.by_faces = by_faces;
    if (by_faces) {
      header.zone_faces = extent("the number of faces");
      header.face_nodes = extent("the number of the faces' nodes");
      header.outer_faces = extent("the number of boundary faces");
      header.connections = extent("the number of boundary connections");
    }
    zone.elements = extent("the number of elements");
    limit(zone, zone.nodes, "nodes");
    limit(zone, zone.elements, "elements");
    for (int i = 0; i < 3; ++i) integer("a dimension of the cells");
  }

  /// Coordinates take at least a byte per node, elements more. Shared or passive ones take none,
  /// but then another zone has at least as many.
  void limit(const Zone& zone, std::size_t count, std::string_view what) {
    if (count > stream_.size())
      stream_.fail(
          fmt::format("zone '{}': more {} than the file holds ({} found)", zone.name, what, count));
  }

  void read_data(std::size_t z) {
    Zone& zone = file_.zones[z];
    const ZoneHeader& header = headers_[z];
    if (stream_.read<float>("a zone's data") != kZoneMark)
      stream_.fail(fmt::format("zone '{}': the mark of its data expected", zone.name));
    const std::size_t variables = file_.variables.size();
    std::vector<std::int32_t> types(variables);
    for (std::int32_t& type : types) type = integer("a variable's format");
    const std::vector<bool> passive = flags("passive variables");
    std::vector<std::int32_t> shared(variables, kNone);
    if (integer("whether variables are shared") != 0)
      for (std::int32_t& from : shared) from = integer("the zone that shares a variable");
    const std::int32_t shared_cells = integer("the zone that shares its elements");
    std::vector<std::size_t> stored;
    zone.values.resize(variables);
    for (std::size_t v = 0; v < variables; ++v) {
      if (shared[v] != kNone)
        take_shared(z, v, shared[v]);
      else if (passive[v])
        zone.values[v].assign(tuples(zone, v), std::numeric_limits<double>::quiet_NaN());
      else
        stored.push_back(v);
    }
    stream_.skip(2 * sizeof(double) * stored.size(), "the variables' ranges");
    if (header.by_points)
      read_points(zone, stored, types);
    else
      for (const std::size_t v : stored) read_block(zone, v, types[v]);
    read_cells(z, shared_cells);
  }

  std::vector<bool> flags(std::string_view what) {
    std::vector<bool> result(file_.variables.size(), false);
    if (integer(what) == 0) return result;
    for (std::size_t v = 0; v < result.size(); ++v) result[v] = integer(what) != 0;
    return result;
  }

  static std::size_t tuples(const Zone& zone, std::size_t v) {
    return zone.cell_centered[v] ? zone.elements : zone.nodes;
  }

  const Zone& earlier_zone(std::size_t z, std::int32_t from) {
    if (from < 0 || static_cast<std::size_t>(from) >= z)
      stream_.fail(fmt::format("zone '{}' shares with zone {}, which does not come before it",
                               file_.zones[z].name, from));
    return file_.zones[static_cast<std::size_t>(from)];
  }

  void take_shared(std::size_t z, std::size_t v, std::int32_t from) {
    const Zone& other = earlier_zone(z, from);
    Zone& zone = file_.zones[z];
    zone.cell_centered[v] = other.cell_centered[v];
    if (other.values[v].size() != tuples(zone, v))
      stream_.fail(fmt::format("zone '{}' shares a variable of another size", zone.name));
    zone.values[v] = other.values[v];
  }

  double value(std::int32_t type) {
    switch (type) {
      case 1:
        return static_cast<double>(stream_.read<float>("a value"));
      case 2:
        return stream_.read<double>("a value");
      case 3:
        return stream_.read<std::int32_t>("a value");
      case 4:
        return stream_.read<std::int16_t>("a value");
      case 5:
        return stream_.read<std::uint8_t>("a value");
      default:
        stream_.fail(fmt::format("values of the format {} (1 to 5 expected)", type));
    }
  }

  void read_points(Zone& zone, const std::vector<std::size_t>& stored,
                   const std::vector<std::int32_t>& types) {
    for (std::size_t node = 0; node < zone.nodes; ++node)
      for (const std::size_t v : stored) zone.values[v].push_back(value(types[v]));
  }

  /// Values on cells of an ordered zone are stored as if the cells were as many as the nodes along
  /// all axes but the last.
  void read_block(Zone& zone, std::size_t v, std::int32_t type) {
    constexpr std::array<std::size_t, 6> kBytes{1, 4, 8, 4, 2, 1};
    const auto [ni, nj, nk] =
        std::array{zone.dimensions[0], zone.dimensions[1], zone.dimensions[2]};
    const bool padded = zone.ordered && zone.cell_centered[v];
    std::size_t stored = tuples(zone, v);
    if (padded) stored = nk > 1 ? ni * nj * (nk - 1) : ni * (nj > 1 ? nj - 1 : 1);
    const std::size_t bytes = kBytes[type > 0 && type < 6 ? static_cast<std::size_t>(type) : 0];
    if (stored > stream_.left() / bytes) stream_.skip(stored * bytes, file_.variables[v]);
    std::vector<double>& values = zone.values[v];
    values.reserve(tuples(zone, v));
    for (std::size_t i = 0; i < stored; ++i) {
      const double one = value(type);
      const bool hidden =
          padded && ((ni > 1 && i % ni == ni - 1) || (nk > 1 && nj > 1 && i / ni % nj == nj - 1));
      if (!hidden) values.push_back(one);
    }
  }

  void read_cells(std::size_t z, std::int32_t shared) {
    Zone& zone = file_.zones[z];
    const ZoneHeader& header = headers_[z];
    if (shared != kNone) {
      const Zone& other = earlier_zone(z, shared);
      if (other.element != zone.element || other.elements != zone.elements)
        stream_.fail(fmt::format("zone '{}' shares elements of another size", zone.name));
      zone.connectivity = other.connectivity;
      zone.polyhedra = other.polyhedra;
      return;
    }
    if (header.by_faces) return read_faces(zone, header);
    const std::size_t entries = zone.ordered ? 0 : zone.elements * zone.nodes_per_element;
    if (entries > stream_.left() / 4) stream_.skip(4 * entries, "the elements");
    zone.connectivity.reserve(entries);
    for (std::size_t e = 0; e < entries; ++e)
      zone.connectivity.push_back(std::int64_t{integer("an element's node")} + 1);
    if (header.raw_neighbors)
      stream_.skip(4 * zone.elements * header.faces, "the elements' neighbours");
    for (std::int64_t n = 0; n < header.neighbors; ++n) skip_neighbor(header.neighbor_mode);
  }

  std::vector<std::int32_t> integers(std::size_t amount, std::string_view what) {
    if (amount > stream_.left() / 4) stream_.skip(4 * amount, what);
    std::vector<std::int32_t> result(amount);
    for (std::int32_t& value : result) value = integer(what);
    return result;
  }

  /// The start of the nodes of each face of polyhedra, the nodes of all faces, the elements to the
  /// left and to the right of each face (less than 0: none, or in another zone), and connections
  /// with other zones. All count from 0.
  void read_faces(Zone& zone, const ZoneHeader& header) {
    const bool solid = zone.element == "POLYHEDRON";
    // every element has a face, and a face has at most two elements
    if (zone.elements > 2 * header.zone_faces)
      stream_.fail(fmt::format("zone '{}': {} elements of {} faces", zone.name, zone.elements,
                               header.zone_faces));
    std::vector<std::int32_t> starts;
    if (solid) {
      starts = integers(header.zone_faces + 1, "the faces' places");
      if (!std::is_sorted(starts.begin(), starts.end()) || starts.front() != 0 ||
          static_cast<std::size_t>(starts.back()) != header.face_nodes)
        stream_.fail(fmt::format("zone '{}': places of faces that rise from 0 to {} expected",
                                 zone.name, header.face_nodes));
      zone.polyhedra.resize(zone.elements);
    }
    const std::vector<std::int32_t> nodes = integers(header.face_nodes, "the faces' nodes");
    for (int side = 0; side < 2; ++side) {
      const auto beside = integers(header.zone_faces, "the elements beside the faces");
      for (std::size_t f = 0; f < beside.size() && solid; ++f)
        if (beside[f] >= 0) add_face(zone, beside[f], nodes, starts[f], starts[f + 1]);
    }
    const std::size_t offsets = header.outer_faces > 0 ? header.outer_faces + 1 : 0;
    integers(offsets, "the boundary faces");
    integers(offsets > 0 ? header.connections : 0, "the connected elements");
    integers(offsets > 0 ? header.connections : 0, "the connected zones");
  }

  void add_face(Zone& zone, std::int32_t element, const std::vector<std::int32_t>& nodes,
                std::int32_t begin, std::int32_t end) const {
    if (static_cast<std::size_t>(element) >= zone.elements)
      stream_.fail(fmt::format("zone '{}': there is no element {} beside a face (0 to {} expected)",
                               zone.name, element, zone.elements - 1));
    auto& face = zone.polyhedra[static_cast<std::size_t>(element)].emplace_back();
    for (std::int32_t n = begin; n < end; ++n)
      face.push_back(std::int64_t{nodes[static_cast<std::size_t>(n)]} + 1);
  }

  /// Local and global neighbours, one or several per face.
  void skip_neighbor(std::int32_t mode) {
    const std::size_t each = mode < 2 ? 1 : 2;
    stream_.skip(8, "a neighbour");
    if (mode % 2 == 0) return stream_.skip(4 * each, "a neighbour");
    integer("a neighbour");
    stream_.skip(4 * each * count("the number of neighbours", 4), "a neighbour");
  }

  ByteStream stream_;
  int version_ = 0;
  TecplotFile file_;
  std::vector<ZoneHeader> headers_;
};

}  // namespace

bool is_tecplot_binary(std::string_view head) { return head.starts_with(kMagic); }

TecplotFile read_tecplot_binary(const InputText& text) { return Reader(text).read(); }

}  // namespace hiac::formats::tecplot

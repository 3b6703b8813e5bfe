#include "formats/tecplot/tecplot_binary.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "formats/common/io/byte_stream.hpp"
#include "formats/common/io/bytes_behind.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/tecplot/binary_header.hpp"
#include "formats/tecplot/binary_items.hpp"

namespace hiac::formats::tecplot {
namespace {

constexpr std::string_view kMagic = "#!TDV";
constexpr int kOldest = 107;
constexpr int kNewest = 112;
constexpr std::int32_t kNone = -1;

class BinaryReader {
 public:
  explicit BinaryReader(const InputText& text) : stream_(text.text(), text.path()) {
    const std::string_view version = text.text().substr(0, 8).substr(kMagic.size());
    version_ = static_cast<int>(to_integer(version).value_or(0));
    if (version_ < kOldest || version_ > kNewest)
      stream_.fail(fmt::format("a version from {} to {} expected ('{}' found)", kOldest, kNewest,
                               shown(version)));
    stream_.move_to(8);
  }

  TecplotFile read() {
    BinaryHeader header = read_binary_header(stream_, version_);
    file_ = std::move(header.file);
    layouts_ = std::move(header.layouts);
    for (std::size_t z = 0; z < file_.zones.size(); ++z) read_data(z);
    note_bytes_behind(stream_.left(), "the last zone", file_.notes);
    return std::move(file_);
  }

 private:
  void read_data(std::size_t z) {
    Zone& zone = file_.zones[z];
    const ZoneLayout& layout = layouts_[z];
    if (stream_.read<float>("a zone's data") != kZoneMark)
      stream_.fail(fmt::format("zone '{}': the mark of its data expected", zone.name));
    const std::size_t variables = file_.variables.size();
    std::vector<std::int32_t> types(variables);
    for (std::int32_t& type : types) type = read_integer(stream_, "a variable's format");
    const std::vector<bool> passive = flags("passive variables");
    std::vector<std::int32_t> shared(variables, kNone);
    if (read_integer(stream_, "whether variables are shared") != 0)
      for (std::int32_t& from : shared)
        from = read_integer(stream_, "the zone that shares a variable");
    const std::int32_t shared_cells = read_integer(stream_, "the zone that shares its elements");
    std::vector<std::size_t> stored;
    zone.values.resize(variables);
    for (std::size_t v = 0; v < variables; ++v) {
      if (shared[v] != kNone)
        take_shared(z, v, shared[v]);
      else if (passive[v])
        zone.values[v].assign(zone.tuples(v), std::numeric_limits<double>::quiet_NaN());
      else
        stored.push_back(v);
    }
    stream_.skip(2 * sizeof(double) * stored.size(), "the variables' ranges");
    if (layout.by_points)
      read_points(zone, stored, types);
    else
      for (const std::size_t v : stored) read_block(zone, v, types[v]);
    read_cells(z, shared_cells);
  }

  std::vector<bool> flags(std::string_view what) {
    std::vector<bool> result(file_.variables.size(), false);
    if (read_integer(stream_, what) == 0) return result;
    for (std::size_t v = 0; v < result.size(); ++v) result[v] = read_integer(stream_, what) != 0;
    return result;
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
    if (other.values[v].size() != zone.tuples(v))
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
    std::size_t stored = zone.tuples(v);
    if (padded) stored = nk > 1 ? ni * nj * (nk - 1) : ni * (nj > 1 ? nj - 1 : 1);
    const std::size_t bytes = kBytes[type > 0 && type < 6 ? static_cast<std::size_t>(type) : 0];
    if (stored > stream_.left() / bytes) stream_.skip(stored * bytes, file_.variables[v]);
    std::vector<double>& values = zone.values[v];
    values.reserve(zone.tuples(v));
    for (std::size_t i = 0; i < stored; ++i) {
      const double one = value(type);
      const bool hidden =
          padded && ((ni > 1 && i % ni == ni - 1) || (nk > 1 && nj > 1 && i / ni % nj == nj - 1));
      if (!hidden) values.push_back(one);
    }
  }

  void read_cells(std::size_t z, std::int32_t shared) {
    Zone& zone = file_.zones[z];
    const ZoneLayout& layout = layouts_[z];
    if (shared != kNone) {
      const Zone& other = earlier_zone(z, shared);
      if (other.element != zone.element || other.elements != zone.elements)
        stream_.fail(fmt::format("zone '{}' shares elements of another size", zone.name));
      zone.connectivity = other.connectivity;
      zone.polyhedra = other.polyhedra;
      return;
    }
    if (layout.by_faces) return read_faces(zone, layout);
    const std::size_t entries = zone.ordered ? 0 : zone.elements * zone.nodes_per_element;
    if (entries > stream_.left() / 4) stream_.skip(4 * entries, "the elements");
    zone.connectivity.reserve(entries);
    for (std::size_t e = 0; e < entries; ++e)
      zone.connectivity.push_back(std::int64_t{read_integer(stream_, "an element's node")} + 1);
    if (layout.raw_neighbors)
      stream_.skip(4 * zone.elements * layout.faces, "the elements' neighbours");
    for (std::int64_t n = 0; n < layout.neighbors; ++n) skip_neighbor(layout.neighbor_mode);
  }

  /// The start of the nodes of each face of polyhedra, the nodes of all faces, the elements to the
  /// left and to the right of each face (less than 0: none, or in another zone), and connections
  /// with other zones. All count from 0.
  void read_faces(Zone& zone, const ZoneLayout& layout) {
    const bool solid = zone.element == "POLYHEDRON";
    // every element has a face, and a face has at most two elements
    if (zone.elements > 2 * layout.zone_faces)
      stream_.fail(fmt::format("zone '{}': {} elements of {} faces", zone.name, zone.elements,
                               layout.zone_faces));
    std::vector<std::int32_t> starts;
    if (solid) {
      starts = read_integers(stream_, layout.zone_faces + 1, "the faces' places");
      if (!std::is_sorted(starts.begin(), starts.end()) || starts.front() != 0 ||
          static_cast<std::size_t>(starts.back()) != layout.face_nodes)
        stream_.fail(fmt::format("zone '{}': places of faces that rise from 0 to {} expected",
                                 zone.name, layout.face_nodes));
      zone.polyhedra.resize(zone.elements);
    }
    const std::vector<std::int32_t> nodes =
        read_integers(stream_, layout.face_nodes, "the faces' nodes");
    for (int side = 0; side < 2; ++side) {
      const auto beside =
          read_integers(stream_, layout.zone_faces, "the elements beside the faces");
      for (std::size_t f = 0; f < beside.size() && solid; ++f)
        if (beside[f] >= 0) add_face(zone, beside[f], nodes, starts[f], starts[f + 1]);
    }
    const std::size_t offsets = layout.outer_faces > 0 ? layout.outer_faces + 1 : 0;
    read_integers(stream_, offsets, "the boundary faces");
    read_integers(stream_, offsets > 0 ? layout.connections : 0, "the connected elements");
    read_integers(stream_, offsets > 0 ? layout.connections : 0, "the connected zones");
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
    read_integer(stream_, "a neighbour");
    stream_.skip(4 * each * read_count(stream_, "the number of neighbours", 4), "a neighbour");
  }

  ByteStream stream_;
  int version_ = 0;
  TecplotFile file_;
  std::vector<ZoneLayout> layouts_;
};

}  // namespace

bool is_tecplot_binary(std::string_view head) { return head.starts_with(kMagic); }

TecplotFile read_tecplot_binary(const InputText& text) { return BinaryReader(text).read(); }

}  // namespace hiac::formats::tecplot

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/common/io/byte_stream.hpp"
#include "formats/tecplot/tecplot_zones.hpp"

namespace hiac::formats::tecplot {

/// The mark before a zone, in the header and before its data.
inline constexpr float kZoneMark = 299;

/// How a zone's data are stored.
struct ZoneLayout {
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

/// The header section of a binary data file.
struct BinaryHeader {
  TecplotFile file;  ///< its zones have no data yet
  std::vector<ZoneLayout> layouts;
};

/// Reads the header section of a file of that version, from the mark of the byte order, which it
/// sets, to the end of the section. Throws InputError naming the byte.
BinaryHeader read_binary_header(ByteStream& stream, int version);

}  // namespace hiac::formats::tecplot

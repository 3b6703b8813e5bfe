// $Nodes, $Elements and $Entities of versions 1, 2, 3, 4.0 and 4.1 (the Gmsh reference manual, "MSH
// file format", for version 4.0 that of Gmsh 4.0; for version 3, which no manual describes,
// GModelIO_MSH3.cpp of Gmsh).
#include <array>

#include <fmt/format.h>

#include "formats/common/io/large_reserve.hpp"
#include "formats/gmsh/gmsh_sections.hpp"
#include "formats/gmsh/gmsh_types.hpp"

namespace hiac::formats::gmsh {
namespace {

constexpr std::size_t kMostDimension = 3;

/// Turns Gmsh's type numbers into places in ForeignMesh::types.
class Types {
 public:
  explicit Types(std::vector<ForeignType>& types) : types_(types) { places_.fill(kUnseen); }

  std::uint16_t place_of(std::int64_t number, const MshStream& stream) {
    if (number >= 0 && static_cast<std::size_t>(number) < places_.size() &&
        places_[static_cast<std::size_t>(number)] != kUnseen)
      return places_[static_cast<std::size_t>(number)];
    const ForeignType* type = element_type(number);
    if (type == nullptr) stream.fail(fmt::format("unknown element type {}", number));
    types_.push_back(*type);
    const auto place = static_cast<std::uint16_t>(types_.size() - 1);
    places_[static_cast<std::size_t>(number)] = place;
    return place;
  }

 private:
  static constexpr std::uint16_t kUnseen = 0xffff;
  std::vector<ForeignType>& types_;
  std::array<std::uint16_t, 256> places_{};
};

void add_to_group(MshContents& contents, DimTag group, std::size_t begin, std::size_t end) {
  if (begin == end) return;
  std::vector<IndexRange>& ranges = contents.groups[group];
  if (!ranges.empty() && ranges.back().end == begin)
    ranges.back().end = end;
  else
    ranges.push_back({begin, end});
}

void read_point(MshStream& stream, ForeignMesh& mesh) {
  for (int c = 0; c < 3; ++c) mesh.xyz.push_back(stream.real("a coordinate"));
}

void reserve_points(ForeignMesh& mesh, std::size_t count) {
  reserve_large(mesh.node_numbers, mesh.node_numbers.size() + count);
  reserve_large(mesh.xyz, mesh.xyz.size() + 3 * count);
}

/// Reserves no more nodes than the rest of the file can hold, nor more than this many bricks have.
void reserve_cells(MshStream& stream, ForeignMesh& mesh, std::size_t count) {
  constexpr std::size_t kLeastBytes = 2;
  constexpr std::size_t kNodes = 8;
  reserve_large(mesh.cell_types, count);
  reserve_large(mesh.cell_numbers, count);
  reserve_large(mesh.cell_nodes, std::min(stream.cursor().left() / kLeastBytes, kNodes * count));
}

/// Skips the entity of a version 2 node with parameters: its dimension and tag, and the parameters
/// on a curve or a surface.
void skip_parametric_place(MshStream& stream) {
  const std::int64_t dimension = stream.integer("an entity's dimension");
  stream.integer("an entity's tag");
  const std::int64_t parameters = dimension == 1 || dimension == 2 ? dimension : 0;
  for (std::int64_t c = 0; c < parameters; ++c) stream.real("a parametric coordinate");
}

/// The number of nodes in a list, each of which takes at least so many bytes; reserves memory for
/// them.
std::size_t begin_node_list(MshStream& stream, ForeignMesh& mesh, std::size_t binary_bytes,
                            std::size_t text_bytes) {
  const std::size_t count = stream.cursor().count("the number of nodes", stream.cursor().left());
  if (stream.binary()) stream.cursor().line();
  if (count > stream.cursor().left() / (stream.binary() ? binary_bytes : text_bytes) + 1)
    stream.fail(fmt::format("{} nodes announced, more than the file can hold", count));
  reserve_points(mesh, count);
  return count;
}

/// Versions 1 and 2: a list of number and coordinates.
void read_nodes_2(MshStream& stream, MshContents& contents, bool parametric) {
  ForeignMesh& mesh = contents.mesh;
  constexpr std::size_t kBinaryBytes = 28;
  constexpr std::size_t kTextBytes = 8;
  const std::size_t count = begin_node_list(stream, mesh, kBinaryBytes, kTextBytes);
  for (std::size_t i = 0; i < count; ++i) {
    mesh.node_numbers.push_back(stream.integer("a node number"));
    read_point(stream, mesh);
    if (parametric) skip_parametric_place(stream);
  }
}

/// Version 3: a list of number, coordinates and entity; the entity is 0, or a dimension that is
/// followed by as many parameters.
void read_nodes_3(MshStream& stream, MshContents& contents) {
  ForeignMesh& mesh = contents.mesh;
  constexpr std::size_t kBinaryBytes = 32;
  constexpr std::size_t kTextBytes = 10;
  const std::size_t count = begin_node_list(stream, mesh, kBinaryBytes, kTextBytes);
  for (std::size_t i = 0; i < count; ++i) {
    mesh.node_numbers.push_back(stream.integer("a node number"));
    read_point(stream, mesh);
    if (stream.integer("an entity's tag") == 0) continue;
    const std::int64_t dimension = stream.integer("an entity's dimension");
    if (dimension < 0 || dimension > static_cast<std::int64_t>(kMostDimension))
      stream.fail(
          fmt::format("an entity's dimension: impossible (0 to 3 expected, {} found)", dimension));
    for (std::int64_t c = 0; c < dimension; ++c) stream.real("a parametric coordinate");
  }
}

/// The entity that a block of nodes or elements belongs to.
struct BlockHead {
  int dimension;
  std::int64_t tag;
  std::int64_t third;  ///< whether nodes have parameters; the type of elements
};

BlockHead read_block_head(MshStream& stream, bool v41) {
  std::int64_t first = stream.integer(v41 ? "an entity's dimension" : "an entity's tag");
  std::int64_t second = stream.integer(v41 ? "an entity's tag" : "an entity's dimension");
  if (!v41) std::swap(first, second);
  if (first < 0 || first > static_cast<std::int64_t>(kMostDimension))
    stream.fail(
        fmt::format("an entity's dimension: impossible (0 to 3 expected, {} found)", first));
  return {static_cast<int>(first), second, stream.integer("a block's kind")};
}

void skip_parameters(MshStream& stream, const BlockHead& head) {
  if (head.third == 0) return;
  for (int c = 0; c < head.dimension; ++c) stream.real("a parametric coordinate");
}

void read_nodes_4(MshStream& stream, MshContents& contents) {
  const bool v41 = contents.version >= 4.1;
  ForeignMesh& mesh = contents.mesh;
  const std::size_t blocks = stream.count("the number of blocks of nodes", 20);
  const std::size_t total = stream.count("the number of nodes", 24);
  if (v41) {
    stream.wide("the smallest node number");
    stream.wide("the largest node number");
  }
  reserve_points(mesh, total);
  for (std::size_t block = 0; block < blocks; ++block) {
    const BlockHead head = read_block_head(stream, v41);
    const std::size_t count = stream.count("the number of nodes of a block", 24);
    if (v41)
      for (std::size_t i = 0; i < count; ++i)
        mesh.node_numbers.push_back(stream.wide("a node number"));
    for (std::size_t i = 0; i < count; ++i) {
      if (!v41) mesh.node_numbers.push_back(stream.integer("a node number"));
      read_point(stream, mesh);
      skip_parameters(stream, head);
    }
  }
  if (mesh.node_numbers.size() != total)
    stream.fail(
        fmt::format("{} nodes expected, {} found in the blocks", total, mesh.node_numbers.size()));
}

/// One element of version 1 or 2, after its type: the physical group is its first tag.
void add_element_2(MshStream& stream, MshContents& contents, std::uint16_t type,
                   std::int64_t number, std::int64_t group) {
  ForeignMesh& mesh = contents.mesh;
  const ForeignType& known = mesh.types[type];
  if (known.conversion.fate != CellFate::no_volume && group > 0)
    add_to_group(contents, {3, group}, mesh.cell_count(), mesh.cell_count() + 1);
  mesh.cell_numbers.push_back(number);
  mesh.cell_types.push_back(type);
  for (std::size_t n = 0; n < known.nodes; ++n)
    mesh.cell_nodes.push_back(stream.integer("a node number"));
}

void read_element_text(MshStream& stream, MshContents& contents, Types& types) {
  ForeignMesh& mesh = contents.mesh;
  const std::int64_t number = stream.integer("an element number");
  const std::uint16_t type = types.place_of(stream.integer("an element type"), stream);
  std::int64_t group = 0;
  if (contents.version < 2) {
    group = stream.integer("a physical group");
    stream.integer("an elementary entity");
    const std::int64_t nodes = stream.integer("a number of nodes");
    if (nodes != static_cast<std::int64_t>(mesh.types[type].nodes))
      stream.fail(fmt::format("a {} has {} nodes ({} found)", mesh.types[type].name,
                              mesh.types[type].nodes, nodes));
  } else {
    const std::size_t tags = stream.narrow_count("a number of tags", 4);
    for (std::size_t t = 0; t < tags; ++t) {
      const std::int64_t tag = stream.integer("a tag");
      if (t == 0) group = tag;
    }
  }
  add_element_2(stream, contents, type, number, group);
}

void read_elements_2(MshStream& stream, MshContents& contents) {
  ForeignMesh& mesh = contents.mesh;
  Types types(mesh.types);
  const std::size_t total =
      stream.cursor().count("the number of elements", stream.cursor().left() / 4 + 1);
  reserve_cells(stream, mesh, total);
  if (!stream.binary()) {
    for (std::size_t i = 0; i < total; ++i) read_element_text(stream, contents, types);
    return;
  }
  stream.cursor().line();
  for (std::size_t done = 0; done < total;) {
    const std::uint16_t type = types.place_of(stream.integer("an element type"), stream);
    const std::size_t count = stream.narrow_count("a number of elements", 8);
    const std::size_t tags = stream.narrow_count("a number of tags", 4);
    if (count == 0 || count > total - done)
      stream.fail(fmt::format("elements of a block: impossible (1 to {} expected, {} found)",
                              total - done, count));
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t number = stream.integer("an element number");
      std::int64_t group = 0;
      for (std::size_t t = 0; t < tags; ++t) {
        const std::int64_t tag = stream.integer("a tag");
        if (t == 0) group = tag;
      }
      add_element_2(stream, contents, type, number, group);
    }
    done += count;
  }
}

/// Adds the elements from `begin` on to the physical groups of their entity.
void add_to_groups_of(MshContents& contents, DimTag entity, std::size_t begin) {
  const auto groups = contents.entity_groups.find(entity);
  if (groups == contents.entity_groups.end()) return;
  for (const std::int64_t group : groups->second)
    add_to_group(contents, {entity.first, group}, begin, contents.mesh.cell_count());
}

/// Version 3: a list of number, type, entity and data count; the data are the nodes, followed by
/// the element's parents and partitions.
void read_elements_3(MshStream& stream, MshContents& contents) {
  ForeignMesh& mesh = contents.mesh;
  Types types(mesh.types);
  const std::size_t total =
      stream.cursor().count("the number of elements", stream.cursor().left() / 4 + 1);
  if (stream.binary()) stream.cursor().line();
  reserve_cells(stream, mesh, total);
  for (std::size_t i = 0; i < total; ++i) {
    const std::size_t begin = mesh.cell_count();
    mesh.cell_numbers.push_back(stream.integer("an element number"));
    const std::uint16_t type = types.place_of(stream.integer("an element type"), stream);
    const std::int64_t entity = stream.integer("an entity's tag");
    const std::size_t data = stream.narrow_count("a number of data", 4);
    const ForeignType& known = mesh.types[type];
    if (data < known.nodes)
      stream.fail(fmt::format("a {} has {} nodes ({} found)", known.name, known.nodes, data));
    mesh.cell_types.push_back(type);
    for (std::size_t n = 0; n < known.nodes; ++n)
      mesh.cell_nodes.push_back(stream.integer("a node number"));
    for (std::size_t n = known.nodes; n < data; ++n) stream.integer("a partition");
    if (known.conversion.fate != CellFate::no_volume)
      add_to_groups_of(contents, {static_cast<int>(kMostDimension), entity}, begin);
  }
}

void read_elements_4(MshStream& stream, MshContents& contents) {
  const bool v41 = contents.version >= 4.1;
  ForeignMesh& mesh = contents.mesh;
  Types types(mesh.types);
  const std::size_t blocks = stream.count("the number of blocks of elements", 20);
  const std::size_t total = stream.count("the number of elements", 8);
  if (v41) {
    stream.wide("the smallest element number");
    stream.wide("the largest element number");
  }
  reserve_cells(stream, mesh, total);
  for (std::size_t block = 0; block < blocks; ++block) {
    const BlockHead head = read_block_head(stream, v41);
    const std::uint16_t type = types.place_of(head.third, stream);
    const std::size_t nodes = mesh.types[type].nodes;
    const std::size_t count = stream.count("the number of elements of a block", 8);
    const std::size_t begin = mesh.cell_count();
    for (std::size_t i = 0; i < count; ++i) {
      mesh.cell_numbers.push_back(v41 ? stream.wide("an element number")
                                      : stream.integer("an element number"));
      mesh.cell_types.push_back(type);
      for (std::size_t n = 0; n < nodes; ++n)
        mesh.cell_nodes.push_back(v41 ? stream.wide("a node number")
                                      : stream.integer("a node number"));
    }
    if (head.dimension < static_cast<int>(kMostDimension)) continue;
    add_to_groups_of(contents, {head.dimension, head.tag}, begin);
  }
  if (mesh.cell_count() != total)
    stream.fail(
        fmt::format("{} elements expected, {} found in the blocks", total, mesh.cell_count()));
}

}  // namespace

void read_nodes(MshStream& stream, MshContents& contents) {
  if (!contents.mesh.node_numbers.empty()) stream.fail("a second section of nodes");
  if (contents.version < 3)
    read_nodes_2(stream, contents, false);
  else if (contents.version < 4)
    read_nodes_3(stream, contents);
  else
    read_nodes_4(stream, contents);
}

void read_parametric_nodes(MshStream& stream, MshContents& contents) {
  if (!contents.mesh.node_numbers.empty()) stream.fail("a second section of nodes");
  read_nodes_2(stream, contents, true);
}

void read_elements(MshStream& stream, MshContents& contents) {
  if (!contents.mesh.cell_types.empty()) stream.fail("a second section of elements");
  if (contents.version < 3)
    read_elements_2(stream, contents);
  else if (contents.version < 4)
    read_elements_3(stream, contents);
  else
    read_elements_4(stream, contents);
}

void read_entities_3(TextCursor& cursor, MshContents& contents) {
  const auto some = [&](std::string_view what) {
    return cursor.count(what, cursor.left() / 2 + 1);
  };
  std::array<std::size_t, kMostDimension + 1> counts{};
  for (std::size_t& count : counts) count = some("a number of entities");
  for (std::size_t dimension = 0; dimension < counts.size(); ++dimension)
    for (std::size_t i = 0; i < counts[dimension]; ++i) {
      const std::int64_t tag = cursor.integer("an entity's tag");
      const std::size_t bounds = dimension == 0 ? 0 : some("a number of bounding entities");
      for (std::size_t b = 0; b < bounds; ++b) cursor.integer("a bounding entity");
      const std::size_t groups = some("a number of physical groups");
      for (std::size_t g = 0; g < groups; ++g)
        contents.entity_groups[{static_cast<int>(dimension), tag}].push_back(
            cursor.integer("a physical group"));
    }
}

void read_entities(MshStream& stream, MshContents& contents) {
  const bool v41 = contents.version >= 4.1;
  std::array<std::size_t, kMostDimension + 1> counts{};
  for (std::size_t& count : counts) count = stream.count("a number of entities", 4);
  for (std::size_t dimension = 0; dimension < counts.size(); ++dimension) {
    const int corners = v41 && dimension == 0 ? 3 : 6;
    for (std::size_t i = 0; i < counts[dimension]; ++i) {
      const std::int64_t tag = stream.integer("an entity's tag");
      for (int c = 0; c < corners; ++c) stream.real("an entity's extent");
      const std::size_t groups = stream.count("a number of physical groups", 4);
      for (std::size_t g = 0; g < groups; ++g)
        contents.entity_groups[{static_cast<int>(dimension), tag}].push_back(
            stream.integer("a physical group"));
      if (dimension == 0) continue;
      const std::size_t bounds = stream.count("a number of bounding entities", 4);
      for (std::size_t b = 0; b < bounds; ++b) stream.integer("a bounding entity");
    }
  }
}

}  // namespace hiac::formats::gmsh

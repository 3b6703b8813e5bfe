#include "formats/mfem/mesh_file.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "formats/common/io/bytes_behind.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::mfem {
namespace {

/// The name of a geometry and its number of vertices.
struct GeometryInfo {
  std::string_view name;
  std::size_t vertices;
};
constexpr std::array<GeometryInfo, 8> kGeometries{{{"point", 1},
                                                   {"segment", 2},
                                                   {"triangle", 3},
                                                   {"square", 4},
                                                   {"tetrahedron", 4},
                                                   {"cube", 8},
                                                   {"prism", 6},
                                                   {"pyramid", 5}}};

/// The next word after any comments; moves past it.
std::string_view next_word(TextCursor& text) {
  while (true) {
    const std::string_view word = text.word();
    if (!word.starts_with('#')) return word;
    text.line();
  }
}

std::size_t next_count(TextCursor& text, std::string_view what) {
  return text.count(what, text.left());
}

/// Reads the elements of a mesh without hanging nodes, or the leaves of one with them. `rank`: the
/// process that owns this part of the mesh; the file also lists elements of neighbouring processes.
void read_elements(TextCursor& text, bool refined, std::optional<std::int64_t> rank,
                   MeshFile& mesh) {
  for (std::size_t left = next_count(text, "the number of elements"); left > 0; --left) {
    const std::int64_t owner = refined ? text.integer("a rank") : 0;
    Element element;
    element.attribute = text.integer("an attribute");
    const std::int64_t geometry = text.integer("a geometry");
    if (geometry < 0 || geometry >= static_cast<std::int64_t>(kGeometries.size()))
      text.fail(
          fmt::format("geometry 0 to {} expected ({} found)", kGeometries.size() - 1, geometry));
    element.geometry = static_cast<Geometry>(geometry);
    if (refined && text.integer("a refinement") != 0) {
      text.line();  // a parent; its children are listed as elements
      continue;
    }
    for (std::size_t v = 0; v < vertex_count(element.geometry); ++v)
      element.vertices[v] = text.integer("a vertex");
    if (!rank || owner == *rank) mesh.elements.push_back(element);
  }
}

void skip_elements(TextCursor& text) {
  for (std::size_t left = next_count(text, "the number of elements"); left > 0; --left) {
    text.skip_space();
    text.line();
  }
}

/// Sets of attributes: each has a name, in quotes if it contains blanks, a count, and its
/// attributes.
void skip_attribute_sets(TextCursor& text) {
  for (std::size_t left = next_count(text, "the number of sets"); left > 0; --left) {
    text.skip_space();
    if (!text.at_end() && text.text()[text.offset()] == '"') {
      const std::size_t end = text.text().find('"', text.offset() + 1);
      if (end == std::string_view::npos) text.fail("a name without its end");
      text.move_to(end + 1);
    } else {
      text.word();
    }
    for (std::size_t n = next_count(text, "the number of attributes"); n > 0; --n)
      text.integer("an attribute");
  }
}

/// Coordinates, or the word "nodes" when a grid function holds them.
void read_vertices(TextCursor& text, MeshFile& mesh) {
  mesh.vertex_count = next_count(text, "the number of vertices");
  TextCursor ahead = text;
  if (next_word(ahead) == "nodes") return;
  const std::int64_t dimension = text.integer("the dimension of the space");
  if (dimension < 1 || dimension > 3) text.fail("the dimension of the space, 1 to 3, expected");
  for (std::size_t i = 0; i < mesh.vertex_count; ++i) {
    std::array<double, 3> point{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
      point[d] = text.real("a coordinate");
    mesh.vertices.push_back(point);
  }
}

/// A vertex at the middle of an edge between two other vertices.
struct Middle {
  std::int64_t vertex;
  std::array<std::int64_t, 2> parents;
};

std::vector<Middle> read_parents(TextCursor& text) {
  std::vector<Middle> middles;
  for (std::size_t left = next_count(text, "the number of vertices with parents"); left > 0;
       --left) {
    Middle middle{text.integer("a vertex"), {}};
    for (std::int64_t& parent : middle.parents) parent = text.integer("a parent");
    middles.push_back(middle);
  }
  return middles;
}

/// Places the vertices with parents in the middle between them, once the parents are placed.
void place_middles(const TextCursor& text, std::vector<Middle> middles, MeshFile& mesh) {
  const std::size_t placed_first = mesh.vertices.size();
  const std::size_t count = placed_first + middles.size();
  std::vector<bool> placed(count, false);
  std::fill(placed.begin(), placed.begin() + static_cast<long>(placed_first), true);
  mesh.vertices.resize(count);
  const auto is_vertex = [&](std::int64_t v) {
    return v >= 0 && static_cast<std::size_t>(v) < count;
  };
  while (!middles.empty()) {
    const std::size_t before = middles.size();
    std::erase_if(middles, [&](const Middle& middle) {
      const auto [a, b] = middle.parents;
      for (const std::int64_t v : {middle.vertex, a, b})
        if (!is_vertex(v))
          text.fail(fmt::format("vertex_parents name vertex {} (0 to {} expected)", v, count - 1));
      const auto ia = static_cast<std::size_t>(a);
      const auto ib = static_cast<std::size_t>(b);
      if (!placed[ia] || !placed[ib]) return false;
      const auto at = static_cast<std::size_t>(middle.vertex);
      for (std::size_t d = 0; d < 3; ++d)
        mesh.vertices[at][d] = (mesh.vertices[ia][d] + mesh.vertices[ib][d]) / 2;
      placed[at] = true;
      return true;
    });
    if (middles.size() == before)
      text.fail(fmt::format("vertex_parents: the places of {} vertices do not follow", before));
  }
  mesh.vertex_count = count;
}

/// A box divided into cells: the type of the cells, their number along each side, and the side
/// lengths.
struct Box {
  std::string type;
  std::array<std::size_t, 3> cells{};
  std::array<double, 3> lengths{1, 1, 1};
};

Box read_box(TextCursor& text) {
  Box box;
  constexpr std::size_t kMostAlong = 1000;
  for (std::string_view key = next_word(text); !key.empty(); key = next_word(text)) {
    // "nx = 4" or "nx=4"
    std::string_view value;
    if (const std::size_t equals = key.find('='); equals != std::string_view::npos) {
      value = key.substr(equals + 1);
      key = key.substr(0, equals);
    } else if (text.word() != "=") {
      text.fail("NAME = VALUE expected");
    }
    if (value.empty()) value = text.word();
    const std::size_t axis = key.size() == 2 ? std::string_view("xyz").find(key[1]) : 3;
    if (key == "type") {
      box.type = value;
    } else if (axis < 3 && key[0] == 'n') {
      const auto count = to_integer(value);
      if (!count || *count < 1 || *count > static_cast<std::int64_t>(kMostAlong))
        text.fail(
            fmt::format("{}: 1 to {} cells expected ({} found)", key, kMostAlong, shown(value)));
      box.cells[axis] = static_cast<std::size_t>(*count);
    } else if (axis < 3 && key[0] == 's') {
      const auto length = to_real(value);
      if (!length) text.fail(fmt::format("{}: a length expected ({} found)", key, shown(value)));
      box.lengths[axis] = *length;
    }
  }
  return box;
}

/// The vertices of the elements that a brick is divided into; 8 is the brick's centre.
struct Division {
  Geometry geometry;
  std::vector<std::array<std::int64_t, 8>> elements;
};

// MFEM's Mesh::AddHexAsTets, AddHexAsWedges, AddHexAsPyramids
Division division_of(const std::string& type, const TextCursor& text) {
  if (type == "hex") return {Geometry::cube, {{0, 1, 2, 3, 4, 5, 6, 7}}};
  if (type == "tet")
    return {Geometry::tetrahedron,
            {{0, 1, 2, 6}, {0, 5, 1, 6}, {0, 4, 5, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}}};
  if (type == "wedge") return {Geometry::prism, {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}}};
  if (type == "pyramid")
    return {Geometry::pyramid,
            {{0, 1, 2, 3, 8},
             {0, 4, 5, 1, 8},
             {1, 5, 6, 2, 8},
             {2, 6, 7, 3, 8},
             {3, 7, 4, 0, 8},
             {7, 6, 5, 4, 8}}};
  text.fail(fmt::format("type hex, tet, wedge or pyramid expected ({} found)", shown(type)));
}

/// The mesh of a box: the file gives its numbers of cells and side lengths, and no elements.
MeshFile read_inline_mesh(TextCursor& text) {
  const Box box = read_box(text);
  const Division division = division_of(box.type, text);
  const auto [nx, ny, nz] = box.cells;
  constexpr std::size_t kMostBricks = 250'000;
  if (nx == 0 || ny == 0 || nz == 0) text.fail("nx, ny and nz expected");
  if (nx * ny * nz > kMostBricks)
    text.fail(fmt::format("{} bricks are made ({} at most expected)", nx * ny * nz, kMostBricks));
  MeshFile mesh;
  mesh.path = text.subject();
  for (std::size_t k = 0; k <= nz; ++k)
    for (std::size_t j = 0; j <= ny; ++j)
      for (std::size_t i = 0; i <= nx; ++i)
        mesh.vertices.push_back(
            {box.lengths[0] * static_cast<double>(i) / static_cast<double>(nx),
             box.lengths[1] * static_cast<double>(j) / static_cast<double>(ny),
             box.lengths[2] * static_cast<double>(k) / static_cast<double>(nz)});
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i) {
        const std::size_t corner = (k * (ny + 1) + j) * (nx + 1) + i;
        const std::size_t up = (nx + 1) * (ny + 1);
        const std::array<std::size_t, 9> brick{corner,
                                               corner + 1,
                                               corner + nx + 2,
                                               corner + nx + 1,
                                               corner + up,
                                               corner + up + 1,
                                               corner + up + nx + 2,
                                               corner + up + nx + 1,
                                               mesh.vertices.size()};
        if (division.geometry == Geometry::pyramid) {
          std::array<double, 3> centre{};
          for (std::size_t d = 0; d < 3; ++d)
            centre[d] = (mesh.vertices[brick[0]][d] + mesh.vertices[brick[6]][d]) / 2;
          mesh.vertices.push_back(centre);
        }
        for (const auto& local : division.elements) {
          Element element{division.geometry, 1, {}};
          for (std::size_t v = 0; v < vertex_count(division.geometry); ++v)
            element.vertices[v] =
                static_cast<std::int64_t>(brick[static_cast<std::size_t>(local[v])]);
          mesh.elements.push_back(element);
        }
      }
  mesh.vertex_count = mesh.vertices.size();
  return mesh;
}

}  // namespace

std::size_t vertex_count(Geometry geometry) {
  return kGeometries[static_cast<std::size_t>(geometry)].vertices;
}

std::string_view geometry_name(Geometry geometry) {
  return kGeometries[static_cast<std::size_t>(geometry)].name;
}

MeshFile read_mesh_file(TextCursor& text) {
  const std::string_view title = text.line();
  const bool refined = title.starts_with("MFEM NC mesh v1");
  if (title.starts_with("MFEM INLINE mesh v1")) return read_inline_mesh(text);
  if (!refined && !title.starts_with("MFEM mesh v1"))
    text.fail_at(0, fmt::format("'MFEM mesh v1.x', 'MFEM NC mesh v1.x' or 'MFEM INLINE mesh v1.x' "
                                "expected ('{}' found)",
                                trimmed(title)));
  MeshFile mesh;
  mesh.path = text.subject();
  mesh.refined = refined;
  std::vector<Middle> middles;
  std::optional<std::int64_t> rank;
  for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
    if (word == "dimension") {
      text.integer("the dimension");
    } else if (word == "elements") {
      read_elements(text, refined, rank, mesh);
    } else if (word == "rank" && refined) {
      rank = text.integer("a rank");
    } else if (word == "boundary" || word == "coarse_elements") {
      skip_elements(text);
    } else if (word == "attribute_sets" || word == "bdr_attribute_sets") {
      skip_attribute_sets(text);
    } else if (word == "root_state") {
      for (std::size_t left = next_count(text, "a count"); left > 0; --left)
        text.integer("a state");
    } else if (word == "vertices" || word == "coordinates") {
      read_vertices(text, mesh);
    } else if (word == "vertex_parents") {
      middles = read_parents(text);
      mesh.refined = true;
    } else if (word == "nodes") {
      mesh.nodes = read_grid_function(text);
    } else if (word == "mfem_mesh_end") {
      note_text_behind(text.text().substr(text.offset()), "mfem_mesh_end", mesh.notes);
      break;
    } else if (word == "mfem_serial_mesh_end") {
      break;  // what the parts of a parallel mesh share
    } else {
      text.fail(fmt::format("a section of an MFEM mesh expected ({} found)", shown(word)));
    }
  }
  if (!middles.empty()) place_middles(text, std::move(middles), mesh);
  if (mesh.vertex_count == 0) text.fail("ended before its vertices");
  return mesh;
}

GridFunction read_grid_function(TextCursor& text) {
  GridFunction function;
  const auto expect = [&](std::string_view word) {
    if (const std::string_view found = next_word(text); found != word)
      text.fail(fmt::format("'{}' expected ({} found)", word, shown(found)));
  };
  expect("FiniteElementSpace");
  expect("FiniteElementCollection:");
  function.collection = std::string(text.word());
  expect("VDim:");
  const std::int64_t components = text.integer("the number of components");
  if (components < 1 || components > 1000) text.fail("1 to 1000 components expected");
  function.components = static_cast<std::size_t>(components);
  expect("Ordering:");
  function.by_vdim = text.integer("an ordering") == 1;
  const auto begins_number = [](char c) {
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  };
  for (text.skip_space(); !text.at_end() && begins_number(text.text()[text.offset()]);
       text.skip_space())
    function.values.push_back(text.real("a value"));
  if (function.values.empty() || function.values.size() % function.components != 0)
    text.fail(fmt::format("a multiple of {} values expected ({} found)", function.components,
                          function.values.size()));
  return function;
}

}  // namespace hiac::formats::mfem

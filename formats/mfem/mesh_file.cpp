#include "formats/mfem/mesh_file.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats::mfem {
namespace {

/// What a geometry is called and how many vertices it has.
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

/// The next word, over comments; the cursor stays behind it.
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

/// Elements of a mesh without hanging nodes, or the leaves of one with them.
void read_elements(TextCursor& text, bool refined, MeshFile& mesh) {
  for (std::size_t left = next_count(text, "the number of elements"); left > 0; --left) {
    if (refined) text.integer("a rank");
    Element element;
    element.attribute = text.integer("an attribute");
    const std::int64_t geometry = text.integer("a geometry");
    if (geometry < 0 || geometry >= static_cast<std::int64_t>(kGeometries.size()))
      text.fail(
          fmt::format("geometry 0 to {} expected ({} found)", kGeometries.size() - 1, geometry));
    element.geometry = static_cast<Geometry>(geometry);
    if (refined && text.integer("a refinement") != 0) {
      text.line();  // a parent, whose children are elements too
      continue;
    }
    for (std::size_t v = 0; v < vertex_count(element.geometry); ++v)
      element.vertices[v] = text.integer("a vertex");
    mesh.elements.push_back(element);
  }
}

void skip_elements(TextCursor& text) {
  for (std::size_t left = next_count(text, "the number of elements"); left > 0; --left) {
    text.skip_space();
    text.line();
  }
}

/// Coordinates, or "nodes" where a grid function has them.
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

/// A vertex in the middle of an edge between two others.
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

/// Puts the vertices that have parents between them, once these have their places.
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
      if (!is_vertex(middle.vertex) || !is_vertex(a) || !is_vertex(b))
        text.fail(fmt::format("vertex_parents name vertex {} (0 to {} expected)",
                              std::max({middle.vertex, a, b}), count - 1));
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
  if (!refined && !title.starts_with("MFEM mesh v1"))
    text.fail_at(
        0, fmt::format("'MFEM mesh v1.x' or 'MFEM NC mesh v1.x' expected ('{}' found)", title));
  MeshFile mesh;
  std::vector<Middle> middles;
  for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
    if (word == "dimension") {
      text.integer("the dimension");
    } else if (word == "elements") {
      read_elements(text, refined, mesh);
    } else if (word == "boundary") {
      skip_elements(text);
    } else if (word == "root_state") {
      for (std::size_t left = next_count(text, "a count"); left > 0; --left)
        text.integer("a state");
    } else if (word == "vertices" || word == "coordinates") {
      read_vertices(text, mesh);
    } else if (word == "vertex_parents") {
      middles = read_parents(text);
    } else if (word == "nodes") {
      mesh.nodes = read_grid_function(text);
    } else if (word == "mfem_mesh_end") {
      break;
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

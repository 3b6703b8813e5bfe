// The layout: the AFLR3 documentation, "UGRID file type".
#include "formats/ugrid/ugrid.hpp"

#include <array>
#include <optional>

#include <fmt/format.h>

#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/io/byte_stream.hpp"
#include "formats/common/io/bytes_behind.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/assemble.hpp"

namespace hiac::formats {
namespace {

/// A pyramid's base is 0 3 4 1, its apex 2.
constexpr std::array<std::uint8_t, 5> kUgridPyramid{0, 3, 4, 1, 2};

/// The seven counts: nodes, triangles, quadrilaterals, tetrahedra, pyramids, prisms, hexahedra.
using Counts = std::array<std::size_t, 7>;
constexpr std::array<std::size_t, 4> kSolidNodes{4, 5, 6, 8};

void begin_mesh(ForeignMesh& mesh) {
  mesh.first_node = 1;
  mesh.types = {{"tet", 4, solid_conversion(CellKind::tetrahedron4)},
                {"pyramid", 5, converted_to(CellKind::pyramid5, kUgridPyramid)},
                {"prism", 6, solid_conversion(CellKind::prism6)},
                {"hex", 8, solid_conversion(CellKind::brick8)}};
}

void note_faces(const Counts& counts, ForeignMesh& mesh) {
  if (counts[1] + counts[2] > 0)
    mesh.notes.push_back(
        fmt::format("dropped cells without volume: {} triangles, {} "
                    "quadrilaterals of the boundary",
                    counts[1], counts[2]));
}

ForeignMesh read_words(const InputText& text) {
  ForeignMesh mesh;
  begin_mesh(mesh);
  TextCursor cursor(text.text(), text.path());
  Counts counts{};
  for (std::size_t& count : counts) count = cursor.count("a count", cursor.left());
  for (std::size_t i = 0; i < 3 * counts[0]; ++i) mesh.xyz.push_back(cursor.real("a coordinate"));
  const std::size_t faces = 4 * counts[1] + 5 * counts[2];
  for (std::size_t i = 0; i < faces; ++i) cursor.integer("a boundary face");
  for (std::size_t s = 0; s < kSolidNodes.size(); ++s) {
    for (std::size_t i = 0; i < counts[3 + s]; ++i) {
      mesh.cell_types.push_back(static_cast<std::uint16_t>(s));
      for (std::size_t n = 0; n < kSolidNodes[s]; ++n)
        mesh.cell_nodes.push_back(cursor.integer("a node"));
    }
  }
  note_text_behind(text.text().substr(cursor.offset()), "the mesh", mesh.notes);
  note_faces(counts, mesh);
  return mesh;
}

/// One of the binary variants.
struct Variant {
  std::string_view name;
  std::endian order;
  bool marked;  ///< Fortran's record marks round the counts and round the rest
  std::size_t real_bytes;
};
constexpr std::array<Variant, 8> kVariants{{{"b8", std::endian::big, false, 8},
                                            {"lb8", std::endian::little, false, 8},
                                            {"b4", std::endian::big, false, 4},
                                            {"lb4", std::endian::little, false, 4},
                                            {"r8", std::endian::big, true, 8},
                                            {"lr8", std::endian::little, true, 8},
                                            {"r4", std::endian::big, true, 4},
                                            {"lr4", std::endian::little, true, 4}}};

std::optional<Counts> counts_of(ByteStream& stream, const Variant& variant) {
  stream.set_order(variant.order);
  stream.move_to(0);
  if (stream.size() < 36) return std::nullopt;
  if (variant.marked && stream.read<std::uint32_t>("a record") != 28) return std::nullopt;
  Counts counts{};
  for (std::size_t& count : counts) {
    const auto value = stream.read<std::int32_t>("a count");
    if (value < 0) return std::nullopt;
    count = static_cast<std::size_t>(value);
  }
  return counts;
}

/// The size of a file with those counts, without anything that follows the mesh.
std::size_t bytes_of(const Counts& counts, const Variant& variant) {
  std::size_t integers = 7 + 4 * counts[1] + 5 * counts[2];
  for (std::size_t s = 0; s < kSolidNodes.size(); ++s) integers += kSolidNodes[s] * counts[3 + s];
  return 4 * integers + 3 * variant.real_bytes * counts[0] + (variant.marked ? 16 : 0);
}

/// The variant that the file's name gives (mesh.lb8.ugrid), otherwise the one whose size fits.
std::pair<const Variant*, Counts> variant_of(ByteStream& stream, const std::string& path) {
  for (const Variant& variant : kVariants) {
    if (path.find(fmt::format(".{}.", variant.name)) == std::string::npos) continue;
    const auto counts = counts_of(stream, variant);
    if (!counts || bytes_of(*counts, variant) > stream.size())
      stream.fail(
          fmt::format("the counts do not fit a {} file of {} bytes", variant.name, stream.size()));
    return {&variant, *counts};
  }
  for (const Variant& variant : kVariants) {
    const auto counts = counts_of(stream, variant);
    if (counts && bytes_of(*counts, variant) == stream.size()) return {&variant, *counts};
  }
  stream.fail(
      "none of the binary variants fits (b8, lb8, b4, lb4, r8, lr8, r4 or lr4 before "
      ".ugrid expected)");
}

ForeignMesh read_bytes(const InputText& text) {
  ForeignMesh mesh;
  begin_mesh(mesh);
  ByteStream stream(text.text(), text.path());
  const auto [variant, counts] = variant_of(stream, text.path());
  stream.move_to((variant->marked ? 12U : 0U) + 28U);
  for (std::size_t i = 0; i < 3 * counts[0]; ++i)
    mesh.xyz.push_back(variant->real_bytes == 8
                           ? stream.read<double>("a coordinate")
                           : static_cast<double>(stream.read<float>("a coordinate")));
  stream.skip(4 * (4 * counts[1] + 5 * counts[2]), "boundary faces");
  for (std::size_t s = 0; s < kSolidNodes.size(); ++s) {
    for (std::size_t i = 0; i < counts[3 + s]; ++i) {
      mesh.cell_types.push_back(static_cast<std::uint16_t>(s));
      for (std::size_t n = 0; n < kSolidNodes[s]; ++n)
        mesh.cell_nodes.push_back(stream.read<std::int32_t>("a node"));
    }
  }
  note_bytes_behind(stream.size() - bytes_of(counts, *variant), "the mesh", mesh.notes);
  note_faces(counts, mesh);
  return mesh;
}

/// Text begins with seven counts.
bool is_text(std::string_view text) {
  TextCursor cursor(text.substr(0, 256), "");
  for (int i = 0; i < 7; ++i)
    if (!to_integer(cursor.word())) return false;
  return true;
}

ForeignMesh read_ugrid_file(const std::string& path) {
  const InputText text(path);
  return is_text(text.text()) ? read_words(text) : read_bytes(text);
}

}  // namespace

Format ugrid_format() {
  Format format;
  format.name = "ugrid";
  format.extensions = {".ugrid"};
  format.kinds = "tet4 pyr5 prism6 wedge7 brick8";
  format.fields = "none";
  format.time_steps = "none";
  format.recognizes = [](std::string_view) { return false; };
  format.plausible = [](std::string_view) { return true; };
  format.gzip = true;
  read_through(format,
               [](const std::string& path, const ReadOptions&) { return read_ugrid_file(path); });
  return format;
}

}  // namespace hiac::formats

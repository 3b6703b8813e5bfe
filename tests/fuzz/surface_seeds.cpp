#include "tests/fuzz/surface_seeds.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "tests/formats/solver_files.hpp"

namespace hiac::fuzz {
namespace {

using formats::Bytes;
using Texts = std::vector<std::string>;

Texts poly() {
  return {
      "4 3 0 1\n1 0 0 0 1\n2 1 0 0 1\n3 0 1 0 1\n4 0 0 1 1\n4 1\n1 0 1\n3 1 2 3\n1 0 2\n3 1 2 4\n"
      "1\n3 2 3 4\n1\n3 1 3 4\n0\n1\n1 0.1 0.1 0.1 5 0.1\n"};
}

/// The corners and the outward triangles of a tetrahedron.
std::string four(const char* before) {
  std::string text;
  for (const char* point : {"0 0 0", "2 0 0", "0 3 0", "0 0 4.5"})
    text += fmt::format("{}{}\n", before, point);
  return text;
}

Texts ply() {
  const std::string header =
      "ply\nformat {} 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  Bytes binary;
  binary.raw(fmt::format(fmt::runtime(header), "binary_little_endian"));
  for (const int x : {0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4}) binary.mark(static_cast<float>(x));
  for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    binary.raw("\3").wholes({a, b, c});
  return {fmt::format(fmt::runtime(header), "ascii") + four("") +
              "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n",
          binary.str()};
}

Texts off() { return {"OFF\n4 4 0\n" + four("") + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"}; }

Texts obj() { return {four("v ") + "f 1 3 2\nf 1 2 4\nf 2/1/1 3//2 4\nf 3 1 4\n"}; }

std::string xml_cells(const char* section, const char* points, const char* ends,
                      const char* types = "") {
  return fmt::format(
      "<{0}><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">{1}</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">{2}</DataArray>{3}</{0}>",
      section, points, ends, types);
}

std::string xml_surface(const char* type, const char* counts, const std::string& cells) {
  return fmt::format(
      "<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\"><{0}><Piece NumberOfPoints=\"4\" {1}><Points><DataArray "
      "type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">{2}</DataArray></Points>{3}"
      "</Piece></{0}></VTKFile>",
      type, counts, four(""), cells);
}

/// Inline base64: the points and the triangles of a tetrahedron.
std::string base64_vtp() {
  const auto encoded = [](const std::string& bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      std::uint32_t word = 0;
      for (std::size_t k = 0; k < 3; ++k)
        word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
      for (std::size_t k = 0; k < 4; ++k)
        text += i + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63];
    }
    return text;
  };
  const auto array = [&](const char* attributes, const std::string& values) {
    Bytes all(false);
    all.whole(static_cast<std::int32_t>(values.size()));
    return fmt::format("<DataArray {} format=\"binary\">{}</DataArray>", attributes,
                       encoded(all.str() + values));
  };
  Bytes points(false), corners(false), ends(false);
  for (const int x : {0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4}) points.mark(static_cast<float>(x));
  corners.wholes({0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});
  ends.wholes({3, 6, 9, 12});
  return "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>"
         "<Piece NumberOfPoints=\"4\" NumberOfPolys=\"4\"><Points>" +
         array("type=\"Float32\" NumberOfComponents=\"3\"", points.str()) + "</Points><Polys>" +
         array("type=\"Int32\" Name=\"connectivity\"", corners.str()) +
         array("type=\"Int32\" Name=\"offsets\"", ends.str()) +
         "</Polys></Piece></PolyData></VTKFile>";
}

Texts vtp() {
  const std::string polygons = xml_cells("Polys", "0 2 1 0 1 3 1 2 3 2 0 3", "3 6 9 12");
  return {xml_surface("PolyData", "NumberOfPolys=\"4\" NumberOfStrips=\"0\"", polygons),
          xml_surface("PolyData", "NumberOfStrips=\"1\" NumberOfLines=\"1\"",
                      xml_cells("Lines", "0 1", "2") + xml_cells("Strips", "0 1 2 3", "4")),
          base64_vtp()};
}

Texts vtu_surface() {
  return {xml_surface("UnstructuredGrid", "NumberOfCells=\"4\"",
                      xml_cells("Cells", "0 2 1 0 1 3 1 2 3 0 2 0 3", "3 6 10 13",
                                "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">"
                                "5 5 9 5</DataArray>"))};
}

Texts stl() {
  Bytes binary;
  binary.raw(std::string(80, ' ')).whole(1);
  for (const int x : {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) binary.mark(static_cast<float>(x));
  binary.raw(std::string(2, '\0'));
  return {
      "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid t\n",
      binary.str()};
}

}  // namespace

std::vector<std::string> surface_seeds(const std::string& format) {
  static const std::map<std::string, std::function<Texts()>> kKnown{{"obj", obj},
                                                                    {"off", off},
                                                                    {"ply", ply},
                                                                    {"poly", poly},
                                                                    {"stl", stl},
                                                                    {"vtp", vtp},
                                                                    {"vtu-surface", vtu_surface}};
  const auto found = kKnown.find(format);
  return found != kKnown.end() ? found->second() : Texts{};
}

}  // namespace hiac::fuzz

// Based on: G. Turk, "The PLY Polygon File Format", 1994.
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "formats/boundary/write_boundary.hpp"
#include "formats/common/io/binary_output.hpp"

namespace hiac::formats {
namespace {

// The names of the properties of one element, each of which it has once.
class PropertyNames {
 public:
  explicit PropertyNames(std::set<std::string> taken) : taken_(std::move(taken)) {}

  std::string name_of(const Field& field, std::uint32_t component) {
    std::string name = field.name.empty() ? "field" : field.name;
    for (char& c : name)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    if (field.components == 3)
      name += fmt::format("_{}", "xyz"[component]);
    else if (field.components > 1)
      name += fmt::format("_{}", component);
    std::string free = name;
    for (int number = 2; !taken_.insert(free).second; ++number)
      free = fmt::format("{}_{}", name, number);
    return free;
  }

 private:
  std::set<std::string> taken_;
};

std::string properties(const BoundarySurface& surface, FieldLocation location,
                       PropertyNames names) {
  std::string text;
  for (const Field& field : surface.fields)
    for (std::uint32_t c = 0; field.location == location && c < field.components; ++c)
      text += fmt::format("property double {}\n", names.name_of(field, c));
  return text;
}

void write_tuples(BinaryOutput& out, const BoundarySurface& surface, FieldLocation location,
                  std::size_t tuple) {
  for (const Field& field : surface.fields)
    for (std::size_t c = 0; field.location == location && c < field.components; ++c)
      out.number(field.values[tuple * field.components + c]);
}

}  // namespace

std::vector<std::string> write_ply(const std::string& path, const BoundarySurface& surface) {
  const std::size_t points = surface.xyz.size() / 3;
  BinaryOutput out(path);
  out.text(
      fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\n"
                  "property double y\nproperty double z\n{}element face {}\n"
                  "property list uchar int vertex_indices\n{}end_header\n",
                  points, properties(surface, FieldLocation::node, PropertyNames({"x", "y", "z"})),
                  surface.triangles.size(),
                  properties(surface, FieldLocation::cell, PropertyNames({"vertex_indices"}))));
  for (std::size_t p = 0; p < points; ++p) {
    for (std::size_t c = 0; c < 3; ++c) out.number(surface.xyz[3 * p + c]);
    write_tuples(out, surface, FieldLocation::node, p);
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    out.number<std::uint8_t>(3);
    for (const std::uint32_t corner : surface.triangles[t])
      out.number(static_cast<std::int32_t>(corner));
    write_tuples(out, surface, FieldLocation::cell, t);
  }
  out.finish();
  return {};
}

}  // namespace hiac::formats

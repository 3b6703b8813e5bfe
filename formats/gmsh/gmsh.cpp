#include "formats/gmsh/gmsh.hpp"

#include <fmt/format.h>

#include "formats/common/mesh/assemble.hpp"
#include "formats/gmsh/gmsh_data.hpp"
#include "formats/gmsh/gmsh_writer.hpp"

namespace hiac::formats {
namespace {

ForeignMesh read_gmsh(const std::string& path) {
  const auto text = std::make_shared<InputText>(path);
  gmsh::MshContents contents = gmsh::read_sections(gmsh::MshStream(TextCursor(text->text(), path)));
  ForeignMesh& mesh = contents.mesh;
  for (auto& [group, cells] : contents.groups) {
    const auto name = contents.physical_names.find(group);
    mesh.blocks.push_back(
        {name == contents.physical_names.end() ? fmt::format("{}", group.second) : name->second,
         std::move(cells)});
  }
  gmsh::add_data(std::move(contents.data), text, mesh);
  return std::move(mesh);
}

}  // namespace

Format gmsh_format() {
  Format format;
  format.name = "gmsh";
  format.extensions = {".msh"};
  format.kinds = "tet4-20 pyr5-21 prism6-24 wedge7,18 brick8-32";
  format.fields = "node, cell, corner";
  format.time_steps = "many";
  format.recognizes = [](std::string_view head) {
    // Gmsh ignores lines before a section; but dollar signs also occur in other formats
    TextCursor cursor(head, "");
    while (!cursor.at_end()) {
      const std::string_view line = trimmed(cursor.line());
      if (line == "$MeshFormat" || line == "$NOD" || line == "$Comments") return true;
      if (!line.empty() && !line.starts_with('#') && !line.starts_with("//")) return false;
    }
    return false;
  };
  format.gzip = true;
  read_through(format, [](const std::string& path, const ReadOptions&) { return read_gmsh(path); });
  format.write = gmsh::write_msh;
  return format;
}

}  // namespace hiac::formats

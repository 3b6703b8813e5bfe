// formats_consumer FILE MESH.zoo: reads a file of any format that hiac knows and writes the mesh;
// without arguments it lists the formats. The formats that stand on libraries of their own are
// there, too.
#include <cstdio>
#include <exception>

#include "formats/registry.hpp"
#include "hiac/mesh/zoo_container.hpp"

int main(int count, char** argv) try {
  for (const hiac::formats::Format& format : hiac::formats::all_formats())
    std::printf("%.*s\n", static_cast<int>(format.name.size()), format.name.data());
  if (count < 3) return 0;
  const auto reading = hiac::formats::format_to_read(argv[1]).read(argv[1], {});
  for (const std::string& note : reading.notes) std::printf("%s\n", note.c_str());
  hiac::write_zoo_file(argv[2], {reading.mesh, {}});
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 3;
}

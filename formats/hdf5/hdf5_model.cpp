#include "formats/hdf5/hdf5_model.hpp"

#include <array>
#include <fstream>

#include "formats/common/io/isolated.hpp"
#include "formats/hdf5/hdf5_file.hpp"

namespace hiac::formats::hdf5 {
namespace {

constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);

/// A format, and the objects at the root of its files.
struct Mark {
  const char* object;
  const char* model;
};
constexpr std::array<Mark, 7> kMarks{{{"/VTKHDF", "vtkhdf"},
                                      {"/ENS_MAA", "med"},
                                      {"/INFOS_GENERALES", "med"},
                                      {"/CGNSLibraryVersion", "cgns"},
                                      {"/ hdf5version", "cgns"},
                                      {"/.silo", "silo"},
                                      {"/num_el_blk", "exodus"}}};

ForeignMesh find_model(const std::string& path) {
  const File file(path);
  ForeignMesh found;
  for (const Mark& mark : kMarks) {
    if (!file.has(mark.object)) continue;
    found.metadata.emplace_back("model", mark.model);
    break;
  }
  return found;
}

}  // namespace

bool is_hdf5(std::string_view head) { return head.starts_with(kSignature); }

std::string model_of(const std::string& path) {
  std::array<char, 8> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  if (!is_hdf5({head.data(), head.size()})) return {};
  const ForeignMesh found = read_isolated(path, "the HDF5 library", find_model);
  return found.metadata.empty() ? std::string() : found.metadata.front().second;
}

}  // namespace hiac::formats::hdf5

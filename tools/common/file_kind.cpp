#include "tools/common/file_kind.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace hiac::tools {
namespace {

using namespace std::string_view_literals;

// The zoo container's header is followed by the header of its first chunk, which begins with its
// type (lib/hiac/mesh/zoo-container.md).
constexpr std::size_t kFirstChunk = 64;

struct Signature {
  std::string_view bytes;
  FileKind kind;
};

constexpr std::array kBeginnings{
    Signature{"\x89PNG\r\n\x1a\n"sv, FileKind::image},
    Signature{"\x76\x2f\x31\x01"sv, FileKind::image},  // OpenEXR
    Signature{"\x93NUMPY"sv, FileKind::image},
    Signature{"II*\0"sv, FileKind::image},  // TIFF, and BigTIFF below
    Signature{"MM\0*"sv, FileKind::image},
    Signature{"II+\0"sv, FileKind::image},
    Signature{"MM\0+"sv, FileKind::image},
    Signature{"\x01\xda"sv, FileKind::image},  // SGI
    Signature{"PF\n"sv, FileKind::image},      // PFM
    Signature{"Pf\n"sv, FileKind::image},
    Signature{"#?RADIANCE"sv, FileKind::image},
    Signature{"#?RGBE"sv, FileKind::image},
    Signature{"# vtk DataFile"sv, FileKind::mesh},
    Signature{"$MeshFormat"sv, FileKind::mesh},
    Signature{"\x89HDF\r\n\x1a\n"sv, FileKind::mesh},
    Signature{"CDF\x01"sv, FileKind::mesh},
    Signature{"CDF\x02"sv, FileKind::mesh},
    Signature{"MFEM mesh"sv, FileKind::mesh},
    Signature{"MeshVersionFormatted"sv, FileKind::mesh},
    Signature{"ply\n"sv, FileKind::mesh},
    Signature{"ply\r\n"sv, FileKind::mesh},
    Signature{"solid "sv, FileKind::mesh},  // STL
    Signature{"binary STL by hiac"sv, FileKind::mesh},
    Signature{"OFF\n"sv, FileKind::mesh},
};

// Words that are somewhere in the first bytes of a file of text.
constexpr std::array kWords{
    Signature{"<VTKFile"sv, FileKind::mesh},
    Signature{"<Xdmf"sv, FileKind::mesh},
    Signature{"\"hiac parted mesh\""sv, FileKind::mesh},
    Signature{"\n[camera]"sv, FileKind::specification},
    Signature{"\n[[camera]]"sv, FileKind::specification},
    Signature{"\n[volume"sv, FileKind::specification},
    Signature{"<ColorMap"sv, FileKind::specification},
    Signature{"<ServerManagerState"sv, FileKind::specification},
    Signature{"<PVCameraConfiguration"sv, FileKind::specification},
    Signature{"\"RGBPoints\""sv, FileKind::specification},
    Signature{"\"tool\": \"hiac-"sv, FileKind::facts},
};

// Films (ISO base media): their first box has its length before its name.
constexpr std::string_view kFilm = "ftyp"sv;
constexpr std::size_t kFilmBegins = 4;

// Formats whose first bytes prove nothing: those of surfaces and of solvers' decks and results.
constexpr std::array kMeshExtensions{
    ".stl"sv, ".ply"sv,   ".obj"sv,  ".off"sv,   ".poly"sv, ".smesh"sv, ".inp"sv, ".cdb"sv,
    ".frd"sv, ".bdf"sv,   ".nas"sv,  ".unv"sv,   ".ucd"sv,  ".neu"sv,   ".vol"sv, ".su2"sv,
    ".ele"sv, ".ugrid"sv, ".mesh"sv, ".meshb"sv, ".cgns"sv, ".med"sv};

std::string first_bytes(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::ifstream file(path, std::ios::binary);
  std::string head(4096, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return head;
}

FileKind kind_of_zoo(std::string_view head) {
  const bool order = head.size() > kFirstChunk && head.substr(kFirstChunk).starts_with("ORDER"sv);
  return order ? FileKind::order : FileKind::mesh;
}

std::optional<FileKind> kind_by_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".toml") return FileKind::specification;
  if (extension == ".f32") return FileKind::image;
  if (std::ranges::find(kMeshExtensions, extension) != kMeshExtensions.end()) return FileKind::mesh;
  return std::nullopt;
}

}  // namespace

std::string kind_phrase(FileKind kind) {
  switch (kind) {
    case FileKind::mesh:
      return "a mesh";
    case FileKind::order:
      return "a visibility order";
    case FileKind::specification:
      return "an image specification, a colour map or a state of ParaView";
    case FileKind::image:
      return "an image";
    case FileKind::facts:
      return "text or facts";
  }
  return "a file";
}

std::optional<FileKind> kind_of_file(const std::string& path) {
  const std::string head = first_bytes(path);
  if (head.empty()) return std::nullopt;
  if (head.starts_with(kZooMagic)) return kind_of_zoo(head);
  for (const Signature& signature : kBeginnings)
    if (head.starts_with(signature.bytes)) return signature.kind;
  if (std::string_view(head).substr(std::min(kFilmBegins, head.size())).starts_with(kFilm))
    return FileKind::image;
  const std::string lines = "\n" + head;
  for (const Signature& signature : kWords)
    if (lines.find(signature.bytes) != std::string::npos) return signature.kind;
  return kind_by_extension(path);
}

}  // namespace hiac::tools

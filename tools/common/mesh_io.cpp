#include "tools/common/mesh_io.hpp"

#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/zoo_chunks.hpp"
#include "tools/common/file_kind.hpp"

namespace hiac::tools {
namespace {

// Told of what begins as gzip's files do.
std::string packing_of(std::string_view head) {
  return head.starts_with("\x1f\x8b") ? ", packed by gzip" : "";
}

// What a regular file is that is no zoo container, and what helps; empty for a zoo container, and
// for what the reader complains about itself.
std::string foreign_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::string head(kZooMagic.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file.read(head.data(), static_cast<std::streamsize>(head.size())) || head == kZooMagic)
    return {};
  const auto kind = kind_of_file(path);
  if (kind && *kind != FileKind::mesh)
    return fmt::format("is {} (a zoo mesh expected)", kind_phrase(*kind));
  const std::string packed = packing_of(head);
  const auto zoo = std::filesystem::path(path).replace_extension(".zoo").filename().string();
  return fmt::format("is not a zoo mesh{} (hiac-convert {} -o {} makes one of a foreign file)",
                     packed, path, zoo);
}

// A mesh from stdin; what is no zoo mesh is told what makes one of it.
ZooFile read_stdin(MeshNumbers numbers) try {
  return read_zoo_stream(STDIN_FILENO, "stdin", numbers);
} catch (const NotZooError& foreign) {
  throw InputError(
      "stdin",
      fmt::format("is not a zoo mesh{} (hiac-convert --format NAME, before this in the pipe, makes "
                  "one of a foreign file; hiac-convert --list-formats tells the names)",
                  packing_of(foreign.beginning())));
}

}  // namespace

std::string input_name(const std::string& path) {
  return path.empty() || path == "-" ? "stdin" : path;
}

ZooFile read_mesh(const std::string& path, MeshNumbers numbers) {
  if (path.empty() && isatty(STDIN_FILENO) != 0)
    throw UsageError("no mesh: name a file, or pipe a mesh in");
  if (path.empty() || path == "-") return read_stdin(numbers);
  if (const std::string other = foreign_file(path); !other.empty()) throw InputError(path, other);
  return read_zoo_file(path, numbers);
}

bool is_stdout(const std::string& path) { return path.empty() || path == "-"; }

void require_binary_output(const std::string& path) {
  if (is_stdout(path) && isatty(STDOUT_FILENO) != 0)
    throw UsageError(
        "a mesh is binary and is not written to a terminal: name a file with -o, or use a pipe");
}

void write_mesh(const std::string& path, const ZooFile& file) {
  require_binary_output(path);
  if (is_stdout(path))
    write_zoo_stream(STDOUT_FILENO, file, "stdout");
  else
    write_zoo_file(path, file);
}

}  // namespace hiac::tools

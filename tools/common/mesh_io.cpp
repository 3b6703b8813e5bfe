#include "tools/common/mesh_io.hpp"

#include <unistd.h>

#include "hiac/base/error.hpp"

namespace hiac::tools {

std::string input_name(const std::string& path) {
  return path.empty() || path == "-" ? "stdin" : path;
}

ZooFile read_mesh(const std::string& path, MeshNumbers numbers) {
  if (path.empty() && isatty(STDIN_FILENO) != 0)
    throw UsageError("no mesh: name a file, or pipe a mesh in");
  if (path.empty() || path == "-") return read_zoo_stream(STDIN_FILENO, "stdin", numbers);
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
